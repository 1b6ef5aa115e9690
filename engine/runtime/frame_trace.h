// Times and workers of the tasks of a frame.
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::detail {

class FrameTrace {
 public:
  /// @param workers  0: tracing is off, and no clock is read
  explicit FrameTrace(int workers) : tasks_(static_cast<std::size_t>(workers)) {}

  /// Begins a pass of a stage. Only between tasks.
  void begin_stage(FrameStage stage) {
    stage_ = stage;
    ++pass_;
  }
  /// Runs `work` as a task. Tasks of distinct workers may run concurrently.
  template <class Work>
  void task(int worker, const Rect& pixels, const Work& work) {
    if (tasks_.empty()) return work();
    const double begin = now();
    work();
    tasks_[static_cast<std::size_t>(worker)].add({stage_, worker, begin, now(), pixels, pass_});
  }
  /// Tasks of all workers, ordered by begin. Empty if memory ran out.
  std::vector<FrameTask> tasks() const noexcept;

 private:
  using Clock = std::chrono::steady_clock;
  /// Tasks of one worker, in separate cache lines. If memory runs out the trace is dropped, not the frame.
  struct alignas(64) WorkerTasks {
    std::vector<FrameTask> list;
    bool is_complete = true;
    void add(const FrameTask& task) noexcept;
  };
  double now() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  Clock::time_point start_ = Clock::now();
  FrameStage stage_ = FrameStage::vertices;
  int pass_ = -1;
  std::vector<WorkerTasks> tasks_;  // per worker
};

}  // namespace tessera::detail
