// Triangles that fit a few boxes. A box has as many blocks as there are lanes, in rows of four; lanes are
// blocks while a box is set up, and the triangle stays in registers while its blocks are drawn. Twin:
// TrianglePixels, which draws the same pixels for any test, size and number of lanes.
#if defined(TESSERA_SHADING_BOX_PIXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_BOX_PIXELS_INL_H_
#undef TESSERA_SHADING_BOX_PIXELS_INL_H_
#else
#define TESSERA_SHADING_BOX_PIXELS_INL_H_
#endif

#include <algorithm>
#include <bit>

#include "framebuffer/check.h"
#include "raster/coverage-inl.h"
#include "raster/depth-inl.h"
#include "shading/color_eval-inl.h"
#include "shading/interpolate-inl.h"
#include "shading/no_depth-inl.h"
#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Whether draws use boxes. @pre the draw's rectangle does not cut through blocks
template <DepthTestPath kDepthTest>
inline constexpr bool kHasBoxes = kLanes > 1 && kDepthTest == DepthTestPath::less_write;

/// Box data of a group's triangles, computed before any is drawn, so that the branch predictor sees the
/// chosen path early.
struct BoxGroup {
  /// Maximum number of boxes per axis. Larger triangles consist mostly of full blocks, for which the row path
  /// is faster. With 16 vector registers (AVX2) more than one box gains nothing.
  static constexpr int kMaxBoxes = kLanes == 16 ? 3 : 1;
  std::uint32_t triangles = 0;                // triangles in boxes, one bit each
  std::uint32_t singles = 0;                  // triangles in a single box, one bit each
  alignas(64) std::int32_t to_block[kLanes];  // pixel index of each block relative to the box
  // First pixel of the first box.
  alignas(64) std::int32_t x[kGroupSize], y[kGroupSize];
  // Number of blocks.
  alignas(64) std::int32_t columns[kGroupSize], rows[kGroupSize];
  // Edges at (x, y).
  alignas(64) std::int32_t e[3][kGroupSize];
  // Maximum of an edge in a block minus its value at the block's first pixel.
  alignas(64) std::int32_t to_highest[3][kGroupSize];
  // Single boxes only: edges at a block's pixels minus those at its first pixel.
  alignas(64) std::int32_t offset[kGroupSize][3][kBlockPixels];
  // Single boxes only: edges at the blocks' first pixels.
  alignas(64) std::int32_t start[kGroupSize][3][kLanes];
  // Single boxes only: blocks that the triangle may cover, one bit each.
  std::uint32_t touched[kGroupSize];

  /// Not inlined: compiled once for all depth types and ColorWrites.
  /// @param among  triangles that are drawn by blocks, one bit each
  HWY_NOINLINE void set_up(const TileContext& context, const TriangleGroup& g, std::uint32_t among) {
    const auto at = [](const std::int32_t* array, int first)
                        HWY_ATTR { return hn::Load(kInt, array + first); };
    hn::Store(context.pixel_indices(hn::ShiftLeft<2>(block_columns(0)), hn::ShiftLeft<2>(block_rows(0))),
              kInt, to_block);
    for (int first = 0; first < kGroupSize; first += kLanes) {
      const Int one = splat(1);
      const Int zero = hn::Zero(kInt);
      const Int first_x = hn::And(at(g.x0, first), splat(~3));
      const Int first_y = hn::And(at(g.y0, first), splat(~3));
      const Int across = hn::Add(hn::ShiftRight<2>(hn::Sub(at(g.x1, first), first_x)), one);
      const Int down = hn::Add(hn::ShiftRight<2>(hn::Sub(at(g.y1, first), first_y)), one);
      hn::Store(across, kInt, columns + first);
      hn::Store(down, kInt, rows + first);
      hn::Store(first_x, kInt, x + first);
      hn::Store(first_y, kInt, y + first);
      Int lowest = zero;
      for (int k = 0; k < 3; ++k) {
        const Int a = at(g.a[k], first);
        const Int b = at(g.b[k], first);
        const Int at_first = hn::Add(at(g.e[k], first), hn::Add(hn::Mul(a, first_x), hn::Mul(b, first_y)));
        hn::Store(at_first, kInt, e[k] + first);
        hn::Store(hn::Mul(hn::Add(hn::Max(a, zero), hn::Max(b, zero)), splat(3)), kInt,
                  to_highest[k] + first);
        // As in min_over_blocks().
        const auto to_last = [&](Int blocks) HWY_ATTR { return hn::Sub(hn::ShiftLeft<2>(blocks), one); };
        lowest = hn::Or(lowest, hn::Add(at_first, hn::Add(hn::Mul(to_last(across), hn::Min(a, zero)),
                                                          hn::Mul(to_last(down), hn::Min(b, zero)))));
      }
      const auto fit_in = [&](int boxes) HWY_ATTR {
        return mask_bits(
            kInt, hn::And(hn::Lt(across, splat(4 * boxes + 1)), hn::Lt(down, splat(kBoxRows * boxes + 1))));
      };
      const std::uint32_t are_narrow = mask_bits(kInt, hn::Eq(at(g.needs_edges64, first), zero));
      const std::uint32_t have_borders = mask_bits(kInt, hn::Lt(lowest, zero));
      triangles |= (fit_in(kMaxBoxes) & are_narrow & have_borders) << first;
      singles |= fit_in(1) << first;
    }
    triangles &= among;
    singles &= triangles;
    for (std::uint32_t left = singles; left != 0; left &= left - 1) set_up_single(g, std::countr_zero(left));
  }
  HWY_INLINE bool is_single(int i) const { return (singles >> i & 1) != 0; }

