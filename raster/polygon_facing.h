// Which side of a polygon is seen, where polygons are split into several triangles: the whole decides, not
// the triangle.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tessera::detail {

struct BinDraw;

/// What all triangles of a polygon share. dropped: one of its vertices is not finite.
enum class Facing : std::uint8_t { back, front, dropped };

/// Of the polygons of `per_polygon` triangles that begin in [first, last): writes `facing` of all their
/// triangles, by the sign of the area in the window of what clipping leaves of them [GL 2.1, 3.5.1]. An area
/// of 0 is a front, whichever way fronts turn.
void classify_polygon_facing(const BinDraw& draw, std::size_t per_polygon, std::size_t first,
                             std::size_t last, Facing* facing);

}  // namespace tessera::detail
