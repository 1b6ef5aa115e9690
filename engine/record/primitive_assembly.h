// Assembly of vertices into points, lines and polygons, and splitting of polygons into triangles.
#pragma once

#include <array>
#include <cstddef>

#include "engine/tessera/primitives.hpp"
#include "raster/topology.h"

namespace tessera::detail {

constexpr Topology topology_of(Primitive primitive) {
  switch (primitive) {
    case Primitive::points: return Topology::points;
    case Primitive::lines:
    case Primitive::line_strip:
    case Primitive::line_loop: return Topology::lines;
    default: return Topology::triangles;
  }
}

/// Corner numbers of element t of a mesh.
/// - Triangles have the winding of their polygon.
/// - The provoking vertex is at provoking_place(), unless that is -1.
/// @param corners  number of corners of the mesh
constexpr std::array<std::size_t, 3> element_corners(Primitive primitive, ProvokingVertex provoking,
                                                     std::size_t corners, std::size_t t) {
  const bool last = provoking == ProvokingVertex::last;
  switch (primitive) {
    case Primitive::points: return {t};
    case Primitive::lines: return {2 * t, 2 * t + 1};
    case Primitive::line_strip: return {t, t + 1};
    case Primitive::line_loop: return {t, t + 1 == corners ? 0 : t + 1};
    case Primitive::triangles: return {3 * t, 3 * t + 1, 3 * t + 2};
    case Primitive::triangle_strip:  // odd triangles swap the two other corners, to keep the winding
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

/// Place of the provoking vertex in element_corners(): 0 to 2.
/// -1 for quads whose last vertex is provoking: the first triangle of a quad lacks that vertex.
constexpr int provoking_place(Primitive primitive, ProvokingVertex provoking) {
  if (provoking == ProvokingVertex::first || primitive == Primitive::polygon) return 0;
  if (primitive == Primitive::quads) return -1;
  return corners_of(topology_of(primitive)) - 1;
}
/// Corner number of the vertex that gives element t, or the whole quad or polygon around it, its flat colour.
constexpr std::size_t provoking_corner(Primitive primitive, ProvokingVertex provoking, std::size_t corners,
                                       std::size_t t) {
  const int place = provoking_place(primitive, provoking);
  return place < 0 ? t / 2 * 4 + 3
                   : element_corners(primitive, provoking, corners, t)[static_cast<std::size_t>(place)];
}

/// Corner number of the vertex that triangle t adds to the earlier triangles of its polygon.
/// @pre t is not the first triangle of its polygon
constexpr std::size_t added_corner(Primitive primitive, std::size_t t) {
  switch (primitive) {
    case Primitive::quads: return t / 2 * 4 + 3;
    case Primitive::quad_strip: return t / 2 * 2 + 2;
    default: return t + 2;
  }
}

/// Number of triangles per polygon; 1 for points, lines, and strips and fans of triangles.
constexpr std::size_t triangles_of_polygon(Primitive primitive, std::size_t triangles) {
  switch (primitive) {
    case Primitive::quads:
    case Primitive::quad_strip: return 2;
    case Primitive::polygon: return triangles;
    default: return 1;
  }
}

}  // namespace tessera::detail
