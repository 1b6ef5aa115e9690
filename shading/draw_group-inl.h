// Draws a group of set-up triangles into a tile: coverage by size, depth, and colour at once or later. One
// function for each combination of depth format, depth test and way of colouring that can occur; a draw picks
// one and knows no other.
#if defined(TESSERA_SHADING_DRAW_GROUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DRAW_GROUP_INL_H_
#undef TESSERA_SHADING_DRAW_GROUP_INL_H_
#else
#define TESSERA_SHADING_DRAW_GROUP_INL_H_
#endif

#include <bit>

#include "raster/coverage-inl.h"
#include "raster/triangle_setup-inl.h"
#include "shading/box_pixels-inl.h"
#include "shading/deferred-inl.h"
#include "shading/draw_kinds-inl.h"
#include "shading/fragment_word.h"
#include "shading/small_pixels-inl.h"
#include "shading/triangle_pixels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

HWY_INLINE std::size_t provoking_vertex(const TileDraw& draw, std::uint32_t element) {
  const std::size_t corner = std::size_t{element} * static_cast<std::size_t>(draw.element_corners) +
                             static_cast<std::size_t>(draw.provoking);
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
  return draw.attributes + provoking_vertex(draw, source) * static_cast<std::size_t>(draw.attribute_stride) +
         draw.color_attribute[face];
}

/// Everything but pixels of triangle i of the group.
template <class Depth, Test kTest, Seen kSeen>
HWY_INLINE void set_up_pixels(TrianglePixels<Depth, kTest, kSeen>& pixels, TileRun& run, const TileDraw& draw,
                              int i, bool back) {
  const TriangleGroup& g = run.memory.group;
  pixels.depth.set_up(g, i, run.tile_x, run.tile_y, run.frame.depth_kind);
  if constexpr (kSeen == Seen::interpolate)
    pixels.color.set_up(pixels.triangle, draw.color_attribute[back ? 1 : 0], run.frame.layout);
  if constexpr (kSeen == Seen::mix)
    pixels.color.set_up(pixels.triangle, draw,
                        draw.flat ? flat_color(draw, run.memory.source[i], back) : nullptr);
  if constexpr (kSeen == Seen::collect) pixels.id = static_cast<std::int32_t>(run.memory.triangles.size());
  if constexpr (kSeen == Seen::word)
    pixels.word = static_cast<std::int32_t>(triangle_word(run, draw, i, back));
}

