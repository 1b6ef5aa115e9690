// Polygon offset of whole polygons, where they are split into several triangles, cut, or drawn as lines or
// points.
#pragma once

#include <cstddef>

namespace tessera::detail {

struct BinDraw;

/// Of the polygons of `per_polygon` triangles that begin in [first, last), to all of their triangles: factor
/// times the polygon's slope, that of the largest triangle that is seen of it, and within it of the largest
/// part that clipping left, plus units times the smallest difference of the format at its largest depth
/// [GL 2.1, 3.5.5; floats as Direct3D 11]. In units of depth words (unorm) or of depth. NaN for a triangle
/// alone that nothing cuts: it has its own, of the same plane as its depth.
void offset_polygons(const BinDraw& draw, std::size_t per_polygon, float factor, float units,
                     std::size_t first, std::size_t last, double* offsets);

}  // namespace tessera::detail
