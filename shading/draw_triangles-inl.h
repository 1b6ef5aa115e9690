// Draws a group of triangles into a tile: small ones pixel by pixel, medium ones as boxes of blocks, all
// others by rows of blocks. There is one function per combination of depth type, DepthTestPath and
// ColorWrite. Each draw_triangles_*.cpp compiles those of one depth type.
#if defined(TESSERA_SHADING_DRAW_TRIANGLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DRAW_TRIANGLES_INL_H_
#undef TESSERA_SHADING_DRAW_TRIANGLES_INL_H_
#else
#define TESSERA_SHADING_DRAW_TRIANGLES_INL_H_
#endif

#include <bit>

#include "shading/box_pixels-inl.h"
#include "shading/draw_functions-inl.h"
#include "shading/fragment_scalar.h"
#include "shading/no_depth-inl.h"
#include "shading/primitive_color-inl.h"
#include "shading/small_triangle_pixels-inl.h"
#include "shading/triangle_pixels-inl.h"
#include "shading/visible_triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Sets up depth and colour of triangle i of the group.
template <class Depth, DepthTestPath kDepthTest, ColorWrite kColorWrite>
HWY_INLINE void set_up_pixels(TrianglePixels<Depth, kDepthTest, kColorWrite>& pixels, TileContext& context,
                              const TileDraw& draw, int i, bool back) {
  const TriangleGroup& g = context.memory.group;
  pixels.depth.set_up(g, i, context.tile_x, context.tile_y, context.frame.depth_format);
  if constexpr (kColorWrite == ColorWrite::interpolated)
    pixels.color.set_up(pixels.triangle, draw.color_attribute[back ? 1 : 0], context.frame.layout);
  if constexpr (kColorWrite == ColorWrite::blended)
    pixels.color.set_up(pixels.triangle, draw,
                        draw.flat ? flat_color(draw, context.memory.source[i], back) : nullptr);
  if constexpr (kColorWrite == ColorWrite::deferred)
    pixels.id = static_cast<std::int32_t>(context.memory.visible_triangles.size());
  if constexpr (kColorWrite == ColorWrite::constant)
    pixels.packed_color = static_cast<std::int32_t>(packed_color_of(context, draw, i, back));
}

/// Draws the collected pixels of small triangles with interpolated colours, and empties `pixels`.
template <class Depth, DepthTestPath kDepthTest>
HWY_NOINLINE void draw_small_triangles(TileContext& context, const TileDraw& draw,
                                       SmallTrianglePixels& pixels) {
  const TriangleGroup& g = context.memory.group;
  std::uint32_t* const color = context.color;
  std::int32_t* const stored_depth = context.memory.depth;
  pixels.set_up(context, draw);
  const std::uint32_t mask = draw.write_mask;
  const bool tests_stencil = has_stencil_test<kDepthTest>(draw);
  PixelStencil stencil[2];  // per face
  if (tests_stencil) {
    stencil[0] = pixel_stencil(context, draw, false);
    stencil[1] = pixel_stencil(context, draw, true);
  }
  std::uint64_t visible_pixels = 0;
  constexpr bool kHasKeys = SmallTrianglePixels::kHasKeys<Depth>;
  if constexpr (kHasKeys) pixels.set_up_keys(g, context.frame.depth_format);
  Depth depth;
  for (int p = 0; p < pixels.count; ++p) {
    const int i = pixels.triangle(p);
    const int index = pixels.index[p];
    const std::size_t face = tests_stencil && is_back(context, draw, i) ? 1 : 0;
    if (tests_stencil && !stencil[face].passes(index)) continue;
    if constexpr (kHasDepth<Depth>) {
      if constexpr (!kHasKeys) depth.set_up(g, i, context.tile_x, context.tile_y, context.frame.depth_format);
      const std::int32_t key =
          kHasKeys ? pixels.key[p] : depth.key(pixels.place[p] & 255, pixels.place[p] >> 8 & 255);
      const std::int32_t stored = stored_depth[index];
      const bool passes =
          kDepthTest == DepthTestPath::less_write ? key < stored : compares(key, draw.depth_test, stored);
      if (tests_stencil) stencil[face].store_after_depth(index, passes);
      if (!passes) continue;
      if (kDepthTest == DepthTestPath::less_write || draw.depth_write) stored_depth[index] = key;
    } else if (tests_stencil) {
      stencil[face].store_after_depth(index, true);
    }
    const auto packed = static_cast<std::uint32_t>(pixels.packed[p]);
    color[index] = (packed & mask) | (color[index] & ~mask);
    ++visible_pixels;
  }
  context.counts.shaded_pixels += visible_pixels;
  pixels.count = 0;
  pixels.triangles = 0;
}

