#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/binning.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>
#include <cstdlib>

#include "raster/binning.h"

namespace tessera {
#ifndef TESSERA_BINNING_SHARED
#define TESSERA_BINNING_SHARED
/// Sorts one triangle, already known to have pixels in tiles [x0, x1] x [y0, y1], into those that its edges may touch.
void bin_large_triangle(Bins& bins, const TileGrid& grid, const WindowVertex* const (&v)[3], double area, const BinDraw& draw, std::uint32_t id,
                        int x0, int y0, int x1, int y1);
/// Clips one triangle and bins what is left of it.
void bin_clipped_triangle(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t triangle, std::uint8_t codes);
/// Whether the side that is seen of a triangle is kept.
inline bool keeps(const BinDraw& draw, std::uint32_t triangle, double area) {
  const bool front = draw.facing != nullptr ? draw.facing[triangle] == Facing::front : is_front(area, draw.front_is_clockwise);
  return front ? draw.keep_front : draw.keep_back;
}
#endif
}  // namespace tessera

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

// A group of triangles as arrays, so that bounds and areas become lanes.
inline constexpr int kGroup = 16;
struct Bounds {
  alignas(64) std::int32_t x[3][kGroup], y[3][kGroup];
  alignas(64) double area[kGroup];
  alignas(64) std::int32_t px0[kGroup], py0[kGroup], px1[kGroup], py1[kGroup];  // pixels whose centres the bounds hold, inclusive
};

HWY_INLINE void compute_bounds(Bounds& b, const PixelRect& rect, std::int32_t reach) {
  for (int k = 0; k < kGroup; ++k) {
    const double dx1 = b.x[1][k] - b.x[0][k], dy1 = b.y[1][k] - b.y[0][k], dx2 = b.x[2][k] - b.x[0][k], dy2 = b.y[2][k] - b.y[0][k];
    b.area[k] = dx1 * dy2 - dx2 * dy1;  // exact: see fixed_point.h
  }
  for (int k = 0; k < kGroup; ++k) {
    const std::int32_t low_x = std::min(b.x[0][k], std::min(b.x[1][k], b.x[2][k])), high_x = std::max(b.x[0][k], std::max(b.x[1][k], b.x[2][k]));
    const std::int32_t low_y = std::min(b.y[0][k], std::min(b.y[1][k], b.y[2][k])), high_y = std::max(b.y[0][k], std::max(b.y[1][k], b.y[2][k]));
    b.px0[k] = std::max(first_pixel(low_x - reach), rect.x0);
    b.py0[k] = std::max(first_pixel(low_y - reach), rect.y0);
    b.px1[k] = std::min(last_pixel(high_x + reach), rect.x1 - 1);
    b.py1[k] = std::min(last_pixel(high_y + reach), rect.y1 - 1);
  }
}

