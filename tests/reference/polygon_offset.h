// What polygon offset adds to the depths of one polygon.
#pragma once

#include <span>

#include "rasterize_polygon.h"
#include "scene.h"

namespace tessera::reference {

/// The smallest difference of depths: one level of a unorm format, whatever the depth; of float the step at
/// the exponent of `largest_depth` (as Direct3D 11). 0 without a depth buffer.
double smallest_difference(DepthFormat format, double largest_depth);

/// @param triangles  of one polygon. If it is not quite flat, the slope is that of the largest.
double depth_offset(const PolygonOffset& offset, std::span<const WindowPolygon> triangles,
                    DepthFormat format);

}  // namespace tessera::reference