/// Adds triangle i of the group to the visible triangles. @pre it has pixels in the visibility buffer
/// @param edges64  edges of a wide triangle; null if narrow
inline HWY_NOINLINE void defer_triangle(TileContext& context, std::uint32_t draw_number, int i, bool back,
                                        const Edges64* edges64) {
  TileWorkspace::Memory& memory = context.memory;
  ShadedTriangle& triangle = memory.visible_triangles.emplace_back();
  fill_shaded_triangle(triangle, context, draw_number, i, back);
  if (edges64 != nullptr) store_edges64(triangle, memory, *edges64);
  if (!context.frame.shade_immediately) return;
  const TriangleGroup& g = memory.group;
  shade_visible(context, g.x0[i], g.y0[i], g.x1[i], g.y1[i]);
  memory.visible_triangles.clear();
  memory.edges64.clear();
}

/// The group's triangles whose bounds are at most 4x4 pixels, and the pixels that each of them covers.
struct SmallTriangles {
  std::uint32_t triangles;                     // one bit each
  std::uint32_t uncovered;                     // small triangles without a pixel, one bit each
  alignas(64) std::uint32_t hits[kGroupSize];  // covered pixels: 4 rows of 4 bits from (x0, y0)

  HWY_INLINE explicit SmallTriangles(const TriangleGroup& g) : triangles(small_triangles(g)), uncovered(0) {
    if (triangles == 0) return;
    for (int first = 0; first < kGroupSize; first += kLanes) {
      cover_small(g, first, hits + first);
      const Int covered = hn::Load(kInt, reinterpret_cast<const std::int32_t*>(hits) + first);
      uncovered |= mask_bits(kInt, hn::Eq(covered, hn::Zero(kInt))) << first;
    }
    uncovered &= triangles;
  }
  HWY_INLINE bool contains(int i) const { return (triangles >> i & 1) != 0; }
};

/// Draws triangle i of the group, which is in boxes.
template <class Depth, ColorWrite kColorWrite>
HWY_INLINE void draw_triangle_in_boxes(TileContext& context, const TileDraw& draw, std::uint32_t draw_number,
                                       const BoxGroup& boxes, int i) {
  const bool back = is_back(context, draw, i);
  std::int32_t value = 0;
  if constexpr (kColorWrite == ColorWrite::constant)
    value = static_cast<std::int32_t>(packed_color_of(context, draw, i, back));
  if constexpr (kColorWrite == ColorWrite::deferred)
    value = static_cast<std::int32_t>(context.memory.visible_triangles.size());
  const std::uint32_t visible = draw_in_boxes<Depth, kColorWrite>(context, draw, boxes, i, value, back);
  if constexpr (kColorWrite != ColorWrite::deferred) context.counts.shaded_pixels += visible;
  else if (visible != 0) defer_triangle(context, draw_number, i, back, nullptr);
}

