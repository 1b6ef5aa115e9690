// Coverage: the pixels of a tile that a triangle covers. Twin: coverage_reference.h.
// - Small triangles (bounds of at most 4x4 pixels): one triangle per lane, pixel by pixel.
// - All others: 4x4 blocks, one block per lane, from one row of blocks or from several short rows. Blocks
//   outside are skipped, blocks inside need no test per pixel, the rest is tested. Some triangles go by boxes
//   of blocks instead, see shading/box_pixels-inl.h.
#if defined(TESSERA_RASTER_COVERAGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_RASTER_COVERAGE_INL_H_
#undef TESSERA_RASTER_COVERAGE_INL_H_
#else
#define TESSERA_RASTER_COVERAGE_INL_H_
#endif

#include <algorithm>
#include <bit>

#include "raster/lanes-inl.h"
#include "raster/triangle_setup.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Copies the 32-bit edges of triangle i.
HWY_INLINE void set_tile_edges32(Edges32& t, const TriangleGroup& g, int i) {
  for (int k = 0; k < 3; ++k) {
    t.a[k] = g.a[k][i];
    t.b[k] = g.b[k][i];
    t.e[k] = g.e[k][i];
  }
}
HWY_INLINE Edges32 tile_edges32(const TriangleGroup& g, int i) {
  Edges32 t;
  set_tile_edges32(t, g, i);
  return t;
}

