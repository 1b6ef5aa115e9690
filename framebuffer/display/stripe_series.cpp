#include "framebuffer/display/stripe_series.h"

#include <numbers>

#include "framebuffer/trigonometry.h"

namespace tessera::detail {

double stripe_transform(double f) { return f == 0 ? 1 : sine_cosine(180 * f).sine / (std::numbers::pi * f); }

std::vector<float> stripe_series(const Stripes& stripes, const PixelGrid& pixels, double pixel_mm) {
  const double limit = 1 / (2 * pixel_mm);
  std::vector<float> light;
  light.reserve(static_cast<std::size_t>(pixels.count));
  for (int pixel = 0; pixel < pixels.count; ++pixel) {
    const double turns = (pixels.center_mm(pixel) - stripes.center_mm) / stripes.period_mm;
    double sum = 1;
    for (int i = 1; i / stripes.period_mm < limit; ++i) {
      const double frequency = i / stripes.period_mm;
      sum += 2 * fejer_weight(frequency, limit) * stripe_transform(frequency * stripes.width_mm) *
             sine_cosine(360 * i * turns).cosine;
    }
    light.push_back(static_cast<float>(sum));
  }
  return light;
}

}  // namespace tessera::detail
