// Clipping of triangles, polygons and lines in homogeneous space against the near and far planes and the
// guard band.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "raster/vertex_transform.h"

namespace tessera::detail {

/// Largest number of floats in an attribute record: normal, position, colour with alpha, texture coordinates,
/// a captured normal, and what user stages read. Attributes are interpolated linearly in clip space, as
/// positions are.
inline constexpr int kMaxAttributes = 28;
/// Readable floats beyond the end of any attribute record, for loads of whole vectors.
inline constexpr int kAttributePadding = 16;

struct ClipVertex {
  ClipPosition position;
  /// Object-space position of a mesh vertex; absent for vertices made by clipping. `position` is its rounded
  /// transform times 2^object_exponent.
  std::optional<std::array<float, 4>> object{};
  int object_exponent = 0;
  bool needs_exact = false;  ///< see TransformedVertex
  float attributes[kMaxAttributes] = {};
};

inline constexpr int kMaxClippedVertices = 3 + 6;  ///< each of six planes adds at most one vertex

/// A convex polygon in clip space, in the vertex order of the triangle; count 0: nothing remains.
struct ClippedPolygon {
  ClipVertex vertices[kMaxClippedVertices];
  int count = 0;
};
/// Clips a triangle to the planes in `outcodes`, the bitwise or of its vertices' outcodes.
/// - Edges are cut between the triangle's original vertices, independent of earlier cuts and of direction, so
///   that triangles sharing an edge get identical points.
/// - In double; exact arithmetic where the clipped primitive is so much larger than its visible part that
///   doubles lack digits.
///
/// Based on: I. Sutherland, G. Hodgman, Reentrant Polygon Clipping, CACM 1974.
ClippedPolygon clip_triangle(const VertexTransform& transform, const ClipVertex (&triangle)[3],
                             std::uint8_t outcodes, int attribute_count);

/// A vertex of a polygon during clipping, and the origin of the edge that starts at it.
struct ClipCorner {
  ClipVertex vertex;
  int edge = 0;        ///< original edge, numbered by its first vertex; -1: the edge lies on `plane`
  Outcode plane = {};  ///< clip plane that made the edge, if edge is -1
};
/// Clips convex polygons of any number of vertices; reuses its memory.
class PolygonClipper {
 public:
  /// Replaces `polygon` by its clipped part. Rules and `outcodes` as for clip_triangle(). Throws
  /// std::bad_alloc.
  void clip(const VertexTransform& transform, std::vector<ClipVertex>& polygon, std::uint8_t outcodes,
            int attribute_count);

 private:
  std::vector<ClipCorner> corners_, kept_;
};
/// Clips a line to the planes in `outcodes`; cut points equal those of a triangle's edge. False if nothing
/// remains.
bool clip_line(const VertexTransform& transform, ClipVertex (&line)[2], std::uint8_t outcodes,
               int attribute_count);
/// True if a point is inside the view volume or on its border. Nothing lies beyond an infinite far plane.
bool is_in_view(const VertexTransform& transform, const ClipPosition& position);
/// True if a point is inside the left, right, bottom and top planes of the view volume or on them.
bool is_inside_side_planes(const ClipPosition& position);

}  // namespace tessera::detail
