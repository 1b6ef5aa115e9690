// Cuts triangles in homogeneous space against the near and far planes and the guard band.
#pragma once

#include <cstdint>
#include <vector>

#include "raster/vertex_transform.h"

namespace tessera {

/// Floats of an attribute record are interpolated linearly in clip space, as the position is.
inline constexpr int kMaxAttributes = 16;  // normal, position, colour with alpha, texture coordinates, a captured normal
/// Floats that may be read from the start of any record, so that whole vectors can be loaded.
inline constexpr int kAttributePadding = 16;

struct ClipVertex {
  ClipPosition position;
  float attributes[kMaxAttributes] = {};
};

inline constexpr int kMaxClippedVertices = 3 + 6;

/// The part of the triangle inside every plane in `codes` (the three vertices' codes or-ed), as a convex polygon of at most
/// kMaxClippedVertices vertices in the triangle's own order; empty if nothing is left. An edge is always cut from its inner to its outer
/// end, so neighbours that share it get the very same point. All in double.
/// Based on: I. Sutherland, G. Hodgman, Reentrant Polygon Clipping, CACM 1974.
struct ClippedPolygon {
  ClipVertex vertices[kMaxClippedVertices];
  int count = 0;
};
ClippedPolygon clip_triangle(const VertexTransform& transform, const ClipVertex (&triangle)[3], std::uint8_t codes, int attribute_count);

/// The same of a convex polygon of any number of vertices. Throws std::bad_alloc.
std::vector<ClipVertex> clip_polygon(const VertexTransform& transform, std::vector<ClipVertex> polygon, std::uint8_t codes, int attribute_count);
/// Shortens a line to its part inside every plane in `codes`, with the same points where an edge of a triangle is cut. False if nothing is left.
bool clip_line(const VertexTransform& transform, ClipVertex (&line)[2], std::uint8_t codes, int attribute_count);
/// Whether a point is inside the view volume, its border included. Infinite far planes have no outside.
bool is_in_view(const VertexTransform& transform, const ClipPosition& position);
/// The same without a look at the near and far planes.
bool is_between_sides(const ClipPosition& position);

}  // namespace tessera
