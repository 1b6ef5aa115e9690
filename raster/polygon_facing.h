// Facing of polygons that are split into several triangles: the whole polygon decides, not each triangle.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tessera::detail {

struct BinDraw;

/// Facing shared by all triangles of a polygon. dropped: one of its vertices is not finite.
enum class Facing : std::uint8_t { back, front, dropped };

/// Classifies the polygons, of `per_polygon` triangles each, that begin in triangles [first, last), and
/// writes `facing` of all their triangles. The sign of the polygon's window area after clipping decides
/// [GL 2.1, 3.5.1]. An area of 0 is front-facing, whatever the winding of front faces.
void classify_polygon_facing(const BinDraw& draw, std::size_t per_polygon, std::size_t first,
                             std::size_t last, Facing* facing);

}  // namespace tessera::detail
