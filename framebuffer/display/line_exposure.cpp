#include "framebuffer/display/line_exposure.h"

#include <cstddef>

#include "framebuffer/exact_functions.h"

namespace tessera::detail {

LineExposure line_exposure(const FrameScan& scan, Phosphor phosphor, double phase_ms, double exposure_ms) {
  LineExposure exposure;
  const bool outlasts = outlasts_frame(phosphor);
  // Short phosphors emit all light of a frame within a frame.
  if (!outlasts && exposure_ms == 0) return exposure;
  exposure.is_whole = false;
  const double to_ms = phase_ms + (exposure_ms > 0 ? exposure_ms : scan.frame_ms);
  const std::array<double, 3> decays = decay_ms(phosphor);
  for (std::size_t color = 0; color < 3; ++color) {
    // Light of all earlier frames over that of the one before, if they showed the same picture.
    const double all_earlier = 1 / (1 - exponential(-scan.frame_ms / decays[color]));
    for (int line = 0; line < scan.lines; ++line) {
      CollectedShares shares =
          collected_shares(phase_ms, to_ms, scan.time_of(line), scan.frame_ms, decays[color]);
      if (!outlasts) shares = {shares.present + all_earlier * shares.earlier, 0};
      exposure.present[color].push_back(static_cast<float>(shares.present));
      exposure.earlier[color].push_back(static_cast<float>(shares.earlier));
    }
  }
  return exposure;
}

}  // namespace tessera::detail
