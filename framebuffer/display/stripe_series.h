// Periodic stripes drawn without moire.
#pragma once

#include <vector>

#include "framebuffer/display/resample_table.h"

namespace tessera::detail {

/// Fourier transform of a stripe of width 1 and area 1: sin(pi f) / (pi f).
double stripe_transform(double f);

/// Fejer's weight of a frequency up to half of the sampling rate, `limit`: a series with these weights is
/// never negative if its function is not, and keeps the mean.
constexpr double fejer_weight(double frequency, double limit) { return 1 - frequency / limit; }

/// Evenly spaced stripes.
struct Stripes {
  double period_mm;
  double width_mm;
  double center_mm;  ///< position of one of the stripes
};

/// Light of stripes at pixels, 1 on average: their Fourier series up to half of the sampling rate 1 /
/// pixel_mm, with Fejer's weights.
std::vector<float> stripe_series(const Stripes& stripes, const PixelGrid& pixels, double pixel_mm);

}  // namespace tessera::detail
