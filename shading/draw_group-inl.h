// Draws a group of set-up triangles into a tile: coverage by size, depth, and colour at once or later. One function for each
// combination of depth format, depth test and way of colouring that can occur; a draw picks one and knows no other.
#if defined(TESSERA_SHADING_DRAW_GROUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DRAW_GROUP_INL_H_
#undef TESSERA_SHADING_DRAW_GROUP_INL_H_
#else
#define TESSERA_SHADING_DRAW_GROUP_INL_H_
#endif

#include <bit>

#include "raster/coverage-inl.h"
#include "raster/depth-inl.h"
#include "raster/triangle_setup-inl.h"
#include "shading/deferred-inl.h"
#include "shading/fragment_ops-inl.h"
#include "shading/fragment_word.h"
#include "shading/small_pixels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// What happens to a pixel that is seen.
enum class Seen { nothing, word, interpolate, mix, collect };
inline constexpr bool is_interpolated(Seen seen) { return seen == Seen::interpolate || seen == Seen::mix; }
/// Its colour, where it is interpolated.
template <Seen kSeen>
struct ColorOf {
  using Type = ScaledColor;
};
template <>
struct ColorOf<Seen::mix> {
  using Type = MixedColor;
};
/// `less`, by draws that write depth and have no operations, has code of its own, since nearly everybody uses it.
enum class Test { less, any };
struct NoDepth {
  struct Block {};
  HWY_INLINE Block block(int, int) const { return {}; }
  HWY_INLINE void step_right(Block&) const {}
  HWY_INLINE void set_up(const TriangleGroup&, int, int, int, DepthKind) {}
  HWY_INLINE void prepare_blocks() {}
  struct Anchor {};
  static HWY_INLINE Anchor anchor(const TriangleGroup&, const SampleGroup&, int, int, SamplePosition, int, int) { return {}; }
  HWY_INLINE Block step_to(int, int) const { return {}; }
};
template <class Depth>
inline constexpr bool kHasDepth = true;
template <>
inline constexpr bool kHasDepth<NoDepth> = false;

