#include "engine/runtime/frame_progress.h"

#include <cmath>

#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/worker_pool.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::detail {

void FrameProgress::report() {
  done_.fetch_add(1);
  // Nobody waits here: the callback may need this very thread, for another renderer's frame. Who calls
  // already looks again afterwards, and sees what was counted by those who found it calling: all of this is
  // sequentially consistent.
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
    const FloatingPointMode mode;  // its worker has more tasks to run, whatever mode it leaves
    goes_on = progress_(share);
  });
  if (!goes_on) throw Cancelled("Renderer::finish: cancelled by the progress callback");
}

}  // namespace tessera::detail
