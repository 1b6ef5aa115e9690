// Which pixels of a tile a triangle covers, 4x4 blocks at a time. Triangles of medium size walk the blocks of their bounds;
// large ones first look at cells of 8x8 pixels, a row of cells at once, and pass over those outside and fill those inside
// without looking at their pixels. Twin: coverage_reference.h.
#if defined(TESSERA_RASTER_COVERAGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_RASTER_COVERAGE_INL_H_
#undef TESSERA_RASTER_COVERAGE_INL_H_
#else
#define TESSERA_RASTER_COVERAGE_INL_H_
#endif

#include <algorithm>

#include "raster/lanes-inl.h"
#include "raster/triangle_setup.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

inline constexpr int kMediumExtent = 32;  ///< pixels; wider or higher bounds descend by cells
inline constexpr int kCellSize = 8;

/// Sets up the narrow edges of lane i for coverage.
HWY_INLINE TileEdges tile_edges(const TriangleGroup& g, int i) {
  TileEdges t;
  for (int k = 0; k < 3; ++k) t.a[k] = g.a[k][i], t.b[k] = g.b[k][i], t.e[k] = g.e[k][i];
  return t;
}

/// The same for a wide triangle: an edge that the whole tile is inside of is dropped, any other fits 32 bits in the tile.
/// False if the tile is outside. `wide` gets the undivided edges.
inline HWY_NOINLINE bool tile_edges_of_wide(const TriangleGroup& g, int i, int tile_x, int tile_y, int tile_size, TileEdges& edges, WideEdges& wide) {
  bool touched = true;
  for (int k = 0; k < 3; ++k) {
    const int p = (k + 1) % 3;
    const std::int64_t a = g.a[k][i], b = g.b[k][i];
    const std::int64_t at_tile = a * (std::int64_t{tile_x} * kSubpixelScale + kHalfPixel - g.x[p][i]) +
                                 b * (std::int64_t{tile_y} * kSubpixelScale + kHalfPixel - g.y[p][i]);
    wide.a[k] = static_cast<double>(a * kSubpixelScale);
    wide.b[k] = static_cast<double>(b * kSubpixelScale);
    wide.e[k] = static_cast<double>(at_tile);
    const bool top_left = a > 0 || (a == 0 && b > 0);
    const std::int64_t e = (at_tile - (top_left ? 0 : 1)) >> kSubpixelBits;
    const std::int64_t reach = tile_size - 1;
    const std::int64_t lowest = e + reach * (std::min<std::int64_t>(a, 0) + std::min<std::int64_t>(b, 0));
    const std::int64_t highest = e + reach * (std::max<std::int64_t>(a, 0) + std::max<std::int64_t>(b, 0));
    touched &= highest >= 0;
    const bool inside = lowest >= 0;
    edges.a[k] = inside ? 0 : static_cast<std::int32_t>(a);
    edges.b[k] = inside ? 0 : static_cast<std::int32_t>(b);
    edges.e[k] = inside ? 0 : static_cast<std::int32_t>(e);
  }
  return touched;
}

/// Offsets of the edges at the pixels of a block from its first pixel.
struct BlockOffsets {
  alignas(64) std::int32_t edge[3][16];
  HWY_INLINE explicit BlockOffsets(const TileEdges& t) {
    for (int k = 0; k < 3; ++k)
      for (int p = 0; p < 16; ++p) edge[k][p] = t.a[k] * (p & 3) + t.b[k] * (p >> 2);
  }
};

/// Bits of the covered lanes of one chunk of the block at (bx, by).
HWY_INLINE auto covered(const TileEdges& t, const BlockOffsets& offsets, int bx, int by, int chunk) {
  Int either = hn::Zero(kInt);
  for (int k = 0; k < 3; ++k) {
    const auto start = static_cast<std::int32_t>(static_cast<std::uint32_t>(t.e[k]) + static_cast<std::uint32_t>(t.a[k]) * static_cast<std::uint32_t>(bx) +
                                                 static_cast<std::uint32_t>(t.b[k]) * static_cast<std::uint32_t>(by));
    either = hn::Or(either, hn::Add(splat(start), hn::Load(kInt, offsets.edge[k] + chunk * kLanes)));
  }
  return hn::Gt(either, splat(-1));  // no sign bit: inside all three
}

