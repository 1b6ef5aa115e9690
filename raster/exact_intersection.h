// Exact intersections with clip planes, for primitives so much larger than their visible part that doubles
// lack digits.
#pragma once

#include <optional>

#include "raster/clip.h"

namespace tessera::detail {

/// Intersection of an edge with a plane; absent if it is not a single point. Attributes are clamped to the
/// range of the ends.
std::optional<ClipVertex> exact_edge_intersection(const VertexTransform& transform, Outcode plane,
                                                  const ClipVertex& a, const ClipVertex& b,
                                                  int attribute_count);
/// Intersection of a triangle with two planes; absent if it is not a single point. Attributes are clamped to
/// the range of the vertices.
std::optional<ClipVertex> exact_two_plane_intersection(const VertexTransform& transform, Outcode plane,
                                                       Outcode other, const ClipVertex& a,
                                                       const ClipVertex& b, const ClipVertex& c,
                                                       int attribute_count);

}  // namespace tessera::detail
