// Polygons whose boundaries or corners are drawn.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "raster/binning.h"

namespace tessera {
namespace {

double depth_of(DepthKind kind, std::uint32_t z) {
  if (kind != DepthKind::float32) return z;
  float depth;
  std::memcpy(&depth, &z, sizeof depth);
  return depth;
}

// max(|dz/dx|, |dz/dy|) of a triangle, for each pixel.
double slope_of(DepthKind kind, const WindowVertex& a, const WindowVertex& b, const WindowVertex& c) {
  const double area = doubled_area(a, b, c);
  if (area == 0) return 0;
  const double z = depth_of(kind, a.z), to_b = depth_of(kind, b.z) - z, to_c = depth_of(kind, c.z) - z;
  const double by_x = to_b * (c.y - a.y) - to_c * (b.y - a.y), by_y = to_c * (b.x - a.x) - to_b * (c.x - a.x);
  return std::max(std::abs(by_x), std::abs(by_y)) * kSubpixelScale / std::abs(area);
}

WindowPolygon in_window(const BinDraw& draw, std::uint32_t triangle) {
  std::uint8_t codes = 0;
  for (int k = 0; draw.any_code && k < 3; ++k) codes |= draw.codes[vertex_index(draw, triangle, k)];
  if (codes != 0) return clip_to_window(draw, triangle, codes, 0);
  WindowPolygon polygon;
  polygon.clipped.count = 3;
  for (int k = 0; k < 3; ++k) polygon.window[k] = draw.vertices[vertex_index(draw, triangle, k)];
  polygon.area = doubled_area(polygon.window[0], polygon.window[1], polygon.window[2]);
  return polygon;
}

// Of the whole polygon [GL 2.1, 3.5.5]: its slope is that of the largest triangle that is seen of it. In units of depth words, or of depth.
double depth_offset(const BinDraw& draw, std::uint32_t first, std::size_t triangles) {
  const PolygonModes& modes = *draw.modes;
  const DepthKind kind = draw.transform->depth;
  if (kind == DepthKind::none || (modes.offset_factor == 0 && modes.offset_units == 0)) return 0;
  double slope = 0, largest_area = 0, largest_depth = 0;
  for (std::uint32_t t = first; t < first + triangles; ++t) {
    const WindowPolygon polygon = in_window(draw, t);
    for (int i = 0; i < polygon.clipped.count; ++i) {
      largest_depth = std::max(largest_depth, depth_of(kind, polygon.window[i].z));
      if (i < 2) continue;
      const double area = std::abs(doubled_area(polygon.window[0], polygon.window[i - 1], polygon.window[i]));
      if (area <= largest_area) continue;
      largest_area = area;
      slope = slope_of(kind, polygon.window[0], polygon.window[i - 1], polygon.window[i]);
    }
  }
  const int exponent = kind != DepthKind::float32 ? 32 - depth_bits(kind) : std::max(largest_depth > 0 ? std::ilogb(largest_depth) : -126, -126) - 23;
  return modes.offset_factor * slope + std::ldexp(double{modes.offset_units}, exponent);
}

/// The boundary of what clipping leaves of a polygon.
struct Boundary {
  std::vector<ClipVertex> vertices;
  std::vector<WindowVertex> window;
};

Boundary boundary_of(const BinDraw& draw, std::uint32_t first_triangle) {
  const std::size_t corners = draw.modes->triangles + 2;
  const std::uint32_t* const vertices = draw.modes->boundary + first_triangle / draw.modes->triangles * corners;
  BinDraw by_vertex = draw;  // its elements are single vertices
  by_vertex.topology = Topology::points;
  by_vertex.indices = vertices;
  Boundary boundary;
  std::uint8_t codes = 0;
  for (std::uint32_t i = 0; i < corners; ++i) {
    if (draw.any_code) codes |= draw.codes[vertices[i]];
    boundary.vertices.push_back(clip_vertex(by_vertex, i, 0, draw.attribute_count));
  }
  if (codes != 0) {
    boundary.vertices = clip_polygon(*draw.transform, std::move(boundary.vertices), codes, draw.attribute_count);
    for (const ClipVertex& v : boundary.vertices) boundary.window.push_back(project(*draw.transform, v.position));
  } else {
    for (std::size_t i = 0; i < corners; ++i) boundary.window.push_back(draw.vertices[vertices[i]]);
  }
  return boundary;
}

void add_piece(Bins& bins, const Boundary& boundary, const std::vector<std::size_t>& corners, std::uint32_t source, double offset) {
  ClippedTriangle& piece = bins.clipped.emplace_back();
  piece.source = source;
  piece.depth_offset = offset;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    piece.vertices[k] = boundary.window[corners[k]];
    std::copy_n(boundary.vertices[corners[k]].attributes, kMaxAttributes, piece.attributes[k]);
  }
}

// Returns whether any of it is seen.
bool bin_outline(Bins& bins, const TileGrid& grid, const BinDraw& draw, PolygonStyle style, std::uint32_t first) {
  const PolygonModes& modes = *draw.modes;
  const Boundary boundary = boundary_of(draw, first);
  const std::size_t corners = boundary.vertices.size();
  const double offset = corners == 0 ? 0 : depth_offset(draw, first, modes.triangles);
  BinDraw part = draw;
  part.draw = modes.draw[static_cast<int>(style)];
  part.size = style == PolygonStyle::line ? modes.line_width : modes.point_size;
  const bool lines = style == PolygonStyle::line;
  bool any = false;
  for (std::size_t i = 0; i < corners; ++i) {
    if (!lines && !is_between_sides(boundary.vertices[i].position)) continue;
    add_piece(bins, boundary, lines ? std::vector{i, i + 1 == corners ? 0 : i + 1} : std::vector{i}, first, offset);
    const bool is_seen = lines ? bin_line_piece(bins, grid, part) : bin_point_piece(bins, grid, part);
    if (!is_seen) bins.clipped.pop_back();
    any |= is_seen;
  }
  return any;
}

}  // namespace

void bin_polygons(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first, std::uint32_t last, Isa isa) {
  const PolygonModes& modes = *draw.modes;
  const auto each = static_cast<std::uint32_t>(modes.triangles);
  BinDraw filled = draw;
  filled.draw = modes.draw[static_cast<int>(PolygonStyle::fill)];
  for (std::uint32_t t = (first + each - 1) / each * each; t < last; t += each) {
    const Facing facing = draw.facing[t];
    const bool front = facing == Facing::front;
    const PolygonStyle style = modes.style[front ? 0 : 1];
    if (facing != Facing::dropped && (front ? draw.keep_front : draw.keep_back) && style == PolygonStyle::fill) {
      bin_triangles(bins, grid, filled, t, t + each, isa);
      continue;
    }
    BinCounts& counts = bins.counts;
    counts.triangles_in += each;
    if (facing == Facing::dropped)
      counts.non_finite += each;
    else if (!(front ? draw.keep_front : draw.keep_back))
      counts.culled += each;
    else
      (bin_outline(bins, grid, draw, style, t) ? counts.binned : counts.outside) += each;
  }
}

}  // namespace tessera
