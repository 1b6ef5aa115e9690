// Splits polygons into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tessera::program {

/// Splits a polygon of n corners into n - 2 triangles, wound as the polygon.
/// - Quadrilaterals are split along the shorter diagonal, unless that leaves them.
/// - Larger polygons lose ears, beginning at the first corner: convex ones become a fan around it.
/// - Polygons are viewed along their mean normal. Those that cross themselves get some n - 2 triangles.
/// @param corners  at least 3
/// @return numbers of corners
std::vector<std::array<std::uint32_t, 3>> split_polygon(std::span<const std::array<float, 3>> corners);

/// The sum of the triangles' area normals, by Newell's method: a vector as long as twice the area.
/// - Source: I. E. Sutherland et al., A Characterization of Ten Hidden-Surface Algorithms, 1974.
std::array<double, 3> polygon_normal(std::span<const std::array<float, 3>> corners);

}  // namespace tessera::program