/// The triangle as shading sees it.
inline HWY_NOINLINE void fill_shaded_triangle(ShadedTriangle& t, const TileRun& run, std::uint32_t draw,
                                              int i, bool back) {
  const TriangleGroup& g = run.memory.group;
  set_tile_edges(t.edges, g, i);  // in place: a copy would have to wait for each of its parts
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

HWY_INLINE void keep_wide_edges(ShadedTriangle& triangle, TileWorkspace::Memory& memory,
                                const WideEdges& edges) {
  triangle.wide = static_cast<std::int32_t>(memory.wide.size());
  memory.wide.push_back(edges);
}

/// The small triangles that were added, whose colours are interpolated.
template <class Depth, Test kTest>
HWY_NOINLINE void draw_small_pixels(TileRun& run, const TileDraw& draw, SmallPixels& pixels) {
  const TriangleGroup& g = run.memory.group;
  std::uint32_t* const color = run.color;
  std::int32_t* const stored_depth = run.memory.depth;
  pixels.set_up(run, draw);
  const std::uint32_t mask = draw.write_mask;
  const bool tests_stencil = has_stencil_test<kTest>(draw);
  PixelStencil stencil[2];
  if (tests_stencil)
    for (const bool back : {false, true}) stencil[back ? 1 : 0] = pixel_stencil(run, draw, back);
  std::uint64_t seen = 0;
  constexpr bool kHasKeys = SmallPixels::kHasKeys<Depth>;
  if constexpr (kHasKeys) pixels.set_up_keys(g, run.frame.depth_kind);
  Depth depth;
  for (int p = 0; p < pixels.count; ++p) {
    const int i = pixels.triangle(p), index = pixels.index[p];
    const std::size_t face = tests_stencil && is_back(run, draw, i) ? 1 : 0;
    if (tests_stencil && !stencil[face].passes(index)) continue;
    if constexpr (kHasDepth<Depth>) {
      if constexpr (!kHasKeys) depth.set_up(g, i, run.tile_x, run.tile_y, run.frame.depth_kind);
      const std::int32_t key = kHasKeys ? pixels.key[p]
                                        : depth.key(pixels.place[p] & 255, pixels.place[p] >> 8 & 255),
                         stored = stored_depth[index];
      const bool passes = kTest == Test::less ? key < stored : compares(key, draw.depth_test, stored);
      if (tests_stencil) stencil[face].store_after_depth(index, passes);
      if (!passes) continue;
      if (kTest == Test::less || draw.depth_write) stored_depth[index] = key;
    } else if (tests_stencil) {
      stencil[face].store_after_depth(index, true);
    }
    const auto word = static_cast<std::uint32_t>(pixels.word[p]);
    color[index] = (word & mask) | (color[index] & ~mask);
    ++seen;
  }
  run.counts.shaded_pixels += seen;
  pixels.count = 0;
  pixels.triangles = 0;
}

/// Keeps triangle i of the group, some of whose pixels were seen, until these are shaded.
/// @param wide_edges  of a wide triangle; else null
inline HWY_NOINLINE void collect_triangle(TileRun& run, std::uint32_t draw_number, int i, bool back,
                                          const WideEdges* wide_edges) {
  TileWorkspace::Memory& memory = run.memory;
  ShadedTriangle& triangle = memory.triangles.emplace_back();
  fill_shaded_triangle(triangle, run, draw_number, i, back);
  if (wide_edges != nullptr) keep_wide_edges(triangle, memory, *wide_edges);
  if (!run.frame.shade_at_once) return;
  const TriangleGroup& g = memory.group;
  shade_collected(run, g.x0[i], g.y0[i], g.x1[i], g.y1[i]);
  memory.triangles.clear();
  memory.wide.clear();
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
      without_pixel |=
          mask_bits(kInt, hn::Eq(hn::Load(kInt, reinterpret_cast<const std::int32_t*>(hits) + first),
                                 hn::Zero(kInt)))
          << first;
    }
  [[maybe_unused]] BoxGroup boxes;
  if constexpr (kHasBoxes<kTest>) {
    const std::uint32_t by_blocks = g.mask & ~small_ones;
    if (by_blocks != 0 && !run.cut) boxes.set_up(run, g, by_blocks);
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
      if (small_pixels.count != 0)
        draw_small_pixels<Depth, kTest>(run, draw, small_pixels);  // that come before
    }
    const bool back = is_back(run, draw, i);
    if constexpr (kHasBoxes<kTest>) {
      if ((boxes.triangles >> i & 1) != 0) {
        std::int32_t value = 0;
        if constexpr (kSeen == Seen::word)
          value = static_cast<std::int32_t>(triangle_word(run, draw, i, back));
        if constexpr (kSeen == Seen::collect) value = static_cast<std::int32_t>(memory.triangles.size());
        const std::uint32_t seen = draw_in_boxes<Depth, kSeen>(run, draw, boxes, i, value, back);
        if constexpr (kSeen != Seen::collect) run.counts.shaded_pixels += seen;
        else if (seen != 0) collect_triangle(run, draw_number, i, back, nullptr);
        continue;
      }
    }
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
      if (!hn::AllTrue(kInt, hn::Eq(pixels.seen, hn::Zero(kInt))))
        collect_triangle(run, draw_number, i, back, wide ? &wide_edges : nullptr);
    }
    if constexpr (is_interpolated(kSeen)) memory.wide.clear();
    if constexpr (is_interpolated(kSeen) || kSeen == Seen::word)
      run.counts.shaded_pixels += pixels.seen_pixels;
  }
  if constexpr (kSeen == Seen::interpolate) {
    if (small_pixels.count != 0) draw_small_pixels<Depth, kTest>(run, draw, small_pixels);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
