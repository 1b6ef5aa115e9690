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

  /// A stage of `tasks` tasks begins, at whose end `end` of the frame is done; the last one's is 1. Between stages only.
  void begin_stage(double end, std::size_t tasks) {
    begin_ = end_;
    end_ = end;
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
  double begin_ = 0, end_ = 0;
  std::size_t tasks_ = 0;
  std::atomic<std::size_t> done_ = 0;
  std::mutex calling_;
  bool stopped_ = false;
  std::chrono::steady_clock::time_point last_call_{};
};

}  // namespace tessera