void bin_triangles_lanes(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first, std::uint32_t last) {
  BinCounts& counts = bins.counts;
  counts.triangles_in += last - first;
  const int shift = grid.tile_size == 32 ? 5 : grid.tile_size == 64 ? 6 : 7;
  const int columns = grid.columns();
  Bounds b;
  std::uint32_t ids[kGroup];
  for (std::uint32_t next = first; next < last;) {
    int n = 0;
    while (n < kGroup && next < last) {
      const std::uint32_t triangle = next++;
      const std::uint32_t i0 = vertex_index<3>(draw, triangle, 0), i1 = vertex_index<3>(draw, triangle, 1), i2 = vertex_index<3>(draw, triangle, 2);
      if (draw.any_code) {
        const std::uint8_t c0 = draw.codes[i0], c1 = draw.codes[i1], c2 = draw.codes[i2];
        if (((c0 | c1 | c2) & kNonFinite) != 0 || (draw.facing != nullptr && draw.facing[triangle] == Facing::dropped)) {
          ++counts.non_finite;
          continue;
        }
        if (c0 & c1 & c2) {
          ++counts.outside;
          continue;
        }
        if (c0 | c1 | c2) {
          // Order within a tile is submission order: what was gathered so far goes first.
          if (n > 0) {
            --next;
            break;
          }
          ++counts.clipped;
          bin_clipped_triangle(bins, grid, draw, triangle, c0 | c1 | c2);
          continue;
        }
      }
      const WindowVertex &v0 = draw.vertices[i0], &v1 = draw.vertices[i1], &v2 = draw.vertices[i2];
      b.x[0][n] = v0.x, b.y[0][n] = v0.y;
      b.x[1][n] = v1.x, b.y[1][n] = v1.y;
      b.x[2][n] = v2.x, b.y[2][n] = v2.y;
      ids[n++] = triangle;
    }
    if (n == 0) continue;
    for (int k = n; k < kGroup; ++k)
      for (int corner = 0; corner < 3; ++corner) b.x[corner][k] = b.y[corner][k] = 0;
    compute_bounds(b, draw.rect, draw.sample_reach);
    for (int k = 0; k < n; ++k) {
      if (b.area[k] == 0) {
        ++counts.zero_area;
        continue;
      }
      if (!keeps(draw, ids[k], b.area[k])) {
        ++counts.culled;
        continue;
      }
      if (b.px0[k] > b.px1[k] || b.py0[k] > b.py1[k]) {
        ++counts.outside;
        continue;
      }
      ++counts.binned;
      const int tx0 = b.px0[k] >> shift, ty0 = b.py0[k] >> shift, tx1 = b.px1[k] >> shift, ty1 = b.py1[k] >> shift;
      if (tx0 == tx1 && ty0 == ty1) {
        bins.push(ty0 * columns + tx0, draw.draw, ids[k]);
      } else {
        const WindowVertex* const v[3] = {&draw.vertices[vertex_index<3>(draw, ids[k], 0)], &draw.vertices[vertex_index<3>(draw, ids[k], 1)],
                                          &draw.vertices[vertex_index<3>(draw, ids[k], 2)]};
        bin_large_triangle(bins, grid, v, b.area[k], draw, ids[k], tx0, ty0, tx1, ty1);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

void bin_triangles(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first, std::uint32_t last, Isa isa) {
  TESSERA_KERNEL(isa, bin_triangles_lanes)(bins, grid, draw, first, last);
}

void bin_large_triangle(Bins& bins, const TileGrid& grid, const WindowVertex* const (&v)[3], double area, const BinDraw& draw, std::uint32_t id,
                        int x0, int y0, int x1, int y1) {
  // For each edge its largest value over the pixel centres (or samples) of a tile; where it is negative the tile is outside. Ties at 0
  // belong to the fill rule and are left to the tile.
  const std::int64_t side = std::int64_t{grid.tile_size} << kSubpixelBits, reach = side - kSubpixelScale;
  std::int64_t row_value[3], step_x[3], step_y[3];
  for (int k = 0; k < 3; ++k) {
    const WindowVertex &p = *v[k], &q = *v[(k + 1) % 3];
    std::int64_t a = p.y - q.y, b = q.x - p.x;
    if (area < 0) a = -a, b = -b;
    row_value[k] = a * (x0 * side + kHalfPixel - p.x) + b * (y0 * side + kHalfPixel - p.y) + std::max<std::int64_t>(a, 0) * reach + std::max<std::int64_t>(b, 0) * reach +
                   (std::abs(a) + std::abs(b)) * draw.sample_reach;
    step_x[k] = a * side;
    step_y[k] = b * side;
  }
  for (int ty = y0; ty <= y1; ++ty) {
    std::int64_t e0 = row_value[0], e1 = row_value[1], e2 = row_value[2];
    for (int tx = x0; tx <= x1; ++tx) {
      if ((e0 | e1 | e2) >= 0) bins.push(ty * grid.columns() + tx, draw.draw, id);
      e0 += step_x[0], e1 += step_x[1], e2 += step_x[2];
    }
    for (int k = 0; k < 3; ++k) row_value[k] += step_y[k];
  }
}

void bin_pixels(Bins& bins, const TileGrid& grid, std::uint32_t draw, const PixelRect& rect) {
  for (int ty = rect.y0 / grid.tile_size; ty <= (rect.y1 - 1) / grid.tile_size; ++ty)
    for (int tx = rect.x0 / grid.tile_size; tx <= (rect.x1 - 1) / grid.tile_size; ++tx) bins.push_draw(ty * grid.columns() + tx, draw);
}

ClipVertex clip_vertex(const BinDraw& draw, std::uint32_t vertex, int attribute_count) {
  ClipVertex v;
  const float* p = draw.positions.at(vertex);
  v.object = {p[0], p[1], p[2], draw.components == 4 ? p[3] : 1.0f};
  const TransformedVertex transformed = transform_vertex(*draw.transform, *v.object);
  v.position = transformed.position;
  v.is_rough = transformed.is_rough;
  const float* a = draw.attributes + std::size_t{vertex} * static_cast<std::size_t>(draw.attribute_stride);
  for (int j = 0; j < attribute_count; ++j) v.attributes[j] = a[j];
  return v;
}

WindowPolygon clip_to_window(const BinDraw& draw, std::uint32_t triangle, std::uint8_t codes, int attribute_count) {
  const ClipVertex corners[3] = {clip_vertex(draw, vertex_index<3>(draw, triangle, 0), attribute_count), clip_vertex(draw, vertex_index<3>(draw, triangle, 1), attribute_count),
                                 clip_vertex(draw, vertex_index<3>(draw, triangle, 2), attribute_count)};
  return WindowPolygon(*draw.transform, clip_triangle(*draw.transform, corners, codes, attribute_count));
}

void bin_clipped_triangle(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t triangle, std::uint8_t codes) {
  const WindowPolygon polygon = clip_to_window(draw, triangle, codes, draw.attribute_count);
  if (polygon.clipped.count == 0) {
    ++bins.counts.outside;
    return;
  }
  if (polygon.triangles().empty()) {
    ++bins.counts.zero_area;
    return;
  }
  if (!keeps(draw, triangle, polygon.area)) {  // facing belongs to the whole of it
    ++bins.counts.culled;
    return;
  }
  for (const WindowPolygon::Corners& corner : polygon.triangles()) {
    const WindowVertex &a = polygon.window[corner[0]], &b = polygon.window[corner[1]], &c = polygon.window[corner[2]];
    const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
    const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
    const int px0 = std::max(first_pixel(low_x - draw.sample_reach), draw.rect.x0), px1 = std::min(last_pixel(high_x + draw.sample_reach), draw.rect.x1 - 1);
    const int py0 = std::max(first_pixel(low_y - draw.sample_reach), draw.rect.y0), py1 = std::min(last_pixel(high_y + draw.sample_reach), draw.rect.y1 - 1);
    if (px0 > px1 || py0 > py1) continue;
    Piece& piece = bins.add_piece(triangle, 3, draw.attribute_count);
    for (int k = 0; k < 3; ++k) {
      piece.vertices[k] = polygon.window[corner[k]];
      std::copy_n(polygon.clipped.vertices[corner[k]].attributes, draw.attribute_count, bins.attributes(piece) + k * draw.attribute_count);
    }
    ++bins.counts.binned;
    const WindowVertex* const v[3] = {&piece.vertices[0], &piece.vertices[1], &piece.vertices[2]};
    bin_large_triangle(bins, grid, v, doubled_area(a, b, c), draw, bins.id_of_last_piece(), px0 / grid.tile_size, py0 / grid.tile_size, px1 / grid.tile_size, py1 / grid.tile_size);
  }
}

}  // namespace tessera
#endif
