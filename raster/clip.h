// Cuts triangles in homogeneous space against the near and far planes and the guard band.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "raster/vertex_transform.h"

namespace tessera::detail {

/// Floats of an attribute record are interpolated linearly in clip space, as the position is.
inline constexpr int kMaxAttributes =
    16;  // normal, position, colour with alpha, texture coordinates, a captured normal
/// Floats that may be read behind those of any record, so that whole vectors can be loaded.
inline constexpr int kAttributePadding = 16;

struct ClipVertex {
  ClipPosition position;
  std::optional<std::array<float, 4>> object{};  ///< a mesh's own vertex, of which the position is the
                                                 ///< rounded transform, times 2^object_exponent
  int object_exponent = 0;
  bool needs_exact = false;  ///< see TransformedVertex
  float attributes[kMaxAttributes] = {};
};

inline constexpr int kMaxClippedVertices = 3 + 6;

/// The part of the triangle inside every plane in `outcodes` (the three vertices' outcodes or-ed), as a
/// convex polygon of at most kMaxClippedVertices vertices in the triangle's own order; empty if nothing is
/// left. Whatever else has been cut off before, an edge is cut between the triangle's own vertices, and
/// either way round alike, so neighbours that share it get the very same point. In double; exactly where
/// doubles have not the digits, since what is cut is very much larger than what is seen of it. Based on: I.
/// Sutherland, G. Hodgman, Reentrant Polygon Clipping, CACM 1974.
struct ClippedPolygon {
  ClipVertex vertices[kMaxClippedVertices];
  int count = 0;
};
ClippedPolygon clip_triangle(const VertexTransform& transform, const ClipVertex (&triangle)[3],
                             std::uint8_t outcodes, int attribute_count);

/// A vertex of what is left, and what the edge from it to the next lies on.
struct ClipCorner {
  ClipVertex vertex;
  int edge = 0;        ///< the polygon's own, from its vertex of that number on; or
  Outcode plane = {};  ///< if that is below 0
};
/// The same of convex polygons of any number of vertices. Its memory is used for one after the other.
class PolygonClipper {
 public:
  /// What is left is found in `polygon`. Throws std::bad_alloc.
  void clip(const VertexTransform& transform, std::vector<ClipVertex>& polygon, std::uint8_t outcodes,
            int attribute_count);

 private:
  std::vector<ClipCorner> corners_, kept_;
};
/// Shortens a line to its part inside every plane in `outcodes`, with the same points where an edge of a
/// triangle is cut. False if nothing is left.
bool clip_line(const VertexTransform& transform, ClipVertex (&line)[2], std::uint8_t outcodes,
               int attribute_count);
/// Whether a point is inside the view volume, its border included. Infinite far planes have no outside.
bool is_in_view(const VertexTransform& transform, const ClipPosition& position);
/// The same without a look at the near and far planes.
bool is_inside_side_planes(const ClipPosition& position);

}  // namespace tessera::detail
