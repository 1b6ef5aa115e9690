#include "framebuffer/display/mask_pattern.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "framebuffer/display/stripe_series.h"
#include "framebuffer/trigonometry.h"

namespace tessera::detail {
namespace {

// Shares of the room of a phosphor that it fills. Defaults without a source.
constexpr double kDotDiameter = 0.9;  ///< over the distance of neighbouring dots
constexpr double kStripeWidth = 0.8;  ///< over a third of the pitch
constexpr double kSlotLength = 0.85;  ///< over the height of a slot with its bridge

/// Bessel function J1(x) / x: the mean of cos(x sin t) cos^2 t over a circle. The mean of 64 points is exact
/// up to terms of order x^62 / 62!, below 1e-15 for x up to 15; larger arguments take more points.
double bessel_j1_over_x(double x) {
  const int points = 64 * (1 + static_cast<int>(x / 15));
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    const SineCosine at = sine_cosine(360.0 * i / points);
    sum += sine_cosine(x * at.sine * (180 / std::numbers::pi)).cosine * at.cosine * at.cosine;
  }
  return sum / points;
}

/// Fourier transform of a disc of diameter 1 and area 1: 2 J1(pi f) / (pi f).
double disc_transform(double f) { return 2 * bessel_j1_over_x(std::numbers::pi * f); }

/// Fourier transform of one phosphor at a frequency, 1 at frequency 0.
double phosphor_transform(const CrtTube& tube, double fx, double fy) {
  const double stripe = kStripeWidth * tube.pitch_mm / 3;
  switch (tube.mask) {
    case ShadowMask::dots: {
      const double diameter = kDotDiameter * tube.pitch_mm / std::numbers::sqrt3;
      return disc_transform(diameter * std::sqrt(fx * fx + fy * fy));
    }
    case ShadowMask::slots: {
      const double length = kSlotLength * mask_cell(tube).height_mm;
      return stripe_transform(fx * stripe) * stripe_transform(fy * length);
    }
    default: return fy == 0 ? stripe_transform(fx * stripe) : 0;
  }
}

double cosine_of_turns(double turns) { return sine_cosine(360 * turns).cosine; }

}  // namespace

MaskCell mask_cell(const CrtTube& tube) {
  const double p = tube.pitch_mm;
  // Dots of one colour form a hexagonal grid: columns sqrt(3)/2 p apart, shifted by p / 2 against each other.
  if (tube.mask == ShadowMask::dots)
    return {std::numbers::sqrt3 * p, p, p / std::numbers::sqrt3, std::numbers::sqrt3 / 2 * p};
  return {2 * p, tube.slot_height_mm > 0 ? tube.slot_height_mm : kDefaultSlotHeight * p, p / 3, p};
}

PatternTables mask_tables(const CrtTube& tube, const PixelGrid& columns, const PixelGrid& rows,
                          double pixel_mm) {
  const MaskCell cell = mask_cell(tube);
  const double limit = 1 / (2 * pixel_mm);  // half of the sampling rate, per mm
  const int i_end = static_cast<int>(std::ceil(limit * cell.width_mm));
  const int j_end = static_cast<int>(std::ceil(limit * cell.height_mm));
  PatternTables tables;
  for (int j = 0; j < j_end; ++j) {
    const double fy = j / cell.height_mm;
    std::vector<double> amplitudes(static_cast<std::size_t>(i_end), 0.0);  // factors of cos(2 pi i x / X)
    bool is_empty = true;
    for (int i = j % 2; i < i_end; i += 2) {  // two phosphors per cell cancel terms with i + j odd
      const double fx = i / cell.width_mm;
      const double weight = fejer_weight(fx, limit) * fejer_weight(fy, limit);
      const double twice = (i > 0 ? 2 : 1) * (j > 0 ? 2 : 1);  // frequencies i and -i, j and -j
      const double amplitude = twice * weight * phosphor_transform(tube, fx, fy);
      amplitudes[static_cast<std::size_t>(i)] = amplitude;
      is_empty = is_empty && std::abs(amplitude) < 1e-5;
    }
    if (is_empty) continue;
    for (std::size_t color = 0; color < 3; ++color) {
      std::vector<float>& factors = tables.column_factors[color].emplace_back();
      const double shift = (static_cast<double>(color) - 1) * cell.color_shift_mm;
      for (int column = 0; column < columns.count; ++column) {
        const double turns = (columns.center_mm(column) - shift) / cell.width_mm;
        double sum = 0;
        for (int i = j % 2; i < i_end; i += 2)
          sum += amplitudes[static_cast<std::size_t>(i)] * cosine_of_turns(i * turns);
        factors.push_back(static_cast<float>(sum));
      }
    }
    std::vector<float>& factors = tables.row_factors.emplace_back();
    for (int row = 0; row < rows.count; ++row)
      factors.push_back(static_cast<float>(cosine_of_turns(rows.center_mm(row) * fy)));
  }
  return tables;
}

}  // namespace tessera::detail
