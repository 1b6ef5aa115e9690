// Binning of polygons in line or point mode: their boundary edges or corners.
#include <algorithm>
#include <vector>

#include "raster/binning.h"
#include "raster/clipped_triangles.h"

namespace tessera::detail {
namespace {

/// Sets `boundary` to the polygon's boundary after clipping. Returns true if the polygon was clipped without
/// being entirely outside a plane.
bool set_up_boundary(ClippedBoundary& boundary, const BinDraw& draw, std::uint32_t first_triangle) {
  auto& [vertices, window, clipper] = boundary;
  const std::size_t corners = draw.modes->triangles + 2;
  const std::uint32_t* const polygon =
      draw.modes->boundary + first_triangle / draw.modes->triangles * corners;
  vertices.clear();
  window.clear();
  std::uint8_t outcodes = 0;                          // bits set at any vertex
  std::uint8_t shared = draw.any_outcode ? 0xff : 0;  // bits set at all vertices
  for (std::size_t i = 0; i < corners; ++i) {
    if (draw.any_outcode) {
      outcodes |= draw.outcodes[polygon[i]];
      shared &= draw.outcodes[polygon[i]];
    }
    vertices.push_back(clip_vertex(draw, polygon[i], draw.attribute_count));
    window.push_back(draw.vertices[polygon[i]]);
  }
  if (outcodes == 0) return false;
  clipper.clip(*draw.transform, vertices, outcodes, draw.attribute_count);
  window.clear();
  for (const ClipVertex& v : vertices) window.push_back(project(*draw.transform, v.position));
  return shared == 0;
}

void add_corner(Bins& bins, const BinDraw& draw, DerivedPrimitive& derived, int k,
                const ClippedBoundary& boundary, std::size_t corner) {
  derived.vertices[k] = boundary.window[corner];
  std::copy_n(boundary.vertices[corner].attributes, draw.attribute_count,
              bins.attributes(derived) + k * draw.attribute_count);
}

// Bin the boundary's edges, or its corners, as derived primitives of triangle `source`. Return true if one
// was binned.
bool bin_edges(Bins& bins, const TileGrid& grid, const BinDraw& draw, const ClippedBoundary& boundary,
               std::uint32_t source) {
  bool any = false;
  for (std::size_t i = 0; i < boundary.vertices.size(); ++i) {
    DerivedPrimitive& derived = bins.add_derived(source, 2, draw.attribute_count);
    add_corner(bins, draw, derived, 0, boundary, i);
    add_corner(bins, draw, derived, 1, boundary, i + 1 == boundary.vertices.size() ? 0 : i + 1);
    const bool is_visible = bin_derived_line(bins, grid, draw);
    if (!is_visible) bins.drop_last_derived();
    any |= is_visible;
  }
  return any;
}
bool bin_corners(Bins& bins, const TileGrid& grid, const BinDraw& draw, const ClippedBoundary& boundary,
                 std::uint32_t source) {
  bool any = false;
  for (std::size_t i = 0; i < boundary.vertices.size(); ++i) {
    if (!is_inside_side_planes(boundary.vertices[i].position)) continue;
    add_corner(bins, draw, bins.add_derived(source, 1, draw.attribute_count), 0, boundary, i);
    const bool is_visible = bin_derived_point(bins, grid, draw);
    if (!is_visible) bins.drop_last_derived();
    any |= is_visible;
  }
  return any;
}

}  // namespace

void bin_polygons(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first,
                  std::uint32_t last, InstructionSet isa) {
  const PolygonModes& modes = *draw.modes;
  const auto per_polygon = static_cast<std::uint32_t>(modes.triangles);
  BinDraw filled = draw;
  BinDraw lines = draw;
  BinDraw corners = draw;
  filled.draw = modes.draw[static_cast<int>(PolygonMode::fill)];
  lines.draw = modes.draw[static_cast<int>(PolygonMode::line)];
  lines.point_line_size = modes.line_width;
  corners.draw = modes.draw[static_cast<int>(PolygonMode::point)];
  corners.point_line_size = modes.point_size;
  BinCounts& counts = bins.counts;
  for (std::uint32_t t = (first + per_polygon - 1) / per_polygon * per_polygon; t < last; t += per_polygon) {
    const Facing facing = draw.facing[t];
    const bool front = facing == Facing::front;
    const PolygonMode mode = modes.mode[front ? 0 : 1];
    if (facing == Facing::dropped) {
      counts.non_finite += per_polygon;
    } else if (!(front ? draw.keep_front : draw.keep_back)) {
      counts.culled += per_polygon;
    } else if (mode == PolygonMode::fill) {
      bin_triangles(bins, grid, filled, t, t + per_polygon, isa);
      continue;
    } else {
      if (set_up_boundary(bins.boundary, draw, t)) counts.clipped += per_polygon;
      const bool is_visible = mode == PolygonMode::line ? bin_edges(bins, grid, lines, bins.boundary, t)
                                                        : bin_corners(bins, grid, corners, bins.boundary, t);
      if (is_visible) counts.binned += per_polygon;
      else counts.outside += per_polygon;
    }
    counts.triangles_in += per_polygon;
  }
}

}  // namespace tessera::detail
