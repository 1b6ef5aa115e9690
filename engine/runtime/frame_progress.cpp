#include "engine/runtime/frame_progress.h"

#include <cmath>

#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/worker_pool.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::detail {

void FrameProgress::report() {
  done_.fetch_add(1);
  // Never block: the callback may re-enter through another renderer on this thread. The thread that holds
  // `in_callback_` checks `done_` again afterwards, so increments made meanwhile are not lost. Relies on
  // seq_cst.
  while (!in_callback_.exchange(true)) {
    const std::size_t done = done_;
    call_if_due(done);
    in_callback_ = false;
    if (done == done_) return;
  }
}

void FrameProgress::call_if_due(std::size_t done) {
  constexpr auto kPause = std::chrono::milliseconds(10);
  if (done == reported_) return;
  const auto now = std::chrono::steady_clock::now();
  if (done < tasks_ && now - last_call_ < kPause) return;
  last_call_ = now;
  reported_ = done;
  const double share = std::lerp(begin_, end_, static_cast<double>(done) / static_cast<double>(tasks_));
  bool goes_on = false;
  run_isolated([&] {
    const FloatingPointMode mode;  // the callback may change the mode; this worker has more tasks to run
    goes_on = progress_(share);
  });
  if (!goes_on) throw Cancelled("Renderer::finish: cancelled by the progress callback");
}

}  // namespace tessera::detail
