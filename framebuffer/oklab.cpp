#include "framebuffer/oklab.h"

#include <array>
#include <cstddef>

#include "framebuffer/exact_functions.h"
#include "framebuffer/srgb.h"

namespace tessera::detail {

namespace {

double cube(double x) noexcept { return x * x * x; }

Oklab oklab_from_linear(const LinearRgb& c) noexcept {
  const double l = nth_root<3>(0.4122214708 * c.r + 0.5363325363 * c.g + 0.0514459929 * c.b);
  const double m = nth_root<3>(0.2119034982 * c.r + 0.6806995451 * c.g + 0.1073969566 * c.b);
  const double s = nth_root<3>(0.0883024619 * c.r + 0.2817188376 * c.g + 0.6299787005 * c.b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

/// Linear light of the 256 levels.
const std::array<double, 256>& linear_levels() noexcept {
  static const std::array<double, 256> levels = [] {
    std::array<double, 256> table{};
    for (std::size_t v = 0; v < table.size(); ++v) table[v] = linear_from_srgb(static_cast<double>(v) / 255);
    return table;
  }();
  return levels;
}

}  // namespace

Oklab oklab_from_srgb(double r, double g, double b) noexcept {
  return oklab_from_linear({linear_from_srgb(r), linear_from_srgb(g), linear_from_srgb(b)});
}

Oklab oklab_from_rgb8(Rgb8 color) noexcept {
  const std::array<double, 256>& linear = linear_levels();
  return oklab_from_linear({linear[color.r], linear[color.g], linear[color.b]});
}

LinearRgb linear_from_oklab(const Oklab& color) noexcept {
  const double l = cube(color.l + 0.3963377774 * color.a + 0.2158037573 * color.b);
  const double m = cube(color.l - 0.1055613458 * color.a - 0.0638541728 * color.b);
  const double s = cube(color.l - 0.0894841775 * color.a - 1.2914855480 * color.b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

}  // namespace tessera::detail
