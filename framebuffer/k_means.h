// k-means of weighted colours in OKLab. S. Lloyd, Least squares quantization in PCM, 1982.
#pragma once

#include <cstdint>
#include <vector>

#include "framebuffer/color_points.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// Centres without points. move: to the points whose errors, weight times squared distance, are largest.
enum class UnusedCenters : std::uint8_t { move, keep };

/// Improves centres: moves each to the mean of the points that are nearest to it, up to `max_rounds` times or
/// until nothing changes.
/// - Same bits for every instruction set. Throws std::bad_alloc only.
/// @param centers  at least one; the result has as many, in the same order
std::vector<Oklab> k_means(const ColorPoints& points, std::vector<Oklab> centers, int max_rounds,
                           InstructionSet isa, UnusedCenters unused = UnusedCenters::move);

/// Sum of the squared distances of all points to their nearest centres, times their weights.
double clustering_error(const ColorPoints& points, const std::vector<Oklab>& centers, InstructionSet isa);

}  // namespace tessera::detail
