// Polygon offset of one polygon.
#pragma once

#include <span>

#include "rasterize_polygon.h"
#include "scene.h"

namespace tessera::reference {

/// Smallest depth difference: one level of a unorm format; for float the step at the exponent of
/// `largest_depth` (as in Direct3D 11). 0 without a depth buffer.
double smallest_difference(DepthFormat format, double largest_depth);

/// @param triangles  of one polygon. For a non-planar polygon the slope is that of the triangle with the
///     largest area.
double depth_offset(const PolygonOffset& offset, std::span<const WindowPolygon> triangles,
                    DepthFormat format);

}  // namespace tessera::reference