/// The sum of lanes of minus how many.
HWY_INLINE std::uint64_t count_of(Int negative) {
  alignas(64) std::int32_t lanes[kLanes];
  hn::Store(negative, kInt, lanes);
  std::int64_t sum = 0;
  for (const std::int32_t lane : lanes) sum -= lane;
  return static_cast<std::uint64_t>(sum);
}

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
  HWY_INLINE void store_after_depth(int index, bool depth_passes) const { store(index, depth_passes ? steps.zpass : steps.zfail); }

 private:
  HWY_INLINE void store(int index, const StencilStep& step) const {
    std::int32_t& stored = values[index];
    stored = (stored & ~steps.write_mask) | (step(stored) & steps.write_mask);
  }
};
template <Test kTest>
HWY_INLINE bool has_stencil_test(const TileDraw& draw) { return kTest == Test::any && draw.ops != nullptr && draw.ops->stencil; }
HWY_INLINE PixelStencil pixel_stencil(const TileRun& run, const TileDraw& draw, bool back) {
  return {.steps = stencil_steps(draw.ops->faces[back ? 1 : 0], draw.ops->stencil_most), .values = run.sample[0].stencil};
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
  Int writable, depth_writable;  // masks, so that there is nothing to branch on
  const bool cut;                // the draw's rectangle cuts through blocks
  const bool writes_all_planes;
  const bool stores_full;        // full blocks without any mask

  HWY_INLINE TrianglePixels(TileRun& tile_run, const TileDraw& tile_draw, const TileEdges& tile_edges_, const ShadedTriangle& shaded, bool back)
      : run(tile_run), draw(tile_draw), edges(tile_edges_), offsets(tile_edges_), triangle(shaded),
        tests_stencil(has_stencil_test<kTest>(tile_draw)),
        writable(splat(static_cast<std::int32_t>(tile_draw.write_mask))), depth_writable(splat(tile_draw.depth_write ? -1 : 0)), cut(tile_run.cut),
        writes_all_planes(tile_draw.write_mask == 0xffffffffu), stores_full(!kHasDepth<Depth> && !tile_run.cut && !tests_stencil && writes_all_planes) {
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
  HWY_NOINLINE void rare_block(int bx, int by, const BlockEdges& block_edges) { draw_chunks<false>(bx, by, run.block_index(bx, by), depth.block(bx, by), block_edges); }
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
    auto* const first = reinterpret_cast<std::int32_t*>(run.memory.color + index);
    for (int i = 0; i < kBlockPixels * count; i += kLanes) hn::Store(splat(word), kInt, first + i);
  }
  HWY_INLINE void store_row(int bx, int by, int index, int count, RowEdges& row_edges) {
    for (const int end = index + kBlockPixels * count; index < end; bx += 4, row_edges.step_right())
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk, index += kLanes) {
        auto* const stored_at = reinterpret_cast<std::int32_t*>(run.memory.color + index);
        hn::Store(words_at(row_edges, bx, by, chunk, stored_at), kInt, stored_at);
      }
  }
  /// @param block  its index
  template <bool kFull, class Edges>
  HWY_INLINE void draw_chunks(int bx, int by, int block, [[maybe_unused]] const typename Depth::Block& block_depth, [[maybe_unused]] const Edges& block_edges) {
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
          hn::Store(hn::IfThenElse(hn::And(mask, hn::MaskFromVec(depth_writable)), key, stored), kInt, stored_at);
        }
      }
      if (kMayTestStencil && tests_stencil && stencil.steps.writes())
        hn::Store(stencil_result(stencil.steps, stencil_before, failed, hn::AndNot(mask, passed), mask), kInt, stencil.values + index);
      // Cheap colours are blended in without a look at the mask: a branch on it could not be foretold.
      if constexpr (kSeen == Seen::collect) {
        auto* ids = reinterpret_cast<std::int32_t*>(run.memory.ids) + index;
        hn::Store(hn::IfThenElse(mask, splat(id), hn::Load(kInt, ids)), kInt, ids);
        seen = hn::Or(seen, hn::VecFromMask(kInt, mask));
      } else if constexpr (kSeen != Seen::nothing) {
        const std::uint32_t bits = mask_bits(kInt, mask);
        if (is_interpolated(kSeen) && bits == 0) continue;
        seen_pixels += static_cast<std::uint32_t>(std::popcount(bits));
        std::uint32_t* const stored_at = run.memory.color + index;
        const Int words = words_at(block_edges, bx, by, chunk, reinterpret_cast<const std::int32_t*>(stored_at));
        kFull && writes_all_planes ? store_whole_words(stored_at, words, mask) : store_words(stored_at, words, mask, writable);
      }
    }
  }
  /// @param stored_at  what is there in the frame buffer, for what is mixed with it
  template <class Edges>
  HWY_INLINE Int words_at([[maybe_unused]] const Edges& block_edges, [[maybe_unused]] int bx, [[maybe_unused]] int by, [[maybe_unused]] int chunk, [[maybe_unused]] const std::int32_t* stored_at) const {
    if constexpr (kSeen == Seen::word) return splat(word);
    else if constexpr (kSeen == Seen::mix) return color.words(barycentric_at(block_edges, bx, by, chunk), hn::Load(kInt, stored_at));
    else return color.words(barycentric_at(block_edges, bx, by, chunk));
  }

  /// The edges that cover a narrow triangle's pixels are those that weigh its vertices.
  template <class Edges>
  HWY_INLINE Barycentric barycentric_at(const Edges& block_edges, int bx, int by, int chunk) const {
    if (triangle.wide >= 0) return barycentric_wide(triangle, run.memory.wide[static_cast<std::size_t>(triangle.wide)], bx, by, chunk);
    return barycentric_from_edges(triangle, block_edges.at(0, chunk), block_edges.at(1, chunk), block_edges.at(2, chunk));
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
      const std::uint32_t new_word = pixel_word(x, y, run.memory.color[index]);
      run.memory.color[index] = (new_word & draw.write_mask) | (run.memory.color[index] & ~draw.write_mask);
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

HWY_INLINE std::size_t provoking_vertex(const TileDraw& draw, std::uint32_t element) {
  const std::size_t corner = std::size_t{element} * static_cast<std::size_t>(draw.element_corners) + static_cast<std::size_t>(draw.provoking);
  return draw.indices ? draw.indices[corner] : corner;
}

/// The word of triangle i of the group, where it has one.
HWY_INLINE std::uint32_t triangle_word(const TileRun& run, const TileDraw& draw, int i, bool back) {
  if (draw.source == ColorSource::triangle_word) return draw.words[back ? 1 : 0][run.memory.source[i]];
  if (draw.source != ColorSource::vertex_word) return draw.word;
  return draw.words[back ? 1 : 0][provoking_vertex(draw, run.memory.source[i])];
}

/// The colour of a flat triangle: its own, or that of its provoking vertex.
HWY_INLINE const float* flat_color(const TileDraw& draw, std::uint32_t source, bool back) {
  const int face = back ? 1 : 0;
  if (draw.face_colors[face] != nullptr) return draw.face_colors[face] + std::size_t{source} * 4;
  return draw.attributes + provoking_vertex(draw, source) * static_cast<std::size_t>(draw.attribute_stride) + draw.color_attribute[face];
}

/// Whether triangle i of the group shows its back: by its own area, or as its polygon does.
HWY_INLINE bool is_back(const TileRun& run, const TileDraw& draw, int i) {
  if (draw.facing != nullptr) return draw.facing[run.memory.source[i]] == Facing::back;
  return !is_front(run.memory.group.signed_area[i], draw.front_is_clockwise);
}

/// Everything but pixels of triangle i of the group.
template <class Depth, Test kTest, Seen kSeen>
HWY_INLINE void set_up_pixels(TrianglePixels<Depth, kTest, kSeen>& pixels, TileRun& run, const TileDraw& draw, int i, bool back) {
  const TriangleGroup& g = run.memory.group;
  pixels.depth.set_up(g, i, run.tile_x, run.tile_y, run.frame.depth_kind);
  if constexpr (kSeen == Seen::interpolate) pixels.color.set_up(pixels.triangle, draw.color_attribute[back ? 1 : 0], run.frame.layout);
  if constexpr (kSeen == Seen::mix) pixels.color.set_up(pixels.triangle, draw, draw.flat ? flat_color(draw, run.memory.source[i], back) : nullptr);
  if constexpr (kSeen == Seen::collect) pixels.id = static_cast<std::int32_t>(run.memory.triangles.size());
  if constexpr (kSeen == Seen::word) pixels.word = static_cast<std::int32_t>(triangle_word(run, draw, i, back));
}

/// The triangle as shading sees it.
inline HWY_NOINLINE void fill_shaded_triangle(ShadedTriangle& t, const TileRun& run, std::uint32_t draw, int i, bool back) {
  const TriangleGroup& g = run.memory.group;
  t.edges = tile_edges(g, i);
  for (int k = 0; k < 3; ++k) {
    t.scale[k] = g.wide[i] != 0 ? g.unit_scale[k][i] : g.scale[k][i];
    t.shift[k] = g.shift[k][i];
    t.attributes[k] = run.memory.attributes[k][i];
  }
  t.affine = g.affine[i] != 0;
  t.back = back;
  t.draw = draw;
  t.wide = -1;
}

HWY_INLINE void keep_wide_edges(ShadedTriangle& triangle, TileWorkspace::Memory& memory, const WideEdges& edges) {
  triangle.wide = static_cast<std::int32_t>(memory.wide.size());
  memory.wide.push_back(edges);
}

/// The small triangles that were added, whose colours are interpolated.
template <class Depth, Test kTest>
HWY_NOINLINE void draw_small_pixels(TileRun& run, const TileDraw& draw, SmallPixels& pixels) {
  const TileWorkspace::Memory& memory = run.memory;
  const TriangleGroup& g = memory.group;
  pixels.set_up(run);
  const PixelColor color(run.frame.layout);
  const std::uint32_t mask = draw.write_mask;
  const bool has_faces = draw.color_attribute[0] != draw.color_attribute[1], tests_stencil = has_stencil_test<kTest>(draw);
  PixelStencil stencil[2];
  if (tests_stencil)
    for (const bool back : {false, true}) stencil[back ? 1 : 0] = pixel_stencil(run, draw, back);
  std::uint64_t seen = 0;
  constexpr bool kHasKeys = SmallPixels::kHasKeys<Depth>;
  if constexpr (kHasKeys) pixels.set_up_keys(g, run.frame.depth_kind);
  Depth depth;
  for (int p = 0; p < pixels.count; ++p) {
    const int i = pixels.triangle(p), index = pixels.index[p];
    const std::size_t face = (has_faces || tests_stencil) && is_back(run, draw, i) ? 1 : 0;
    if (tests_stencil && !stencil[face].passes(index)) continue;
    if constexpr (kHasDepth<Depth>) {
      if constexpr (!kHasKeys) depth.set_up(g, i, run.tile_x, run.tile_y, run.frame.depth_kind);
      const std::int32_t key = kHasKeys ? pixels.key[p] : depth.key(pixels.place[p] & 255, pixels.place[p] >> 8 & 255), stored = memory.depth[index];
      const bool passes = kTest == Test::less ? key < stored : compares(key, draw.depth_test, stored);
      if (tests_stencil) stencil[face].store_after_depth(index, passes);
      if (!passes) continue;
      if (kTest == Test::less || draw.depth_write) run.memory.depth[index] = key;
    } else if (tests_stencil) {
      stencil[face].store_after_depth(index, true);
    }
    const int attribute = draw.color_attribute[face];
    const std::uint32_t word = color.word(memory.attributes[0][i] + attribute, memory.attributes[1][i] + attribute, memory.attributes[2][i] + attribute, pixels.b1[p], pixels.b2[p]);
    run.memory.color[index] = (word & mask) | (run.memory.color[index] & ~mask);
    ++seen;
  }
  run.counts.shaded_pixels += seen;
  pixels.count = 0;
}

template <class Depth, Test kTest, Seen kSeen>
void draw_group(TileRun& run, std::uint32_t draw_number) {
  TileWorkspace::Memory& memory = run.memory;
  TriangleGroup& g = memory.group;
  const TileDraw& draw = run.frame.draws[draw_number];
  set_up_edges(g, run.tile_x, run.tile_y, run.rect);
  if (g.mask == 0) return;
  if constexpr (kHasDepth<Depth>) set_up_depth(g, run.frame.depth_kind, run.tile_x, run.tile_y);
  if constexpr (is_interpolated(kSeen) || kSeen == Seen::collect) set_up_weights(g);

  alignas(64) std::uint32_t hits[kGroupSize];
  const std::uint32_t small_ones = small_triangles(g);
  std::uint32_t without_pixel = 0;
  if (small_ones != 0)
    for (int first = 0; first < kGroupSize; first += kLanes) {
      cover_small(g, first, hits + first);
      without_pixel |= mask_bits(kInt, hn::Eq(hn::Load(kInt, reinterpret_cast<const std::int32_t*>(hits) + first), hn::Zero(kInt))) << first;
    }
  [[maybe_unused]] SmallPixels small_pixels;
  for (std::uint32_t left = g.mask & ~(small_ones & without_pixel); left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    const bool wide = g.wide[i] != 0, small = (small_ones >> i & 1) != 0;
    if constexpr (kSeen == Seen::interpolate) {
      if (small) {
        small_pixels.add(g, i, hits[i]);
        continue;
      }
      if (small_pixels.count != 0) draw_small_pixels<Depth, kTest>(run, draw, small_pixels);  // that come before
    }
    const bool back = is_back(run, draw, i);
    TileEdges edges = tile_edges(g, i);
    WideEdges wide_edges;
    if (wide && !tile_edges_of_wide(g, i, run.tile_x, run.tile_y, run.tile_size, edges, wide_edges)) continue;

    ShadedTriangle triangle;
    if constexpr (is_interpolated(kSeen)) {
      fill_shaded_triangle(triangle, run, draw_number, i, back);
      if (wide) keep_wide_edges(triangle, memory, wide_edges);
    }
    TrianglePixels<Depth, kTest, kSeen> pixels(run, draw, edges, triangle, back);
    set_up_pixels(pixels, run, draw, i, back);
    if (kSeen != Seen::interpolate && small) {
      for (std::uint32_t hit = hits[i]; hit != 0; hit &= hit - 1) {
        const int p = std::countr_zero(hit);
        pixels.pixel(g.x0[i] + (p & 3), g.y0[i] + (p >> 2));
      }
    } else {
      if constexpr (kHasDepth<Depth>) pixels.depth.prepare_blocks();
      if constexpr (kSeen == Seen::mix) pixels.color.prepare_lanes();
      for_each_block(edges, pixels.offsets, g.x0[i], g.y0[i], g.x1[i], g.y1[i], pixels);
    }
    if constexpr (kSeen == Seen::collect) {
      if (hn::AllTrue(kInt, hn::Eq(pixels.seen, hn::Zero(kInt)))) continue;
      fill_shaded_triangle(triangle, run, draw_number, i, back);
      if (wide) keep_wide_edges(triangle, memory, wide_edges);
      memory.triangles.push_back(triangle);
      if (run.frame.shade_at_once) {
        shade_collected(run, g.x0[i], g.y0[i], g.x1[i], g.y1[i]);
        memory.triangles.clear();
        memory.wide.clear();
      }
    }
    if constexpr (is_interpolated(kSeen)) memory.wide.clear();
    if constexpr (is_interpolated(kSeen) || kSeen == Seen::word) run.counts.shaded_pixels += pixels.seen_pixels;
  }
  if constexpr (kSeen == Seen::interpolate) {
    if (small_pixels.count != 0) draw_small_pixels<Depth, kTest>(run, draw, small_pixels);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
