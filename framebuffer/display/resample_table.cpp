#include "framebuffer/display/resample_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "framebuffer/display/gaussian.h"

namespace tessera::detail {
namespace {

/// Samples around a pixel, clamped to the grid.
int first_sample(const SampleGrid& samples, double center_mm, double reach_mm) {
  const double first = std::ceil((center_mm - reach_mm - samples.center_mm) / samples.spacing_mm);
  return static_cast<int>(std::clamp(first, 0.0, static_cast<double>(samples.count)));
}

}  // namespace

ResampleTable make_resample_table(const SampleGrid& samples, const PixelGrid& pixels,
                                  const SpreadFunction& spread) {
  ResampleTable table;
  const double most = std::floor(2 * spread.reach_mm / samples.spacing_mm) + 1;
  table.taps = static_cast<int>(std::min(most, static_cast<double>(samples.count)));
  table.first.reserve(static_cast<std::size_t>(pixels.count));
  table.weights.reserve(static_cast<std::size_t>(pixels.count) * static_cast<std::size_t>(table.taps));
  for (int pixel = 0; pixel < pixels.count; ++pixel) {
    const double center = pixels.center_mm(pixel);
    const int first = std::min(first_sample(samples, center, spread.reach_mm), samples.count - table.taps);
    table.first.push_back(first);
    for (int tap = 0; tap < table.taps; ++tap) {
      const double distance = center - (samples.center_mm + (first + tap) * samples.spacing_mm);
      const bool is_reached = std::abs(distance) <= spread.reach_mm;
      table.weights.push_back(is_reached ? static_cast<float>(spread.light(distance)) : 0.0f);
    }
  }
  return table;
}

SpreadFunction gaussian_spread(double sigma_mm, double spacing_mm, double pixel_mm, double smoothing_mm) {
  const double reach = 4 * sigma_mm + (pixel_mm + smoothing_mm) / 2;
  const double scale = spacing_mm / pixel_mm;
  if (smoothing_mm == 0)
    return {[=](double d) {
              const double right = (d + pixel_mm / 2) / sigma_mm, left = (d - pixel_mm / 2) / sigma_mm;
              return scale * (gaussian_integral(right) - gaussian_integral(left));
            },
            reach};
  // The second box turns differences of the integral into differences of its integral.
  return {[=](double d) {
            const auto ramp = [&](double x) { return gaussian_ramp(x / sigma_mm); };
            const double outer = (pixel_mm + smoothing_mm) / 2, inner = (pixel_mm - smoothing_mm) / 2;
            return scale * sigma_mm / smoothing_mm *
                   (ramp(d + outer) - ramp(d + inner) - ramp(d - inner) + ramp(d - outer));
          },
          reach};
}

SpreadFunction held_spread(double spacing_mm, double pixel_mm) {
  return {[=](double d) {
            const double from = std::max(d - pixel_mm / 2, -spacing_mm / 2);
            const double to = std::min(d + pixel_mm / 2, spacing_mm / 2);
            return std::max(to - from, 0.0) / pixel_mm;
          },
          (spacing_mm + pixel_mm) / 2};
}

}  // namespace tessera::detail