/// Edges of a triangle that needs 64 bits. An edge that contains the whole tile is replaced by 0; any other
/// fits in 32 bits in the tile. Returns false if the tile is outside. `edges64` gets the undivided edges.
inline HWY_NOINLINE bool tile_edges64(const TriangleGroup& g, int i, int tile_x, int tile_y, int tile_size,
                                      Edges32& edges, Edges64& edges64) {
  bool touched = true;
  for (int k = 0; k < 3; ++k) {
    const int p = (k + 1) % 3;
    const std::int64_t a = g.a[k][i], b = g.b[k][i];
    const std::int64_t at_tile = a * (std::int64_t{tile_x} * kSubpixelScale + kHalfPixel - g.x[p][i]) +
                                 b * (std::int64_t{tile_y} * kSubpixelScale + kHalfPixel - g.y[p][i]);
    edges64.a[k] = static_cast<double>(a * kSubpixelScale);
    edges64.b[k] = static_cast<double>(b * kSubpixelScale);
    edges64.e[k] = static_cast<double>(at_tile);
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

/// Differences of the edges between the pixels of a block and its first pixel.
struct BlockOffsets {
  alignas(64) std::int32_t edge[3][16];
  HWY_INLINE explicit BlockOffsets(const Edges32& t) {
    for (int k = 0; k < 3; ++k) {
      const Int a = splat(t.a[k]), b = splat(t.b[k]);
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
        hn::Store(hn::Add(hn::Mul(a, block_columns(chunk)), hn::Mul(b, block_rows(chunk))), kInt,
                  edge[k] + chunk * kLanes);
    }
  }
};

/// The three edges at the pixels of one block.
struct BlockEdges {
  std::int32_t start[3];  ///< at the block's first pixel
  const BlockOffsets* offsets;
  HWY_INLINE Int at(int k, int chunk) const {
    return hn::Add(splat(start[k]), hn::Load(kInt, offsets->edge[k] + chunk * kLanes));
  }
  /// Lanes inside all three edges: no sign bit set.
  HWY_INLINE auto covered(int chunk) const {
    return hn::Gt(hn::Or(hn::Or(at(0, chunk), at(1, chunk)), at(2, chunk)), splat(-1));
  }
  /// Moves to the block below.
  HWY_INLINE void step_down(const Edges32& t) {
    for (int k = 0; k < 3; ++k) start[k] += 4 * t.b[k];
  }
};

/// The three edges at the pixels of the blocks of a row, stepped from block to block.
struct RowEdges {
  Int edge[3][kChunksPerBlock], to_right[3];
  HWY_INLINE RowEdges(const Edges32& t, const BlockEdges& first) {
    for (int k = 0; k < 3; ++k) {
      to_right[k] = splat(4 * t.a[k]);
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) edge[k][chunk] = first.at(k, chunk);
    }
  }
  HWY_INLINE Int at(int k, int chunk) const { return edge[k][chunk]; }
  HWY_INLINE void step_right() {
    for (int k = 0; k < 3; ++k)
      for (Int& chunk : edge[k]) chunk = hn::Add(chunk, to_right[k]);
  }
};

alignas(64) inline constexpr std::int32_t kLaneNumbers[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                              8, 9, 10, 11, 12, 13, 14, 15};

inline constexpr int kBoxRows = kLanes / 4;  ///< rows of four blocks in one vector

/// Mask of a box's blocks (four per row) in the first `columns` columns and `rows` rows.
HWY_INLINE std::uint32_t blocks_within(int columns, int rows) {
  return ((1u << std::min(columns, 4)) - 1) * 0x1111u & ((1u << (4 * std::min(rows, kBoxRows))) - 1);
}

/// Minimum of an edge over the pixel centres of `columns` x `rows` blocks, from its value at the first. Each
/// sum is the edge's value at one of those pixels, so it does not overflow (fixed_point.h).
HWY_INLINE std::int32_t min_over_blocks(std::int32_t first, std::int32_t a, std::int32_t b, int columns,
                                        int rows) {
  return first + (4 * columns - 1) * std::min(a, 0) + (4 * rows - 1) * std::min(b, 0);
}

/// Enumerates the blocks of the bounds x0 .. x1, y0 .. y1 (inclusive) that the triangle may cover.
/// - Calls block.operator()<full>(bx, by, edges); `full` is true if all 16 pixels are inside.
/// - If the function object has full_row(bx, by, count, edges of the first), runs of full blocks of a row go
///   there instead: up to one vector of blocks, or whole rows of the bounds if all blocks are full.
/// - Lanes are blocks of one row, or of several short rows (a box). If all blocks are full, none is
///   classified.
///
/// @pre `offsets` was built from `t`
template <class BlockFunction>
HWY_INLINE void for_each_block(const Edges32& t, const BlockOffsets& offsets, int x0, int y0, int x1, int y1,
                               BlockFunction& block) {
  const int first_x = x0 & ~3, first_y = y0 & ~3;
  const int columns = ((x1 - first_x) >> 2) + 1;
  const int rows = ((y1 - first_y) >> 2) + 1;
  const bool is_box = columns <= 4 && rows <= kBoxRows;
  const int row_shift = is_box ? 2 : std::countr_zero(static_cast<unsigned>(kLanes));
  const int lanes_per_row = 1 << row_shift;
  // Edge differences: from a block's first pixel centre to its maximum and minimum over the block, to the
  // blocks of the lanes, and to the next row of blocks.
  Int to_highest[3], to_lowest[3], to_lane[3], down[3];
  bool all_full = true;
  for (int k = 0; k < 3; ++k) {
    to_highest[k] = splat(3 * (std::max(t.a[k], 0) + std::max(t.b[k], 0)));
    to_lowest[k] = splat(3 * (std::min(t.a[k], 0) + std::min(t.b[k], 0)));
    to_lane[k] = is_box ? hn::ShiftLeft<2>(hn::Load(kInt, offsets.edge[k]))
                        : hn::Mul(splat(4 * t.a[k]), hn::Load(kInt, kLaneNumbers));
    down[k] = splat(4 * t.b[k]);
    all_full &= min_over_blocks(t.at(k, first_x, first_y), t.a[k], t.b[k], columns, rows) >= 0;
  }
  for (int column = 0; column < columns; column += lanes_per_row) {
    const int left = first_x + 4 * column;
    const std::uint32_t in_bounds =
        is_box ? blocks_within(columns, rows) : (1u << std::min(columns - column, lanes_per_row)) - 1;
    Int e[3];
    for (int k = 0; k < 3; ++k) e[k] = hn::Add(splat(t.at(k, left, first_y)), to_lane[k]);
    for (int row = 0; row < rows; row += is_box ? rows : 1) {
      const int top = first_y + 4 * row;
      std::uint32_t touched = in_bounds, inside = in_bounds;
      if (!all_full) {
        const Int highest = hn::Or(hn::Or(hn::Add(e[0], to_highest[0]), hn::Add(e[1], to_highest[1])),
                                   hn::Add(e[2], to_highest[2]));
        const Int lowest = hn::Or(hn::Or(hn::Add(e[0], to_lowest[0]), hn::Add(e[1], to_lowest[1])),
                                  hn::Add(e[2], to_lowest[2]));
        touched &= mask_bits(kInt, hn::Gt(highest, splat(-1)));
        inside = touched & mask_bits(kInt, hn::Gt(lowest, splat(-1)));
      }
      alignas(64) std::int32_t start[3][kLanes];
      for (int k = 0; k < 3; ++k) {
        hn::Store(e[k], kInt, start[k]);
        e[k] = hn::Add(e[k], down[k]);
      }
      while (touched != 0) {
        const int i = std::countr_zero(touched);
        const int lane_in_row = i & (lanes_per_row - 1);
        const int bx = left + 4 * lane_in_row, by = top + 4 * (i >> row_shift);
        BlockEdges edges{{start[0][i], start[1][i], start[2][i]}, &offsets};
        touched &= touched - 1;
        if ((inside >> i & 1) == 0) {
          block.template operator()<false>(bx, by, edges);
        } else if constexpr (requires { block.full_row(bx, by, 1, edges); }) {
          const bool at_once = kLanes > 1 && all_full;  // no gain with a single lane
          const int count =
              at_once ? columns : std::min(std::countr_one(inside >> i), lanes_per_row - lane_in_row);
          const int last_row = at_once ? rows - 1 : 0;
          for (int below = 0;; ++below, edges.step_down(t)) {
            block.full_row(bx, by + 4 * below, count, edges);
            if (below == last_row) break;  // edges may overflow below the last row
          }
          if (at_once) return;
          touched &= ~(((1u << count) - 1) << i);
        } else {
          block.template operator()<true>(bx, by, edges);
        }
      }
    }
  }
}

/// Mask of the group's triangles whose bounds are at most 4x4 pixels. Not inlined: one copy for all pixel
/// paths.
inline HWY_NOINLINE std::uint32_t small_triangles(const TriangleGroup& g) {
  std::uint32_t bits = 0;
  for (int first = 0; first < kGroupSize; first += kLanes) {
    const Int width = hn::Sub(hn::Load(kInt, g.x1 + first), hn::Load(kInt, g.x0 + first));
    const Int height = hn::Sub(hn::Load(kInt, g.y1 + first), hn::Load(kInt, g.y0 + first));
    const auto fits_edges32 = hn::Eq(hn::Load(kInt, g.needs_edges64 + first), hn::Zero(kInt));
    const auto fits = hn::And(hn::Lt(width, splat(4)), hn::Lt(height, splat(4)));
    bits |= mask_bits(kInt, hn::And(fits_edges32, fits)) << first;
  }
  return bits & g.mask;
}

/// Coverage of kLanes triangles from `first` on, whose bounds are at most 4x4 pixels. hits[i] gets bit 4 dy +
/// dx for every covered pixel (x0 + dx, y0 + dy) of lane i.
inline HWY_NOINLINE void cover_small(const TriangleGroup& g, int first, std::uint32_t* hits) {
  const Int x0 = hn::Load(kInt, g.x0 + first), y0 = hn::Load(kInt, g.y0 + first);
  const Int width = hn::Sub(hn::Load(kInt, g.x1 + first), x0);
  const Int height = hn::Sub(hn::Load(kInt, g.y1 + first), y0);
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
      const auto inside = hn::And(hn::And(hn::Gt(width, splat(dx - 1)), in_rows),
                                  hn::Gt(hn::Or(hn::Or(e0, e1), e2), splat(-1)));
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
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
