// Tells the caller how far a frame is, and hears whether to go on.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>

namespace tessera {

class FrameWatch {
 public:
  /// `progress` may be empty: then nothing costs anything.
  explicit FrameWatch(const std::function<bool(double)>& progress) : progress_(progress) {}

  /// A stage of `tasks` tasks begins, which is `share` of the frame; the shares add up to 1. Between stages only.
  void begin_stage(double share, std::size_t tasks) {
    before_ += share_;
    share_ = share;
    tasks_ = tasks;
    done_ = 0;
  }
  /// A task has ended; by any worker. Throws Cancelled, or what the callback throws.
  void task_done() {
    if (progress_) report();
  }

 private:
  void report();

  const std::function<bool(double)>& progress_;
  double before_ = 0, share_ = 0;
  std::size_t tasks_ = 0;
  std::atomic<std::size_t> done_ = 0;
  std::mutex calling_;
  bool stopped_ = false;
  std::chrono::steady_clock::time_point last_call_{};
};

}  // namespace tessera
