// Pixels of one triangle: coverage, stencil, depth, and the colour or the visibility buffer.
#if defined(TESSERA_SHADING_TRIANGLE_PIXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_TRIANGLE_PIXELS_INL_H_
#undef TESSERA_SHADING_TRIANGLE_PIXELS_INL_H_
#else
#define TESSERA_SHADING_TRIANGLE_PIXELS_INL_H_
#endif

#include <bit>
#include <cmath>

#include "raster/coverage-inl.h"
#include "shading/color_eval-inl.h"
#include "shading/fragment_ops-inl.h"
#include "shading/fragment_scalar.h"
#include "shading/no_depth-inl.h"
#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Evaluator of interpolated colours.
template <ColorWrite kColorWrite>
struct ColorEvalFor {
  using Type = GouraudColorEval;
};
template <>
struct ColorEvalFor<ColorWrite::blended> {
  using Type = BlendedColorEval;
};

/// Stencil test of single pixels of one face.
struct PixelStencil {
  StencilTestConstants constants{};
  std::int32_t* values = nullptr;  // stencil values of the tile

  /// Returns whether the pixel passes. Applies the action for failure.
  HWY_INLINE bool passes(int index) const {
    const bool passed = constants.passes(values[index]);
    if (!passed) apply(index, constants.fail);
    return passed;
  }
  /// Applies the action for a pixel that passed.
  HWY_INLINE void store_after_depth(int index, bool depth_passes) const {
    apply(index, depth_passes ? constants.zpass : constants.zfail);
  }

 private:
  HWY_INLINE void apply(int index, const StencilOpConstants& op) const {
    std::int32_t& stored = values[index];
    stored = (stored & ~constants.write_mask) | (op(stored) & constants.write_mask);
  }
};

template <DepthTestPath kDepthTest>
HWY_INLINE bool has_stencil_test(const TileDraw& draw) {
  return kDepthTest == DepthTestPath::generic && draw.ops != nullptr && draw.ops->stencil;
}
HWY_INLINE PixelStencil pixel_stencil(const TileContext& context, const TileDraw& draw, bool back) {
  return {.constants = stencil_test_constants(draw.ops->faces[back ? 1 : 0], draw.ops->stencil_max),
          .values = context.sample[0].stencil};
}

/// Functor for for_each_block(), or for single pixels of a small triangle.
template <class Depth, DepthTestPath kDepthTest, ColorWrite kColorWrite>
struct TrianglePixels {
  static constexpr bool kMayTestStencil = kDepthTest == DepthTestPath::generic;
  TileContext& context;
  const TileDraw& draw;
  const Edges32& edges;
  BlockOffsets offsets;
  const ShadedTriangle& triangle;
  Depth depth;
  typename ColorEvalFor<kColorWrite>::Type color;
  std::int32_t packed_color = 0;
  std::int32_t id = 0;
  const bool tests_stencil;
  PixelStencil stencil{};
  std::uint32_t visible_pixels = 0;  // unless deferred
  Int visible = hn::Zero(kInt);      // deferred: nonzero lanes have a visible pixel
  Int writable;                      // bits of packed colours that change
  Int depth_writable;                // -1 or 0: a mask avoids a branch
  const bool needs_scissor;          // the draw's rectangle cuts through blocks
  const bool writes_all_planes;
  const bool stores_full;  // full blocks are stored without tests or masks

  HWY_INLINE TrianglePixels(TileContext& tile_context, const TileDraw& tile_draw,
                            const Edges32& edges_in_tile, const ShadedTriangle& shaded, bool back)
      : context(tile_context),
        draw(tile_draw),
        edges(edges_in_tile),
        offsets(edges_in_tile),
        triangle(shaded),
        tests_stencil(has_stencil_test<kDepthTest>(tile_draw)),
        writable(splat(static_cast<std::int32_t>(tile_draw.write_mask))),
        depth_writable(splat(tile_draw.depth_write ? -1 : 0)),
        needs_scissor(tile_context.needs_scissor),
        writes_all_planes(tile_draw.write_mask == 0xffffffffu),
        stores_full(!kHasDepth<Depth> && !tile_context.needs_scissor && !tests_stencil && writes_all_planes) {
    if (tests_stencil) stencil = pixel_stencil(context, draw, back);
  }

