// One-dimensional filters of FLIP. Its two-dimensional filters are products, or sums of products, of these.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tessera::program {

/// A filter with weight(-k) = weight(k), or -weight(k) if it is odd.
struct SymmetricFilter {
  std::vector<double> weights;  ///< for offsets 0 .. radius
  bool odd = false;             ///< weights[0] is 0

  int radius() const { return static_cast<int>(weights.size()) - 1; }
};

struct FlipFilters {
  /// Contrast sensitivity of the eye: the colour planes are filtered along x and y by the same filter.
  /// The blue-yellow plane is the sum of two such filterings.
  SymmetricFilter luminance, red_green, blue_yellow_narrow, blue_yellow_wide;
  /// Edge and point detection: one derivative along an axis, `smooth` across it.
  SymmetricFilter smooth, first_derivative, second_derivative;

  /// Largest radius, in pixels.
  int radius() const { return std::max(luminance.radius(), smooth.radius()); }
};

FlipFilters flip_filters(double pixels_per_degree);

/// out[i] = sum over k of weight(k) * in[i + k * step], for i below `count`.
/// - Each sum runs from the smallest |k| to the largest, so its bits do not depend on `count`.
/// - Reads in[-radius * step] to in[count - 1 + radius * step].
/// @param step   1 filters along a row; the stride of the rows filters along a column
/// @param count  a multiple of kFilterBlock
void convolve(const SymmetricFilter& filter, const double* in, std::ptrdiff_t step, double* out, int count);
inline constexpr int kFilterBlock = 8;

}  // namespace tessera::program
