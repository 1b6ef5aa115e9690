// k-means of weighted colours in OKLab. S. Lloyd, Least squares quantization in PCM, 1982.
#pragma once

#include <vector>

#include "framebuffer/color_points.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// Improves centres: moves each to the mean of the points that are nearest to it, up to `max_rounds` times or
/// until nothing changes.
/// - A centre without points moves to the point whose error, weight times squared distance, is largest.
/// - Same bits for every instruction set. Throws std::bad_alloc only.
/// @param centers  at least one; the result has as many, in the same order
std::vector<Oklab> k_means(const ColorPoints& points, std::vector<Oklab> centers, int max_rounds,
                           InstructionSet isa);

/// Sum of the squared distances of all points to their nearest centres, times their weights.
double clustering_error(const ColorPoints& points, const std::vector<Oklab>& centers, InstructionSet isa);

}  // namespace tessera::detail
