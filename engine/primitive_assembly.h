// How the vertices of a mesh make points, lines and polygons, and polygons triangles.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "engine/tessera/tessera.hpp"
#include "raster/topology.h"

namespace tessera {

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

constexpr Topology topology_of(Primitive primitive) {
  switch (primitive) {
    case Primitive::points: return Topology::points;
    case Primitive::lines:
    case Primitive::line_strip:
    case Primitive::line_loop: return Topology::lines;
    default: return Topology::triangles;
  }
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

/// Corner numbers of element t, as many as it has, those of a triangle in the order of its polygon. Its
/// provoking vertex stands in provoking_place(), unless that says that it is elsewhere.
/// @param corners  of the whole mesh
constexpr std::array<std::size_t, 3> element_corners(Primitive primitive, ProvokingVertex provoking,
                                                     std::size_t corners, std::size_t t) {
  const bool last = provoking == ProvokingVertex::last;
  switch (primitive) {
    case Primitive::points: return {t};
    case Primitive::lines: return {2 * t, 2 * t + 1};
    case Primitive::line_strip: return {t, t + 1};
    case Primitive::line_loop: return {t, t + 1 == corners ? 0 : t + 1};
    case Primitive::triangles: return {3 * t, 3 * t + 1, 3 * t + 2};
    case Primitive::triangle_strip:  // every second one is turned over, around its provoking vertex
      if (t % 2 == 0) return {t, t + 1, t + 2};
      return last ? std::array{t + 1, t, t + 2} : std::array{t, t + 2, t + 1};
    case Primitive::triangle_fan:
      return last ? std::array{std::size_t{0}, t + 1, t + 2} : std::array{t + 1, t + 2, std::size_t{0}};
    case Primitive::quads: {
      const std::size_t v = t / 2 * 4;
      return t % 2 == 0 ? std::array{v, v + 1, v + 2} : std::array{v, v + 2, v + 3};
    }
    case Primitive::quad_strip: {  // around its quad: v, v + 1, v + 3, v + 2
      const std::size_t v = t / 2 * 2;
      if (t % 2 == 0) return {v, v + 1, v + 3};
      return last ? std::array{v + 2, v, v + 3} : std::array{v, v + 3, v + 2};
    }
    case Primitive::polygon: return {0, t + 1, t + 2};
  }
  return {};
}

/// Which of its corners is every element's provoking one; -1: of some triangles it is another corner of their
/// polygon.
constexpr int provoking_place(Primitive primitive, ProvokingVertex provoking) {
  if (topology_of(primitive) == Topology::points) return 0;
  if (topology_of(primitive) == Topology::lines) return provoking == ProvokingVertex::first ? 0 : 1;
  if (primitive == Primitive::polygon) return 0;
  if (provoking == ProvokingVertex::first) return 0;
  return primitive == Primitive::quads ? -1 : 2;
}
/// The provoking corner of element t, or of its polygon.
constexpr std::size_t provoking_corner(Primitive primitive, ProvokingVertex provoking, std::size_t corners,
                                       std::size_t t) {
  const int place = provoking_place(primitive, provoking);
  return place < 0 ? t / 2 * 4 + 3
                   : element_corners(primitive, provoking, corners, t)[static_cast<std::size_t>(place)];
}

/// The corner that triangle t of a polygon has, and those of the polygon before it have not. @pre it is not
/// the polygon's first
constexpr std::size_t added_corner(Primitive primitive, std::size_t t) {
  switch (primitive) {
    case Primitive::quads: return t / 2 * 4 + 3;
    case Primitive::quad_strip: return t / 2 * 2 + 2;
    default: return t + 2;
  }
}

/// Triangles that each polygon was split into; 1 for strips and fans, whose triangles are polygons of their
/// own, and for points and lines.
constexpr std::size_t triangles_of_polygon(Primitive primitive, std::size_t triangles) {
  switch (primitive) {
    case Primitive::quads:
    case Primitive::quad_strip: return 2;
    case Primitive::polygon: return triangles;
    default: return 1;
  }
}

}  // namespace tessera
