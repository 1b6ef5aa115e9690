// When each task of a frame ran, and by whom, for who asked for it.
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::detail {

class FrameTrace {
 public:
  /// @param workers  0: nobody asked, and no clock is read
  explicit FrameTrace(int workers) : tasks_(static_cast<std::size_t>(workers)) {}

  /// Tasks from here on belong to a pass of that stage. Between tasks only.
  void begin_stage(FrameStage stage) {
    stage_ = stage;
    ++pass_;
  }
  /// Runs `work` as a task. Workers are told apart: theirs may run at the same time.
  template <class Work>
  void task(int worker, const Rect& pixels, const Work& work) {
    if (tasks_.empty()) return work();
    const double begin = now();
    work();
    tasks_[static_cast<std::size_t>(worker)].add({stage_, worker, begin, now(), pixels, pass_});
  }
  /// Of all workers, in the order in which they began. Without memory for them: none.
  std::vector<FrameTask> tasks() const noexcept;

 private:
  using Clock = std::chrono::steady_clock;
  /// Of one worker, in cache lines of its own. The frame is worth more than its trace: what there is no
  /// memory for is left out.
  struct alignas(64) WorkerTasks {
    std::vector<FrameTask> list;
    bool is_complete = true;
    void add(const FrameTask& task) noexcept;
  };
  double now() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  Clock::time_point start_ = Clock::now();
  FrameStage stage_ = FrameStage::vertices;
  int pass_ = -1;
  std::vector<WorkerTasks> tasks_;  // of each worker
};

}  // namespace tessera::detail
