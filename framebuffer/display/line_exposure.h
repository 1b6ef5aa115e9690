// Shares of the light of each scan line that an exposure collects.
#pragma once

#include <array>
#include <vector>

#include "framebuffer/display/line_times.h"

namespace tessera::detail {

/// Per scan line: factors of the light that the picture excites, and of what was left of the frame before.
struct LineExposure {
  bool is_whole = true;                                ///< all factors are 1 and 0; the vectors are empty
  std::array<std::vector<float>, 3> present, earlier;  ///< [color][line]
};

/// @param phase_ms     beginning of the exposure, from that of the frame
/// @param exposure_ms  0: one frame
LineExposure line_exposure(const FrameScan& scan, Phosphor phosphor, double phase_ms, double exposure_ms);

}  // namespace tessera::detail
