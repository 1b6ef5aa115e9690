// Kinds of primitives, and how many of them a list of vertices or indices makes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tessera {

/// What the vertices of a mesh make, in their order [GL 2.1, 2.6.1]. Lines cover pixels by the diamond-exit
/// rule; a loop goes back to its first vertex. Quads are split from their first to their third vertex, those
/// of a strip from the first to the last of its four, polygons, which are convex, from their first vertex to
/// all others. Which side of a quad or polygon is seen is a matter of the whole of it; so are its generated
/// normals.
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

/// The vertex of a primitive whose colour a flat-shaded primitive has.
enum class ProvokingVertex : std::uint8_t { last, first };

/// The name of a primitive's meshes, for messages: "a triangle strip".
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

/// Whether so many corners (indices, or vertices where there are none) make whole primitives; none at all do.
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
/// "a multiple of 3", "3 or more", ...: what makes_whole_primitives() asks for.
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

/// Points, lines or triangles that so many corners make. @pre makes_whole_primitives
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
