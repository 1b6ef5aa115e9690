// A triangle's way through the blocks of a tile: coverage, stencil, depth, and colour at once or later.
#if defined(TESSERA_SHADING_TRIANGLE_PIXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_TRIANGLE_PIXELS_INL_H_
#undef TESSERA_SHADING_TRIANGLE_PIXELS_INL_H_
#else
#define TESSERA_SHADING_TRIANGLE_PIXELS_INL_H_
#endif

#include <bit>
#include <cmath>

#include "raster/coverage-inl.h"
#include "shading/draw_kinds-inl.h"
#include "shading/fragment_ops-inl.h"
#include "shading/fragment_word.h"
#include "shading/tile_run-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// The colour of a pixel that is seen, where it is interpolated.
template <Seen kSeen>
struct ColorOf {
  using Type = ScaledColor;
};
template <>
struct ColorOf<Seen::mix> {
  using Type = MixedColor;
};

/// The stencil test of one face's pixels, one by one.
struct PixelStencil {
  StencilSteps steps{};
  std::int32_t* values = nullptr;

  /// Whether a pixel passes; what fails is stored.
  HWY_INLINE bool passes(int index) const {
    const bool does = steps.passes(values[index]);
    if (!does) store(index, steps.fail);
    return does;
  }
  HWY_INLINE void store_after_depth(int index, bool depth_passes) const {
    store(index, depth_passes ? steps.zpass : steps.zfail);
  }

 private:
  HWY_INLINE void store(int index, const StencilStep& step) const {
    std::int32_t& stored = values[index];
    stored = (stored & ~steps.write_mask) | (step(stored) & steps.write_mask);
  }
};
template <Test kTest>
HWY_INLINE bool has_stencil_test(const TileDraw& draw) {
  return kTest == Test::any && draw.ops != nullptr && draw.ops->stencil;
}
HWY_INLINE PixelStencil pixel_stencil(const TileRun& run, const TileDraw& draw, bool back) {
  return {.steps = stencil_steps(draw.ops->faces[back ? 1 : 0], draw.ops->stencil_most),
          .values = run.sample[0].stencil};
}

/// One triangle's way through the blocks of a tile.
template <class Depth, Test kTest, Seen kSeen>
struct TrianglePixels {
  static constexpr bool kMayTestStencil = kTest == Test::any;
  TileRun& run;
  const TileDraw& draw;
  const TileEdges& edges;
  BlockOffsets offsets;
  const ShadedTriangle& triangle;
  Depth depth;
  typename ColorOf<kSeen>::Type color;
  std::int32_t word = 0;
  std::int32_t id = 0;
  const bool tests_stencil;
  PixelStencil stencil{};
  std::uint32_t seen_pixels = 0;  // of those with a colour
  Int seen = hn::Zero(kInt);      // of those that wait for one: not 0 in the lanes that saw any
  Int writable, depth_writable;   // masks, so that there is nothing to branch on
  const bool cut;                 // the draw's rectangle cuts through blocks
  const bool writes_all_planes;
  const bool stores_full;  // full blocks without any mask

  HWY_INLINE TrianglePixels(TileRun& tile_run, const TileDraw& tile_draw, const TileEdges& tile_edges_,
                            const ShadedTriangle& shaded, bool back)
      : run(tile_run),
        draw(tile_draw),
        edges(tile_edges_),
        offsets(tile_edges_),
        triangle(shaded),
        tests_stencil(has_stencil_test<kTest>(tile_draw)),
        writable(splat(static_cast<std::int32_t>(tile_draw.write_mask))),
        depth_writable(splat(tile_draw.depth_write ? -1 : 0)),
        cut(tile_run.cut),
        writes_all_planes(tile_draw.write_mask == 0xffffffffu),
        stores_full(!kHasDepth<Depth> && !tile_run.cut && !tests_stencil && writes_all_planes) {
    if (tests_stencil) stencil = pixel_stencil(run, draw, back);
  }

