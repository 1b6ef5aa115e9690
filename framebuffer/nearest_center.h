// The nearest of several centres for each of many points in OKLab: the inner loop of k-means.
#pragma once

#include <cstdint>
#include <vector>

#include "framebuffer/color_points.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// For each point of a ColorPoints, padding included.
struct NearestCenters {
  std::vector<std::uint32_t> center;    ///< the nearest one, ties to the lowest index
  std::vector<float> squared_distance;  ///< to it
};

/// Finds the nearest centres. Equals nearest_centers_reference() bit for bit.
/// @param centers  at least one
void nearest_centers(const ColorPoints& points, const ColorPoints& centers, InstructionSet isa,
                     NearestCenters& result);

}  // namespace tessera::detail
