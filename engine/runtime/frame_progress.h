// Progress callbacks and cancellation of a frame, and the trace of its tasks.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>

#include "engine/runtime/frame_trace.h"

namespace tessera::detail {

class FrameProgress {
 public:
  /// `progress` may be empty.
  FrameProgress(const std::function<bool(double)>& progress, FrameTrace& trace)
      : progress_(progress), trace_(trace) {}

  /// Begins a stage. Only between stages.
  /// @param end    share of the frame that is done at its end; 1 for the last stage
  /// @param tasks  number of task() calls
  void begin_stage(FrameStage stage, double end, std::size_t tasks) {
    trace_.begin_stage(stage);
    begin_ = end_;
    end_ = end;
    tasks_ = tasks;
    done_ = reported_ = 0;
  }
  /// Runs a task, on any worker. Throws Cancelled, and exceptions of the callback.
  template <class Work>
  void task(int worker, const Rect& pixels, const Work& work) {
    trace_.task(worker, pixels, work);
    if (progress_) report();
  }
  template <class Work>
  void task(int worker, const Work& work) {
    task(worker, {}, work);
  }

 private:
  void report();
  void call_if_due(std::size_t done);

  const std::function<bool(double)>& progress_;
  FrameTrace& trace_;
  double begin_ = 0, end_ = 0;             // shares of the frame that are done when the stage begins and ends
  std::size_t tasks_ = 0;                  // number of tasks of the stage
  std::atomic<std::size_t> done_ = 0;      // tasks of the stage that have ended
  std::atomic<bool> in_callback_ = false;  // a worker runs the callback; stays true once the frame is stopped
  std::size_t reported_ = 0;               // value of done_ in the last report of this stage
  std::chrono::steady_clock::time_point last_call_{};
};

}  // namespace tessera::detail