  /// A block that is not full.
  template <bool kFull>
  HWY_INLINE void operator()(int bx, int by, const BlockEdges& block_edges) {
    static_assert(!kFull);  // those come by rows
    if constexpr (kSeen == Seen::mix) rare_block(bx, by, block_edges);
    else draw_chunks<false>(bx, by, run.block_index(bx, by), depth.block(bx, by), block_edges);
  }
  /// Once, where code is long and such blocks are few.
  HWY_NOINLINE void rare_block(int bx, int by, const BlockEdges& block_edges) {
    draw_chunks<false>(bx, by, run.block_index(bx, by), depth.block(bx, by), block_edges);
  }
  /// Blocks side by side, all of whose pixels are inside.
  HWY_INLINE void full_row(int bx, int by, int count, const BlockEdges& first) {
    int index = run.block_index(bx, by);
    RowEdges row_edges(edges, first);
    if constexpr (!kHasDepth<Depth> && (kSeen == Seen::word || is_interpolated(kSeen))) {
      if (stores_full) {
        seen_pixels += static_cast<std::uint32_t>(kBlockPixels * count);
        if constexpr (kSeen == Seen::word) fill_blocks(index, count);
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
  // The same without any test or mask: one word, and whatever there is at each pixel.
  HWY_INLINE void fill_blocks(int index, int count) const {
    auto* const first = reinterpret_cast<std::int32_t*>(run.color + index);
    for (int i = 0; i < kBlockPixels * count; i += kLanes) hn::Store(splat(word), kInt, first + i);
  }
  HWY_INLINE void store_row(int bx, int by, int index, int count, RowEdges& row_edges) {
    auto* stored_at = reinterpret_cast<std::int32_t*>(run.color + index);
    for (const int end = bx + 4 * count; bx < end; bx += 4, row_edges.step_right())
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk, stored_at += kLanes)
        hn::Store(words_at(row_edges, bx, by, chunk, stored_at), kInt, stored_at);
  }
  /// @param block  its index
  template <bool kFull, class Edges>
  HWY_INLINE void draw_chunks(int bx, int by, int block,
                              [[maybe_unused]] const typename Depth::Block& block_depth,
                              [[maybe_unused]] const Edges& block_edges) {
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const int index = block + chunk * kLanes;
      auto mask = hn::Eq(hn::Zero(kInt), hn::Zero(kInt));
      if constexpr (!kFull) mask = block_edges.covered(chunk);
      if (cut) mask = hn::And(mask, inside_rect(run.rect, bx, by, chunk));
      [[maybe_unused]] Int stencil_before = hn::Zero(kInt);
      [[maybe_unused]] LaneMask failed = no_lanes(), passed = mask;
      if (kMayTestStencil && tests_stencil) {
        stencil_before = hn::Load(kInt, stencil.values + index);
        passed = hn::And(mask, stencil_passes(stencil.steps, stencil_before));
        failed = hn::AndNot(passed, mask);
        mask = passed;
      }
      if constexpr (kHasDepth<Depth>) {
        std::int32_t* stored_at = run.memory.depth + index;
        const Int stored = hn::Load(kInt, stored_at), key = depth.keys(block_depth, chunk);
        if constexpr (kTest == Test::less) {
          mask = hn::And(mask, hn::Lt(key, stored));
          hn::Store(hn::IfThenElse(mask, key, stored), kInt, stored_at);
        } else {
          mask = hn::And(mask, comparing(key, draw.depth_test, stored));
          hn::Store(hn::IfThenElse(hn::And(mask, hn::MaskFromVec(depth_writable)), key, stored), kInt,
                    stored_at);
        }
      }
      if (kMayTestStencil && tests_stencil && stencil.steps.writes())
        hn::Store(stencil_result(stencil.steps, stencil_before, failed, hn::AndNot(mask, passed), mask), kInt,
                  stencil.values + index);
      // Cheap colours are blended in without a look at the mask: a branch on it could not be foretold.
      if constexpr (kSeen == Seen::collect) {
        auto* ids = reinterpret_cast<std::int32_t*>(run.memory.ids) + index;
        hn::Store(hn::IfThenElse(mask, splat(id), hn::Load(kInt, ids)), kInt, ids);
        seen = hn::Or(seen, hn::VecFromMask(kInt, mask));
      } else if constexpr (kSeen != Seen::nothing) {
        const std::uint32_t bits = mask_bits(kInt, mask);
        if (is_interpolated(kSeen) && bits == 0) continue;
        seen_pixels += static_cast<std::uint32_t>(std::popcount(bits));
        std::uint32_t* const stored_at = run.color + index;
        const Int words =
            words_at(block_edges, bx, by, chunk, reinterpret_cast<const std::int32_t*>(stored_at));
        kFull&& writes_all_planes ? store_whole_words(stored_at, words, mask)
                                  : store_words(stored_at, words, mask, writable);
      }
    }
  }
  /// @param stored_at  what is there in the frame buffer, for what is mixed with it
  template <class Edges>
  HWY_INLINE Int words_at([[maybe_unused]] const Edges& block_edges, [[maybe_unused]] int bx,
                          [[maybe_unused]] int by, [[maybe_unused]] int chunk,
                          [[maybe_unused]] const std::int32_t* stored_at) const {
    if constexpr (kSeen == Seen::word) return splat(word);
    else if constexpr (kSeen == Seen::mix)
      return color.words(barycentric_at(block_edges, bx, by, chunk), hn::Load(kInt, stored_at));
    else return color.words(barycentric_at(block_edges, bx, by, chunk));
  }

  /// The edges that cover a narrow triangle's pixels are those that weigh its vertices.
  template <class Edges>
  HWY_INLINE Barycentric barycentric_at(const Edges& block_edges, int bx, int by, int chunk) const {
    if (HWY_UNLIKELY(triangle.wide >= 0))
      return barycentric_wide(triangle, run.memory.wide[static_cast<std::size_t>(triangle.wide)], bx, by,
                              chunk);
    return barycentric_from_edges(triangle, block_edges.at(0, chunk), block_edges.at(1, chunk),
                                  block_edges.at(2, chunk));
  }

  /// One pixel of a small triangle.
  HWY_INLINE void pixel(int x, int y) {
    const int index = run.pixel_index(x, y);
    const bool is_tested = kMayTestStencil && tests_stencil;
    if (is_tested && !stencil.passes(index)) return;
    if constexpr (kHasDepth<Depth>) {
      const std::int32_t key = depth.key(x, y), stored = run.memory.depth[index];
      const bool passes = kTest == Test::less ? key < stored : compares(key, draw.depth_test, stored);
      if (is_tested) stencil.store_after_depth(index, passes);
      if (!passes) return;
      if (kTest == Test::less || draw.depth_write) run.memory.depth[index] = key;
    } else if (is_tested) {
      stencil.store_after_depth(index, true);
    }
    if constexpr (kSeen == Seen::collect) {
      run.memory.ids[index] = static_cast<std::uint32_t>(id);
      seen = splat(-1);
    } else if constexpr (kSeen != Seen::nothing) {
      ++run.counts.shaded_pixels;
      const std::uint32_t new_word = pixel_word(x, y, run.color[index]);
      run.color[index] = (new_word & draw.write_mask) | (run.color[index] & ~draw.write_mask);
    }
  }

  /// color.words() for a single pixel, step by step the same.
  HWY_INLINE std::uint32_t pixel_word(int x, int y, [[maybe_unused]] std::uint32_t stored) const {
    if constexpr (kSeen != Seen::mix) {  // those that are interpolated and nothing else stand in SmallPixels
      return static_cast<std::uint32_t>(word);
    } else {
      float w[3];
      for (int k = 0; k < 3; ++k) {
        w[k] = std::fma(static_cast<float>(triangle.edges.at(k, x, y)), triangle.scale[k], triangle.shift[k]);
      }
      const float inverse = triangle.affine ? 1.0f : 1.0f / (w[0] + w[1] + w[2]);
      const float b1 = w[1] * inverse, b2 = w[2] * inverse;
      return color.word(b1, b2, stored);
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
