// Variance-based median cut: divides colours into boxes, each of which becomes a palette entry. After
// P. Heckbert, Color image quantization for frame buffer display, 1982, with the cuts of X. Wu, Color
// quantization by dynamic programming and principal analysis, 1992.
#pragma once

#include <cstddef>
#include <vector>

#include "framebuffer/color_points.h"

namespace tessera::detail {

/// Means of `count` groups of points, fewer if there are fewer points.
/// - Each step splits the group with the largest sum of squared distances to its mean, across its principal
///   axis, where the sums of the two parts are smallest.
/// - Throws std::bad_alloc only.
/// @param points  at least one, weights above 0
std::vector<Oklab> median_cut(const ColorPoints& points, std::size_t count);

}  // namespace tessera::detail