  /// Blocks that the triangle may cover, among the first `across` columns and `down` rows of a box.
  /// @param at  edges at the blocks' first pixels
  HWY_INLINE std::uint32_t touched_blocks(int i, const Int (&at)[3], int across, int down) const {
    Int highest = hn::Zero(kInt);
    for (int k = 0; k < 3; ++k) highest = hn::Or(highest, hn::Add(at[k], splat(to_highest[k][i])));
    return mask_bits(kInt, hn::Gt(highest, splat(-1))) & blocks_within(across, down);
  }

  /// Edge k at the first pixels of the blocks of the first box. `to_pixels` receives the edge at a block's
  /// pixels minus that at its first pixel.
  HWY_INLINE Int at_blocks(const TriangleGroup& g, int i, int k, Int (&to_pixels)[kChunksPerBlock]) const {
    const Int a = splat(g.a[k][i]);
    const Int b = splat(g.b[k][i]);
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
      to_pixels[chunk] = hn::Add(hn::Mul(a, block_columns(chunk)), hn::Mul(b, block_rows(chunk)));
    return hn::Add(splat(e[k][i]), hn::ShiftLeft<2>(to_pixels[0]));
  }

 private:
  HWY_INLINE void set_up_single(const TriangleGroup& g, int i) {
    Int at[3];
    for (int k = 0; k < 3; ++k) {
      Int to_pixels[kChunksPerBlock];
      at[k] = at_blocks(g, i, k, to_pixels);
      hn::Store(at[k], kInt, start[i][k]);
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
        hn::Store(to_pixels[chunk], kInt, offset[i][k] + chunk * kLanes);
    }
    touched[i] = touched_blocks(i, at, columns[i], rows[i]);
  }
};

/// One triangle in boxes. @pre DepthTestPath::less_write, and the draw's rectangle does not cut through
/// blocks
template <class Depth, ColorWrite kColorWrite>
struct BoxPixels {
  TileContext& context;
  const BoxGroup& boxes;
  const int i;  // triangle of the group
  Depth depth;
  WeightLanes weights;
  GouraudColorEval color;
  std::int32_t value;  // packed colour, or number of the triangle
  Int writable;
  Int offset[3][kChunksPerBlock];  // edges at a block's pixels minus those at its first pixel
  std::uint32_t visible = 0;       // number of visible pixels; deferred: nonzero if any

  HWY_INLINE BoxPixels(TileContext& tile_context, const TileDraw& draw, const BoxGroup& group_boxes,
                       int triangle, std::int32_t color_or_number, bool back)
      : context(tile_context),
        boxes(group_boxes),
        i(triangle),
        value(color_or_number),
        writable(splat(static_cast<std::int32_t>(draw.write_mask))) {
    const TriangleGroup& g = context.memory.group;
    if constexpr (kColorWrite == ColorWrite::interpolated) {
      weights.set_up(g, i);
      const auto from = [&](int corner) {
        return context.memory.attributes[corner][i] + draw.color_attribute[back ? 1 : 0];
      };
      color.set_up(from(0), from(1), from(2), context.frame.layout);
    }
    depth.set_up(g, i, context.tile_x, context.tile_y, context.frame.depth_format);
    depth.prepare_blocks();
  }