/// Calls block(bx, by, full) for the blocks that the triangle may cover in the bounds, row by row within each cell; `full` is
/// a compile-time constant that says all 16 pixels are inside.
template <class BlockFunction>
HWY_INLINE void for_each_block(const TileEdges& t, int x0, int y0, int x1, int y1, BlockFunction& block) {
  if (x1 - x0 < kMediumExtent && y1 - y0 < kMediumExtent) {
    for (int by = y0 & ~3; by <= y1; by += 4)
      for (int bx = x0 & ~3; bx <= x1; bx += 4) block.template operator()<false>(bx, by);
    return;
  }
  // Largest and smallest value of each edge over the pixel centres of a cell, from the value at its first.
  std::int32_t to_highest[3], to_lowest[3];
  for (int k = 0; k < 3; ++k) {
    to_highest[k] = (kCellSize - 1) * (std::max(t.a[k], 0) + std::max(t.b[k], 0));
    to_lowest[k] = (kCellSize - 1) * (std::min(t.a[k], 0) + std::min(t.b[k], 0));
  }
  for (int cy = y0 & ~(kCellSize - 1); cy <= y1; cy += kCellSize) {
    for (int cx = x0 & ~(kCellSize - 1); cx <= x1; cx += kCellSize) {
      std::int32_t outside = 0, partly = 0;
      for (int k = 0; k < 3; ++k) {
        const std::int32_t e = t.e[k] + t.a[k] * cx + t.b[k] * cy;
        outside |= e + to_highest[k];
        partly |= e + to_lowest[k];
      }
      if (outside < 0) continue;
      // A cell may stick out of the bounds by a row or a column of blocks.
      const int first_x = std::max(cx, x0 & ~3), last_x = std::min(cx + kCellSize - 1, x1);
      const int first_y = std::max(cy, y0 & ~3), last_y = std::min(cy + kCellSize - 1, y1);
      for (int y = first_y; y <= last_y; y += 4) {
        for (int x = first_x; x <= last_x; x += 4) {
          if (partly >= 0)
            block.template operator()<true>(x, y);
          else
            block.template operator()<false>(x, y);
        }
      }
    }
  }
}

/// Triangles whose bounds are at most 4x4 pixels: one triangle a lane, all sample points at once. hits[i] gets a bit for each
/// covered pixel of triangle i: bit 4 dy + dx for pixel (x0 + dx, y0 + dy).
inline HWY_NOINLINE void cover_small(const TriangleGroup& g, int first, std::uint32_t* hits) {
  const Int x0 = hn::Load(kInt, g.x0 + first), y0 = hn::Load(kInt, g.y0 + first);
  const Int width = hn::Sub(hn::Load(kInt, g.x1 + first), x0), height = hn::Sub(hn::Load(kInt, g.y1 + first), y0);
  Int a[3] = {hn::Load(kInt, g.a[0] + first), hn::Load(kInt, g.a[1] + first), hn::Load(kInt, g.a[2] + first)};
  Int b[3] = {hn::Load(kInt, g.b[0] + first), hn::Load(kInt, g.b[1] + first), hn::Load(kInt, g.b[2] + first)};
  Int row[3];
  for (int k = 0; k < 3; ++k)
    row[k] = hn::Add(hn::Load(kInt, g.e[k] + first), hn::Add(hn::Mul(a[k], x0), hn::Mul(b[k], y0)));
  Int hit = hn::Zero(kInt);
  for (int dy = 0; dy < 4; ++dy) {
    const auto in_rows = hn::Gt(height, splat(dy - 1));
    if (hn::AllFalse(kInt, in_rows)) break;
    Int e0 = row[0], e1 = row[1], e2 = row[2];
    for (int dx = 0; dx < 4; ++dx) {
      const auto inside = hn::And(hn::And(hn::Gt(width, splat(dx - 1)), in_rows), hn::Gt(hn::Or(hn::Or(e0, e1), e2), splat(-1)));
      hit = hn::Or(hit, hn::IfThenElseZero(inside, splat(1 << (4 * dy + dx))));
      e0 = hn::Add(e0, a[0]);
      e1 = hn::Add(e1, a[1]);
      e2 = hn::Add(e2, a[2]);
    }
    for (int k = 0; k < 3; ++k) row[k] = hn::Add(row[k], b[k]);
  }
  hn::StoreU(hit, kInt, reinterpret_cast<std::int32_t*>(hits));
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
