#include "engine/frame_watch.h"

#include <cmath>

#include "engine/parallel.h"
#include "engine/tessera/tessera.hpp"

namespace tessera {

void FrameWatch::report() {
  constexpr auto kPause = std::chrono::milliseconds(10);
  const std::size_t done = done_.fetch_add(1) + 1;
  const bool is_last = done == tasks_;
  std::unique_lock<std::mutex> lock(calling_, std::defer_lock);
  if (is_last)
    lock.lock();
  else if (!lock.try_lock())
    return;
  if (stopped_) return;
  const auto now = std::chrono::steady_clock::now();
  if (!is_last && now - last_call_ < kPause) return;
  last_call_ = now;
  // Read under the lock, so that it never falls.
  const double share = std::lerp(begin_, end_, static_cast<double>(done_.load()) / static_cast<double>(tasks_));
  stopped_ = true;  // unless it says to go on
  bool goes_on = false;
  isolated([&] {
    const FloatingPointMode mode;  // its worker has more tasks to run, whatever mode it leaves
    goes_on = progress_(share);
  });
  if (!goes_on) throw Cancelled("Renderer::finish: cancelled by the progress callback");
  stopped_ = false;
}

}  // namespace tessera
