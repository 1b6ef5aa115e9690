// Where clip planes cut what is so large, beside what is seen of it, that doubles have no digits left for
// that.
#pragma once

#include <optional>

#include "raster/clip.h"

namespace tessera::detail {

/// The point of an edge on a plane. Absent if there is not just one. Attributes are within those of the ends.
std::optional<ClipVertex> exact_edge_intersection(const VertexTransform& transform, Outcode plane,
                                                  const ClipVertex& a, const ClipVertex& b,
                                                  int attribute_count);
/// The point of a triangle on two planes, likewise.
std::optional<ClipVertex> exact_two_plane_intersection(const VertexTransform& transform, Outcode plane,
                                                       Outcode other, const ClipVertex& a,
                                                       const ClipVertex& b, const ClipVertex& c,
                                                       int attribute_count);

}  // namespace tessera::detail