  /// A partly covered block.
  template <bool kFull>
  HWY_INLINE void operator()(int bx, int by, const BlockEdges& block_edges) {
    static_assert(!kFull);  // full blocks are drawn by full_row()
    if constexpr (kColorWrite == ColorWrite::blended) rare_block(bx, by, block_edges);
    else draw_chunks<false>(bx, by, context.block_index(bx, by), depth.block(bx, by), block_edges);
  }
  /// A partly covered block of a blended triangle. Not inlined: the code is long and such blocks are few.
  HWY_NOINLINE void rare_block(int bx, int by, const BlockEdges& block_edges) {
    draw_chunks<false>(bx, by, context.block_index(bx, by), depth.block(bx, by), block_edges);
  }
  /// A row of full blocks.
  HWY_INLINE void full_row(int bx, int by, int count, const BlockEdges& first) {
    int index = context.block_index(bx, by);
    RowEdges row_edges(edges, first);
    if constexpr (!kHasDepth<Depth> &&
                  (kColorWrite == ColorWrite::constant || is_interpolated(kColorWrite))) {
      if (stores_full) {
        visible_pixels += static_cast<std::uint32_t>(kBlockPixels * count);
        if constexpr (kColorWrite == ColorWrite::constant) fill_blocks(index, count);
        else store_row(bx, by, index, count, row_edges);
        return;
      }
    }
    auto block_depth = depth.block(bx, by);
    for (const int end = bx + 4 * count; bx < end; bx += 4, index += kBlockPixels) {
      draw_chunks<true>(bx, by, index, block_depth, row_edges);
      row_edges.step_right();
      depth.step_right(block_depth);
    }
  }
  /// full_row() without tests and masks, for one packed colour.
  HWY_INLINE void fill_blocks(int index, int count) const {
    auto* const first = reinterpret_cast<std::int32_t*>(context.color + index);
    for (int i = 0; i < kBlockPixels * count; i += kLanes) hn::Store(splat(packed_color), kInt, first + i);
  }
  /// full_row() without tests and masks, for interpolated colours.
  HWY_INLINE void store_row(int bx, int by, int index, int count, RowEdges& row_edges) {
    auto* stored_at = reinterpret_cast<std::int32_t*>(context.color + index);
    for (const int end = bx + 4 * count; bx < end; bx += 4, row_edges.step_right())
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk, stored_at += kLanes)
        hn::Store(packed_at(row_edges, bx, by, chunk, stored_at), kInt, stored_at);
  }
  /// Draws a block.
  /// @param block  the block's first pixel in the tile
  template <bool kFull, class Edges>
  HWY_INLINE void draw_chunks(int bx, int by, int block,
                              [[maybe_unused]] const typename Depth::Block& block_depth,
                              [[maybe_unused]] const Edges& block_edges) {
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const int index = block + chunk * kLanes;
      auto mask = hn::Eq(hn::Zero(kInt), hn::Zero(kInt));
      if constexpr (!kFull) mask = block_edges.covered(chunk);
      if (needs_scissor) mask = hn::And(mask, scissor_mask(context.rect, bx, by, chunk));
      [[maybe_unused]] Int stencil_before = hn::Zero(kInt);
      [[maybe_unused]] LaneMask failed = no_lanes();
      [[maybe_unused]] LaneMask passed = mask;
      if (kMayTestStencil && tests_stencil) {
        stencil_before = hn::Load(kInt, stencil.values + index);
        passed = hn::And(mask, stencil_passes(stencil.constants, stencil_before));
        failed = hn::AndNot(passed, mask);
        mask = passed;
      }
      if constexpr (kHasDepth<Depth>) {
        std::int32_t* stored_at = context.memory.depth + index;
        const Int stored = hn::Load(kInt, stored_at);
        const Int key = depth.keys(block_depth, chunk);
        if constexpr (kDepthTest == DepthTestPath::less_write) {
          mask = hn::And(mask, hn::Lt(key, stored));
          hn::Store(hn::IfThenElse(mask, key, stored), kInt, stored_at);
        } else {
          mask = hn::And(mask, compare_lanes(key, draw.depth_test, stored));
          hn::Store(hn::IfThenElse(hn::And(mask, hn::MaskFromVec(depth_writable)), key, stored), kInt,
                    stored_at);
        }
      }
      if (kMayTestStencil && tests_stencil && stencil.constants.writes()) {
        const LaneMask zfailed = hn::AndNot(mask, passed);
        const Int after = stencil_result(stencil.constants, stencil_before, failed, zfailed, mask);
        hn::Store(after, kInt, stencil.values + index);
      }
      // Constant colours are stored without testing for an empty mask: that branch would be mispredicted.
      if constexpr (kColorWrite == ColorWrite::deferred) {
        auto* visibility = reinterpret_cast<std::int32_t*>(context.memory.visibility) + index;
        hn::Store(hn::IfThenElse(mask, splat(id), hn::Load(kInt, visibility)), kInt, visibility);
        visible = hn::Or(visible, hn::VecFromMask(kInt, mask));
      } else if constexpr (kColorWrite != ColorWrite::none) {
        const std::uint32_t bits = mask_bits(kInt, mask);
        if (is_interpolated(kColorWrite) && bits == 0) continue;
        visible_pixels += static_cast<std::uint32_t>(std::popcount(bits));
        std::uint32_t* const stored_at = context.color + index;
        const Int packed =
            packed_at(block_edges, bx, by, chunk, reinterpret_cast<const std::int32_t*>(stored_at));
        if (kFull && writes_all_planes) store_packed_all_bits(stored_at, packed, mask);
        else store_packed(stored_at, packed, mask, writable);
      }
    }
  }
  /// Packed colours of one chunk.
  /// @param stored_at  packed colours of the chunk in the tile, for blending
  template <class Edges>
  HWY_INLINE Int packed_at([[maybe_unused]] const Edges& block_edges, [[maybe_unused]] int bx,
                           [[maybe_unused]] int by, [[maybe_unused]] int chunk,
                           [[maybe_unused]] const std::int32_t* stored_at) const {
    if constexpr (kColorWrite == ColorWrite::constant) return splat(packed_color);
    else if constexpr (kColorWrite == ColorWrite::blended)
      return color.packed(barycentric_at(block_edges, bx, by, chunk), hn::Load(kInt, stored_at));
    else return color.packed(barycentric_at(block_edges, bx, by, chunk));
  }

  /// Edges of a narrow triangle serve both coverage and the weights of the vertices.
  template <class Edges>
  HWY_INLINE Barycentric barycentric_at(const Edges& block_edges, int bx, int by, int chunk) const {
    if (HWY_UNLIKELY(triangle.edges64_index >= 0))
      return barycentric_edges64(
          triangle, context.memory.edges64[static_cast<std::size_t>(triangle.edges64_index)], bx, by, chunk);
    return barycentric_from_edges(triangle, block_edges.at(0, chunk), block_edges.at(1, chunk),
                                  block_edges.at(2, chunk));
  }

  /// One pixel of a small triangle.
  HWY_INLINE void pixel(int x, int y) {
    const int index = context.pixel_index(x, y);
    const bool is_tested = kMayTestStencil && tests_stencil;
    if (is_tested && !stencil.passes(index)) return;
    if constexpr (kHasDepth<Depth>) {
      const std::int32_t key = depth.key(x, y);
      const std::int32_t stored = context.memory.depth[index];
      const bool passes =
          kDepthTest == DepthTestPath::less_write ? key < stored : compares(key, draw.depth_test, stored);
      if (is_tested) stencil.store_after_depth(index, passes);
      if (!passes) return;
      if (kDepthTest == DepthTestPath::less_write || draw.depth_write) context.memory.depth[index] = key;
    } else if (is_tested) {
      stencil.store_after_depth(index, true);
    }
    if constexpr (kColorWrite == ColorWrite::deferred) {
      context.memory.visibility[index] = static_cast<std::uint32_t>(id);
      visible = splat(-1);
    } else if constexpr (kColorWrite != ColorWrite::none) {
      ++context.counts.shaded_pixels;
      const std::uint32_t new_color = packed_pixel_at(x, y, context.color[index]);
      context.color[index] = (new_color & draw.write_mask) | (context.color[index] & ~draw.write_mask);
    }
  }

  /// color.packed() of a single pixel, with the same bits.
  HWY_INLINE std::uint32_t packed_pixel_at(int x, int y, [[maybe_unused]] std::uint32_t stored) const {
    // Interpolated colours of small triangles are evaluated in SmallTrianglePixels.
    if constexpr (kColorWrite != ColorWrite::blended) {
      return static_cast<std::uint32_t>(packed_color);
    } else {
      float w[3];
      for (int k = 0; k < 3; ++k)
        w[k] = std::fma(static_cast<float>(triangle.edges.at(k, x, y)), triangle.scale[k], triangle.shift[k]);
      const float inverse = triangle.affine ? 1.0f : 1.0f / (w[0] + w[1] + w[2]);
      const float b1 = w[1] * inverse, b2 = w[2] * inverse;
      return color.packed_pixel(b1, b2, stored);
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