  HWY_INLINE void draw_single_box() {
    TESSERA_ASSERT(boxes.is_single(i));
    for (int k = 0; k < 3; ++k)
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
        offset[k][chunk] = hn::Load(kInt, boxes.offset[i][k] + chunk * kLanes);
    draw_blocks(boxes.touched[i], boxes.x[i], boxes.y[i], boxes.start[i]);
  }
  HWY_INLINE void draw_boxes() {
    const TriangleGroup& g = context.memory.group;
    Int in_row[3];
    for (int k = 0; k < 3; ++k) in_row[k] = boxes.at_blocks(g, i, k, offset[k]);
    for (int row = 0; row < boxes.rows[i]; row += kBoxRows) {
      Int at_blocks[3] = {in_row[0], in_row[1], in_row[2]};
      for (int column = 0; column < boxes.columns[i]; column += 4) {
        alignas(64) std::int32_t start[3][kLanes];
        for (int k = 0; k < 3; ++k) hn::Store(at_blocks[k], kInt, start[k]);
        draw_blocks(boxes.touched_blocks(i, at_blocks, boxes.columns[i] - column, boxes.rows[i] - row),
                    boxes.x[i] + 4 * column, boxes.y[i] + 4 * row, start);
        for (int k = 0; k < 3; ++k) at_blocks[k] = hn::Add(at_blocks[k], splat(16 * g.a[k][i]));
      }
      for (int k = 0; k < 3; ++k) in_row[k] = hn::Add(in_row[k], splat(4 * kBoxRows * g.b[k][i]));
    }
  }

 private:
  /// Draws the touched blocks of the box at (x, y).
  /// @param start  edges at the blocks' first pixels
  HWY_INLINE void draw_blocks(std::uint32_t touched, int x, int y, const std::int32_t (&start)[3][kLanes]) {
    const auto box_depth = depth.box(x, y);
    for (const int index = context.block_index(x, y); touched != 0; touched &= touched - 1) {
      const int block = std::countr_zero(touched);
      TESSERA_ASSERT(index + boxes.to_block[block] <= context.tile_size * context.tile_size - kBlockPixels);
      draw_block(index + boxes.to_block[block], depth.block(box_depth, block), start[0][block],
                 start[1][block], start[2][block]);
    }
  }
  /// @param index          the block's first pixel in the tile
  /// @param start0, start1, start2  edges at the block's first pixel
  HWY_INLINE void draw_block(int index, const typename Depth::Block& block_depth, std::int32_t start0,
                             std::int32_t start1, std::int32_t start2) {
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk, index += kLanes) {
      const Int edge[3] = {hn::Add(offset[0][chunk], splat(start0)), hn::Add(offset[1][chunk], splat(start1)),
                           hn::Add(offset[2][chunk], splat(start2))};
      const auto covered = hn::Gt(hn::Or(hn::Or(edge[0], edge[1]), edge[2]), splat(-1));
      std::int32_t* const depth_at = context.memory.depth + index;
      const Int stored = hn::Load(kInt, depth_at);
      const Int key = depth.keys(block_depth, chunk);
      const auto mask = hn::And(covered, hn::Lt(key, stored));
      hn::Store(hn::IfThenElse(mask, key, stored), kInt, depth_at);
      if constexpr (kColorWrite != ColorWrite::none) color_pixels(index, edge, mask);
    }
  }
  template <class Mask>
  HWY_INLINE void color_pixels(int index, const Int (&edge)[3], Mask mask) {
    const std::uint32_t bits = mask_bits(kInt, mask);
    if constexpr (kColorWrite == ColorWrite::deferred) {
      auto* const id_at = reinterpret_cast<std::int32_t*>(context.memory.visibility) + index;
      hn::Store(hn::IfThenElse(mask, splat(value), hn::Load(kInt, id_at)), kInt, id_at);
      visible |= bits;
    } else {
      // Constant colours are stored without this test: the branch would be mispredicted.
      if (kColorWrite == ColorWrite::interpolated && bits == 0) return;
      visible += static_cast<std::uint32_t>(std::popcount(bits));
      Int packed = splat(value);
      if constexpr (kColorWrite == ColorWrite::interpolated)
        packed = color.packed(weights.at(edge[0], edge[1], edge[2]));
      store_packed(context.color + index, packed, mask, writable);
    }
  }
};

template <class Depth, ColorWrite kColorWrite, bool kSingle>
HWY_NOINLINE std::uint32_t draw_in_boxes_of(TileContext& context, const TileDraw& draw, const BoxGroup& boxes,
                                            int i, std::int32_t value, bool back) {
  BoxPixels<Depth, kColorWrite> pixels(context, draw, boxes, i, value, back);
  if constexpr (kSingle) pixels.draw_single_box();
  else pixels.draw_boxes();
  return pixels.visible;
}
/// Draws triangle i of the group. @pre it is in boxes
/// @param value  packed colour, or number of the triangle
/// @return the number of visible pixels; deferred: nonzero if any
template <class Depth, ColorWrite kColorWrite>
HWY_INLINE std::uint32_t draw_in_boxes(TileContext& context, const TileDraw& draw, const BoxGroup& boxes,
                                       int i, std::int32_t value, bool back) {
  if constexpr (BoxGroup::kMaxBoxes > 1) {
    if (!boxes.is_single(i))
      return draw_in_boxes_of<Depth, kColorWrite, false>(context, draw, boxes, i, value, back);
  }
  return draw_in_boxes_of<Depth, kColorWrite, true>(context, draw, boxes, i, value, back);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
