#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "framebuffer/display/check_mode.h"
#include "framebuffer/display/line_times.h"
#include "framebuffer/display/picture_levels.h"
#include "framebuffer/display/screen_layout.h"
#include "framebuffer/display/television_signal.h"
#include "framebuffer/tessera/screen.hpp"

namespace tessera {

VideoSignal video_signal(const Display& display, const VideoMode& mode, const VideoPicture& picture,
                         double time_ms) {
  if (display.kind != DisplayKind::ntsc && display.kind != DisplayKind::pal)
    throw DisplayError("the display has no video signal, expected ntsc or pal");
  check(display);
  detail::check_mode(mode);
  constexpr double kMaxMs = 1e12;
  if (!(time_ms >= 0 && time_ms <= kMaxMs))
    throw DisplayError("the time is " + detail::short_number(time_ms) + " ms, expected 0 to 1e12");
  // As in Screen, a frame that begins less than a millionth of a frame later has begun.
  const double frames = time_ms / detail::frame_scan(mode, {}).frame_ms;
  const auto frame = static_cast<std::int64_t>(std::floor(frames + 1e-6));

  const std::vector<std::uint8_t> levels = detail::read_levels(picture, mode.width, mode.height);
  const detail::TelevisionSignal signal(display.kind, display.television, mode);
  return signal.encode_frame(levels.data(), std::ptrdiff_t{3} * mode.width, 3, frame);
}

}  // namespace tessera
