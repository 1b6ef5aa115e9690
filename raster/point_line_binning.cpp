#include <algorithm>
#include <bit>
#include <cstdlib>

#include "raster/binning.h"
#include "raster/clipped_triangles.h"
#include "raster/point_line_coverage.h"

namespace tessera::detail {
namespace {

LinePoint point_of(const WindowVertex& v) { return {v.x, v.y}; }

// True if a point is inside the view volume. Window coordinates are rounded by up to half of 1/256 pixel, so
// the clip position is needed within 1/256 pixel of the viewport's border only.
bool is_in_view(const BinDraw& draw, std::uint32_t vertex, const WindowVertex& v) {
  const VertexTransform& t = *draw.transform;
  // Distances outside the viewport's border, 1/256 pixel; negative inside.
  const double x = std::abs(static_cast<double>(v.x) - t.center_x) - kSubpixelScale * t.half_width;
  const double y = std::abs(static_cast<double>(v.y) - t.center_y) - kSubpixelScale * t.half_height;
  if (x < -1 && y < -1) return true;
  if (x > 1 || y > 1) return false;
  return is_in_view(t, clip_vertex(draw, vertex, 0).position);
}

PixelRect bounds_of_point(const BinDraw& draw, LinePoint at) {
  if (draw.samples == 1) return intersect(point_square(at, rounded_size(draw.point_line_size)), draw.rect);
  // Reach of the disc, and of the square that is tested at pixel centres only.
  const std::int32_t reach = (rounded_size(draw.point_line_size) + 3) * kHalfPixel;
  return intersect(pixels_near(at, at, reach), draw.rect);
}

// Tiles that a rectangle of pixels touches. By shifts: divisions would dominate the cost of a point.
struct TileSpan {
  int x0, y0, x1, y1;  // inclusive
  int columns;         // columns of the grid
  TileSpan(const TileGrid& grid, const PixelRect& pixels) {
    const int shift = std::countr_zero(static_cast<unsigned>(grid.tile_size));
    x0 = pixels.x0 >> shift;
    y0 = pixels.y0 >> shift;
    x1 = (pixels.x1 - 1) >> shift;
    y1 = (pixels.y1 - 1) >> shift;
    columns = (grid.width_px + grid.tile_size - 1) >> shift;
  }
};

// Bins a line into the tiles that it may touch. Returns false if there are none.
bool bin_line(Bins& bins, const TileGrid& grid, const BinDraw& draw, LinePoint a, LinePoint b,
              std::uint32_t id) {
  const std::int32_t reach = line_reach(draw.point_line_size, draw.samples);
  const PixelRect pixels = intersect(pixels_near(a, b, reach), draw.rect);
  if (pixels.empty()) return false;
  const TileSpan tiles(grid, pixels);
  if (tiles.x0 == tiles.x1 && tiles.y0 == tiles.y1) {
    bins.push(tiles.y0 * tiles.columns + tiles.x0, draw.draw, id);
    return true;
  }
  // `across` is the distance of a tile's centre from the line, times the line's length. Within max_across,
  // the line touches the tile enlarged by `reach` on each side.
  const std::int64_t dx = std::int64_t{b.x} - a.x, dy = std::int64_t{b.y} - a.y;
  const std::int64_t half_tile = std::int64_t{grid.tile_size} * kHalfPixel;  // 1/256 pixel
  const std::int64_t max_across = (std::abs(dx) + std::abs(dy)) * (half_tile + reach);
  for (int ty = tiles.y0; ty <= tiles.y1; ++ty)
    for (int tx = tiles.x0; tx <= tiles.x1; ++tx) {
      const std::int64_t center_x = (2 * tx + 1) * half_tile;
      const std::int64_t center_y = (2 * ty + 1) * half_tile;
      const std::int64_t across = dx * (center_y - a.y) - dy * (center_x - a.x);
      if (std::abs(across) <= max_across) bins.push(ty * tiles.columns + tx, draw.draw, id);
    }
  return true;
}

// Bins a point into the tiles that it may touch. Returns false if there are none.
bool bin_point(Bins& bins, const TileGrid& grid, const BinDraw& draw, LinePoint at, std::uint32_t id) {
  const PixelRect pixels = bounds_of_point(draw, at);
  if (pixels.empty()) return false;
  const TileSpan tiles(grid, pixels);
  for (int ty = tiles.y0; ty <= tiles.y1; ++ty)
    for (int tx = tiles.x0; tx <= tiles.x1; ++tx) bins.push(ty * tiles.columns + tx, draw.draw, id);
  return true;
}

// Clips a line that has outcodes and appends the derived primitive. Returns false, and appends nothing, if
// nothing of it remains.
bool add_clipped_line(Bins& bins, const BinDraw& draw, std::uint32_t line, std::uint8_t outcodes) {
  ClipVertex ends[2] = {clip_vertex(draw, vertex_index<2>(draw, line, 0), draw.attribute_count),
                        clip_vertex(draw, vertex_index<2>(draw, line, 1), draw.attribute_count)};
  if (!clip_line(*draw.transform, ends, outcodes, draw.attribute_count)) return false;
  DerivedPrimitive& derived = bins.add_derived(line, 2, draw.attribute_count);
  for (int k = 0; k < 2; ++k) {
    derived.vertices[k] = project(*draw.transform, ends[k].position);
    std::copy_n(ends[k].attributes, draw.attribute_count,
                bins.attributes(derived) + k * draw.attribute_count);
  }
  return true;
}

}  // namespace

bool bin_derived_point(Bins& bins, const TileGrid& grid, const BinDraw& draw) {
  return bin_point(bins, grid, draw, point_of(bins.last_derived().vertices[0]), bins.last_derived_id());
}
bool bin_derived_line(Bins& bins, const TileGrid& grid, const BinDraw& draw) {
  const DerivedPrimitive& derived = bins.last_derived();
  return bin_line(bins, grid, draw, point_of(derived.vertices[0]), point_of(derived.vertices[1]),
                  bins.last_derived_id());
}

void bin_points(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first,
                std::uint32_t last) {
  BinCounts& counts = bins.counts;
  counts.triangles_in += last - first;
  for (std::uint32_t point = first; point < last; ++point) {
    const std::uint32_t vertex = vertex_index<1>(draw, point, 0);
    const std::uint8_t outcodes = draw.any_outcode ? draw.outcodes[vertex] : 0;
    if ((outcodes & kNonFinite) != 0) {
      ++counts.non_finite;
      continue;
    }
    const WindowVertex& v = draw.vertices[vertex];
    const bool is_visible =
        outcodes == 0 && is_in_view(draw, vertex, v) && bin_point(bins, grid, draw, point_of(v), point);
    if (is_visible) ++counts.binned;
    else ++counts.outside;
  }
}

void bin_lines(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first,
               std::uint32_t last) {
  BinCounts& counts = bins.counts;
  counts.triangles_in += last - first;
  for (std::uint32_t line = first; line < last; ++line) {
    const std::uint32_t i0 = vertex_index<2>(draw, line, 0), i1 = vertex_index<2>(draw, line, 1);
    const std::uint8_t c0 = draw.any_outcode ? draw.outcodes[i0] : 0;
    const std::uint8_t c1 = draw.any_outcode ? draw.outcodes[i1] : 0;
    if (((c0 | c1) & kNonFinite) != 0) {
      ++counts.non_finite;
      continue;
    }
    bool is_visible = (c0 & c1) == 0;
    if (is_visible && (c0 | c1) != 0) {
      ++counts.clipped;
      const bool remains = add_clipped_line(bins, draw, line, c0 | c1);
      is_visible = remains && bin_derived_line(bins, grid, draw);
      if (remains && !is_visible) bins.drop_last_derived();
    } else if (is_visible) {
      is_visible = bin_line(bins, grid, draw, point_of(draw.vertices[i0]), point_of(draw.vertices[i1]), line);
    }
    if (is_visible) ++counts.binned;
    else ++counts.outside;
  }
}

}  // namespace tessera::detail
