// Tells the caller how far a frame is, and hears whether to go on; and what its tasks took, if somebody wants
// to know.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>

#include "engine/runtime/frame_trace.h"

namespace tessera::detail {

class FrameProgress {
 public:
  /// `progress` may be empty: then it costs nothing.
  FrameProgress(const std::function<bool(double)>& progress, FrameTrace& trace)
      : progress_(progress), trace_(trace) {}

  /// A stage of `tasks` tasks begins, at whose end `end` of the frame is done; the last one's is 1. Between
  /// stages only.
  void begin_stage(FrameStage stage, double end, std::size_t tasks) {
    trace_.begin_stage(stage);
    begin_ = end_;
    end_ = end;
    tasks_ = tasks;
    done_ = reported_ = 0;
  }
  /// Runs a task, on any worker. Throws Cancelled, or what the callback throws.
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
  double begin_ = 0, end_ = 0;
  std::size_t tasks_ = 0;
  std::atomic<std::size_t> done_ = 0;
  std::atomic<bool> in_callback_ =
      false;                  // the callback, by one at a time; for ever once it has stopped the frame
  std::size_t reported_ = 0;  // of done_, in this stage
  std::chrono::steady_clock::time_point last_call_{};
};

}  // namespace tessera::detail
