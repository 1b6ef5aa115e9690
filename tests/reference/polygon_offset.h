// What polygon offset adds to the depths of one polygon.
#pragma once

#include "rasterize.h"
#include "scene.h"

namespace tessera::reference {

/// The smallest difference of depths: one level of a unorm format, whatever the depth; of float the step at the exponent of
/// `largest_depth` (as Direct3D 11). 0 without a depth buffer.
double smallest_difference(DepthFormat format, double largest_depth);

double depth_offset(const PolygonOffset& offset, const WindowPolygon& polygon, DepthFormat format);

}  // namespace tessera::reference
