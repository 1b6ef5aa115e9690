// OKLab: a colour space in which Euclidean distances follow visible differences. B. Ottosson, A perceptual
// color space for image processing, 2020. Same bits on every machine.
#pragma once

#include "framebuffer/palette.h"

namespace tessera::detail {

/// Lightness (0 black to 1 white), green to red, blue to yellow. The latter are within -0.32 .. 0.28 in sRGB.
struct Oklab {
  double l = 0, a = 0, b = 0;
  friend constexpr bool operator==(const Oklab&, const Oklab&) = default;
};
constexpr double squared_distance(const Oklab& x, const Oklab& y) noexcept {
  const double dl = x.l - y.l, da = x.a - y.a, db = x.b - y.b;
  return dl * dl + da * da + db * db;
}

/// @param r, g, b  stored components, 0 to 1
Oklab oklab_from_srgb(double r, double g, double b) noexcept;
Oklab oklab_from_rgb8(Rgb8 color) noexcept;

/// Linear light of a colour. Components may lie outside 0 .. 1.
struct LinearRgb {
  double r = 0, g = 0, b = 0;
};
LinearRgb linear_from_oklab(const Oklab& color) noexcept;

}  // namespace tessera::detail