/// Draws triangle i of the group, pixel by pixel if it is small, otherwise by rows of blocks.
template <class Depth, DepthTestPath kDepthTest, ColorWrite kColorWrite>
HWY_INLINE void draw_triangle_by_edges(TileContext& context, const TileDraw& draw, std::uint32_t draw_number,
                                       const SmallTriangles& small, int i, const TileEdges& edges) {
  const TriangleGroup& g = context.memory.group;
  const bool back = is_back(context, draw, i);
  ShadedTriangle triangle;
  if constexpr (is_interpolated(kColorWrite))
    fill_shaded_triangle(triangle, context, draw_number, i, back, edges);
  TrianglePixels<Depth, kDepthTest, kColorWrite> pixels(context, draw, edges.edges, triangle, back);
  set_up_pixels(pixels, context, draw, i, back);
  if (kColorWrite != ColorWrite::interpolated && small.contains(i)) {
    for (std::uint32_t hit = small.hits[i]; hit != 0; hit &= hit - 1) {
      const int p = std::countr_zero(hit);
      pixels.pixel(g.x0[i] + (p & 3), g.y0[i] + (p >> 2));
    }
  } else {
    if constexpr (kHasDepth<Depth>) pixels.depth.prepare_blocks();
    if constexpr (kColorWrite == ColorWrite::blended) pixels.color.prepare_lanes();
    for_each_block(edges.edges, pixels.offsets, g.x0[i], g.y0[i], g.x1[i], g.y1[i], pixels);
  }
  if constexpr (kColorWrite == ColorWrite::deferred) {
    if (!hn::AllTrue(kInt, hn::Eq(pixels.visible, hn::Zero(kInt))))
      defer_triangle(context, draw_number, i, back, edges.is_wide ? &edges.edges64 : nullptr);
  }
  if constexpr (is_interpolated(kColorWrite)) context.memory.edges64.clear();
  if constexpr (is_interpolated(kColorWrite) || kColorWrite == ColorWrite::constant)
    context.counts.shaded_pixels += pixels.visible_pixels;
}

template <class Depth, DepthTestPath kDepthTest, ColorWrite kColorWrite>
void draw_triangles(TileContext& context, std::uint32_t draw_number) {
  const TriangleGroup& g = context.memory.group;
  const TileDraw& draw = context.frame.draws[draw_number];
  constexpr bool kNeedsWeights = is_interpolated(kColorWrite) || kColorWrite == ColorWrite::deferred;
  const std::uint32_t in_tile = set_up_group(context, kHasDepth<Depth>, kNeedsWeights);
  if (in_tile == 0) return;

  const SmallTriangles small(g);
  [[maybe_unused]] BoxGroup boxes;
  if constexpr (kHasBoxes<kDepthTest>) {
    const std::uint32_t by_blocks = in_tile & ~small.triangles;
    if (by_blocks != 0 && !context.needs_scissor) boxes.set_up(context, g, by_blocks);
  }
  [[maybe_unused]] SmallTrianglePixels small_pixels;

  const auto draw_without_edges = [&](int i) TESSERA_LOOP_BODY {
    if constexpr (kColorWrite == ColorWrite::interpolated) {
      if (small.contains(i)) {
        small_pixels.add(g, i, small.hits[i]);
        return true;
      }
      // Triangles are drawn in order: the small ones collected so far come first.
      if (small_pixels.count != 0) draw_small_triangles<Depth, kDepthTest>(context, draw, small_pixels);
    }
    if constexpr (kHasBoxes<kDepthTest>) {
      if ((boxes.triangles >> i & 1) == 0) return false;
      draw_triangle_in_boxes<Depth, kColorWrite>(context, draw, draw_number, boxes, i);
      return true;
    }
    return false;
  };
  const auto draw_by_edges = [&](int i, const TileEdges& edges) TESSERA_LOOP_BODY {
    draw_triangle_by_edges<Depth, kDepthTest, kColorWrite>(context, draw, draw_number, small, i, edges);
  };
  for_each_visible_triangle(context, in_tile & ~small.uncovered, draw_without_edges, draw_by_edges);
  if constexpr (kColorWrite == ColorWrite::interpolated) {
    if (small_pixels.count != 0) draw_small_triangles<Depth, kDepthTest>(context, draw, small_pixels);
  }
}

template <class Depth, DepthTestPath kDepthTest>
DrawGroupFunction triangles_function_by_color(ColorWrite color_write) {
  switch (color_write) {
    case ColorWrite::none: return &draw_triangles<Depth, kDepthTest, ColorWrite::none>;
    case ColorWrite::constant: return &draw_triangles<Depth, kDepthTest, ColorWrite::constant>;
    case ColorWrite::interpolated: return &draw_triangles<Depth, kDepthTest, ColorWrite::interpolated>;
    case ColorWrite::blended: return &draw_triangles<Depth, DepthTestPath::generic, ColorWrite::blended>;
    default: return &draw_triangles<Depth, kDepthTest, ColorWrite::deferred>;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
