// Differences of pictures in levels: largest error, RMS error, PSNR, shares of wrong pixels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/program/compare/pixel_view.h"

namespace tessera::program {

/// Errors over red, green and blue, in levels of 255. Swapping the pictures changes nothing.
struct PictureErrors {
  /// [d]: number of pixels whose worst component differs by d levels.
  std::array<std::uint64_t, 256> pixels_by_error{};
  std::uint64_t pixels = 0;
  int largest = 0;     ///< largest difference of a component
  double rms = 0;      ///< root of the mean square difference over all components of all pixels
  double psnr_db = 0;  ///< 20 log10(255 / rms); infinite for equal pictures

  /// Number of pixels with a component that differs by more than `levels`, which is 0 to 255.
  std::uint64_t pixels_over(int levels) const;
  /// pixels_over() as a fraction of all pixels.
  double share_over(int levels) const;
};

/// - Sums are exact, so every machine returns the same bits.
/// @throws Error for pictures of different sizes
PictureErrors picture_errors(const PixelView& picture, const PixelView& reference);

/// Errors against colours that were not rounded to levels, in levels of 255.
struct UnroundedErrors {
  double largest = 0;
  double rms = 0;
};

/// - Rounding alone gives an RMS of 1/sqrt(12) = 0.289 levels where colours vary smoothly.
/// - Sums run over the components in order, so every machine returns the same bits.
/// @param reference  red, green and blue of each pixel, 1 is full intensity; rows from the top without gaps
/// @throws Error if `reference` has a different number of pixels
UnroundedErrors unrounded_errors(const PixelView& picture, std::span<const float> reference);

}  // namespace tessera::program
