// Polygon offset of whole polygons that are split into several triangles, clipped, or drawn as lines or
// points.
#pragma once

#include <cstddef>

namespace tessera::detail {

struct BinDraw;

/// Computes the offset of the polygons, of `per_polygon` triangles each, that begin in triangles [first,
/// last), and writes it to `offsets` of all their triangles.
/// - Offset: factor times the slope, plus units times the smallest difference of the format [GL 2.1, 3.5.5;
///   float32: at the polygon's largest depth, Direct3D 11].
/// - Slope: that of the polygon's largest visible triangle, and of the largest part if that triangle is
///   clipped.
/// - Unit: depth words (unorm) or depth (float32).
/// - NaN for a polygon of one triangle that is not clipped: its offset comes from its depth plane
///   (depth_offset-inl.h).
void offset_polygons(const BinDraw& draw, std::size_t per_polygon, float factor, float units,
                     std::size_t first, std::size_t last, double* offsets);

}  // namespace tessera::detail
