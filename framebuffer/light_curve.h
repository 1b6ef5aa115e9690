// Light that a display emits for a stored value.
#pragma once

#include "framebuffer/srgb.h"

namespace tessera::detail {

/// sRGB's curve, or a power.
struct LightCurve {
  double gamma = 0;  ///< exponent, at least 1; 0: sRGB's curve

  /// Light 0 to 1 of a stored value c, 0 to 1. Monotonic; 0 and 1 stay.
  double light(double c) const {
    if (c <= 0) return 0;
    if (c >= 1) return 1;
    return gamma == 0 ? linear_from_srgb(c) : exponential(gamma * natural_log(c));
  }
};

}  // namespace tessera::detail
