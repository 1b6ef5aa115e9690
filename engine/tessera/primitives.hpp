// Primitive types, and the number of primitives in a list of vertices or indices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tessera {

/// Assembly of vertices into primitives, in order [GL 2.1, 2.6.1].
/// - Lines cover pixels by the diamond-exit rule; a loop returns to its first vertex.
/// - Quads are split from their first to their third vertex, quads of a strip from the first to the last of
///   their four vertices. Polygons must be convex and are split as fans around their first vertex.
/// - Facing and generated normals belong to the whole quad or polygon.
enum class Primitive : std::uint8_t {
  points,
  lines,
  line_strip,
  line_loop,
  triangles,
  triangle_strip,
  triangle_fan,
  quads,
  quad_strip,
  polygon
};

/// The vertex that gives a flat-shaded primitive its colour.
enum class ProvokingVertex : std::uint8_t { last, first };

/// Name of a mesh of these primitives, for messages: "a triangle strip".
constexpr std::string_view name_of_mesh(Primitive primitive) {
  switch (primitive) {
    case Primitive::points: return "points";
    case Primitive::lines: return "lines";
    case Primitive::line_strip: return "a line strip";
    case Primitive::line_loop: return "a line loop";
    case Primitive::triangles: return "triangles";
    case Primitive::triangle_strip: return "a triangle strip";
    case Primitive::triangle_fan: return "a triangle fan";
    case Primitive::quads: return "quads";
    case Primitive::quad_strip: return "a quad strip";
    case Primitive::polygon: return "a polygon";
  }
  return "";
}

/// Whether a number of corners makes whole primitives; true for 0. Corners are indices, or vertices if a mesh
/// has no indices.
constexpr bool makes_whole_primitives(Primitive primitive, std::size_t corners) {
  switch (primitive) {
    case Primitive::points: return true;
    case Primitive::lines: return corners % 2 == 0;
    case Primitive::line_strip:
    case Primitive::line_loop: return corners != 1;
    case Primitive::triangles: return corners % 3 == 0;
    case Primitive::quads: return corners % 4 == 0;
    case Primitive::quad_strip: return corners % 2 == 0 && corners != 2;
    case Primitive::triangle_strip:
    case Primitive::triangle_fan:
    case Primitive::polygon: return corners == 0 || corners >= 3;
  }
  return false;
}
/// The condition of makes_whole_primitives() in words: "a multiple of 3", "3 or more", ...
constexpr std::string_view corners_needed(Primitive primitive) {
  switch (primitive) {
    case Primitive::lines: return "a multiple of 2";
    case Primitive::line_strip:
    case Primitive::line_loop: return "2 or more";
    case Primitive::triangles: return "a multiple of 3";
    case Primitive::quads: return "a multiple of 4";
    case Primitive::quad_strip: return "4, 6, 8, ...";
    default: return "3 or more";
  }
}

/// Number of points, lines or triangles made from the corners. @pre makes_whole_primitives
constexpr std::size_t element_count(Primitive primitive, std::size_t corners) {
  switch (primitive) {
    case Primitive::points:
    case Primitive::line_loop: return corners;
    case Primitive::lines: return corners / 2;
    case Primitive::line_strip: return corners == 0 ? 0 : corners - 1;
    case Primitive::triangles: return corners / 3;
    case Primitive::quads: return corners / 4 * 2;
    default: return corners < 3 ? 0 : corners - 2;
  }
}

}  // namespace tessera
