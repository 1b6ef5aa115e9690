// Rows of light -> rows of the image: vertical spread, mask, colour, sRGB.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// A weighted row of light.
struct WeightedRow {
  const float* light;
  float weight;
};

/// One row of the image.
struct ImageRow {
  int columns;
  int colors;                                     ///< primaries of the display: 3, or 1 for monochrome ones
  std::array<std::vector<WeightedRow>, 3> light;  ///< per colour: rows that reach this one
  /// Mask: the sum of row_factors[j] * column_factors[color][j][column]. No terms: no mask.
  std::vector<float> row_factors;
  std::array<std::vector<const float*>, 3> column_factors;
  /// Light that the glass scatters. It is not masked.
  std::array<std::vector<WeightedRow>, 3> scattered;
  /// Linear sRGB of light 1 of each colour, scaled so that the brightest pixel of white is 1.
  std::array<std::array<float, 3>, 3> srgb_from_light;  ///< [component][color]
  std::uint8_t* rgb;                                    ///< sRGB, 3 bytes per pixel; may be null
  float* light_out;                                     ///< linear sRGB, 3 floats per pixel; may be null
};

using ImageRowFn = void(const ImageRow& row);
ImageRowFn* image_row_for(InstructionSet isa);

/// 8-bit sRGB of linear light; below 0 counts as 0, above 1 as 1. The kernels do the same.
/// - Equals the rounded value of the curve, except within 0.003 of a level from a tie.
std::uint8_t srgb_code(float light);

}  // namespace tessera::detail
