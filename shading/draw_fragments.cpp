// Triangles with fragment operations, block by block.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/draw_fragments.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>

#include "shading/draw_functions-inl.h"
#include "shading/fragment_depth-inl.h"
#include "shading/fragment_triangle-inl.h"
#include "shading/visible_triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Functor for for_each_block(): coverage and depth of a triangle's blocks.
struct FragmentBlocks {
  FragmentTriangle& fragments;
  FragmentDepth depth;

  template <bool kFull>
  HWY_INLINE void operator()(int bx, int by, const BlockEdges& edges) {
    const TileContext& context = fragments.context;
    BlockFragments block;
    depth.block_keys(bx, by, block.keys);
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      auto mask = kFull ? hn::Eq(hn::Zero(kInt), hn::Zero(kInt)) : edges.covered(chunk);
      if (context.needs_scissor) mask = hn::And(mask, scissor_mask(context.rect, bx, by, chunk));
      block.covered[chunk] = hn::VecFromMask(kInt, mask);
    }
    fragments(bx, by, &block);
  }
};

/// Functor for for_each_block(): as FragmentBlocks, for several samples with edges and depth of each.
struct SampledBlocks {
  FragmentTriangle& fragments;
  Edges32 edges[kMaxSamples];
  FragmentDepth depth[kMaxSamples];

  template <bool>
  HWY_INLINE void operator()(int bx, int by, const BlockEdges&) {
    draw(bx, by);
  }
  HWY_NOINLINE void draw(int bx, int by) {
    const TileContext& context = fragments.context;
    BlockFragments blocks[kMaxSamples];
    for (int s = 0; s < context.samples; ++s) {
      const Edges32& t = edges[s];
      const BlockOffsets offsets(t);
      const BlockEdges at{{t.at(0, bx, by), t.at(1, bx, by), t.at(2, bx, by)}, &offsets};
      depth[s].block_keys(bx, by, blocks[s].keys);
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
        auto mask = at.covered(chunk);
        if (context.needs_scissor) mask = hn::And(mask, scissor_mask(context.rect, bx, by, chunk));
        blocks[s].covered[chunk] = hn::VecFromMask(kInt, mask);
      }
    }
    fragments(bx, by, blocks);
  }
};

void draw_fragments(TileContext& context, std::uint32_t draw_number) {
  const TriangleGroup& g = context.memory.group;
  const TileDraw& draw = context.frame.draws[draw_number];
  const std::uint32_t in_tile = set_up_group(context, draw.path.uses_depth(), true);
  for_each_visible_triangle(context, in_tile, [&](int i, const TileEdges& edges) TESSERA_LOOP_BODY {
    ShadedTriangle triangle;
    fill_shaded_triangle(triangle, context, draw_number, i, is_back(context, draw, i), edges);
    draw_fragments_of(context, i, triangle, [&](FragmentTriangle& fragments) HWY_ATTR {
      FragmentBlocks blocks{fragments, {}};
      blocks.depth.set_up(context.frame, draw, g, i, context.memory.source[i], context.tile_x,
                          context.tile_y);
      const BlockOffsets offsets(edges.edges);
      for_each_block(edges.edges, offsets, g.x0[i], g.y0[i], g.x1[i], g.y1[i], blocks);
    });
  });
}

HWY_INLINE void move_group(TriangleGroup& g, std::int32_t x, std::int32_t y) {
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < kGroupSize; ++i) {
      g.x[k][i] += x;
      g.y[k][i] += y;
    }
}

/// Fills the record of triangle i for pixels' centres, which may lie outside the triangle.
inline HWY_NOINLINE void fill_centered_triangle(ShadedTriangle& triangle, TileContext& context,
                                                std::uint32_t draw_number, int i, bool back) {
  const TriangleGroup& g = context.memory.group;
  fill_shaded_triangle(triangle, context, draw_number, i, back);
  if (g.needs_edges64[i] == 0) return;
  Edges32 edges;
  Edges64 wide;
  tile_edges64(g, i, context.tile_x, context.tile_y, context.tile_size, edges, wide);
  store_edges64(triangle, context.memory, wide);
}

/// Dominating edges and bounds: they contain those of all samples.
struct SampledBounds {
  Edges32 edges;
  int x0, y0, x1, y1;
  bool is_empty = true;

  HWY_INLINE void include(const Edges32& of_sample, const TriangleGroup& g, int i) {
    for (int k = 0; k < 3; ++k) {
      // An edge that is dropped for any sample is dropped: the whole tile is inside it there.
      const bool is_dropped = of_sample.a[k] == 0 && of_sample.b[k] == 0;
      if (is_empty || is_dropped) {
        edges.a[k] = of_sample.a[k];
        edges.b[k] = of_sample.b[k];
        edges.e[k] = of_sample.e[k];
      } else if (edges.a[k] != 0 || edges.b[k] != 0) {
        edges.e[k] = std::max(edges.e[k], of_sample.e[k]);
      }
    }
    x0 = is_empty ? g.x0[i] : std::min(x0, g.x0[i]);
    y0 = is_empty ? g.y0[i] : std::min(y0, g.y0[i]);
    x1 = is_empty ? g.x1[i] : std::max(x1, g.x1[i]);
    y1 = is_empty ? g.y1[i] : std::max(y1, g.y1[i]);
    is_empty = false;
  }
};

/// For a wide triangle that misses the tile at a sample: its edges there do not fit 32 bits.
inline constexpr Edges32 kEmptyEdges{{0, 0, 0}, {0, 0, 0}, {-1, -1, -1}};

void draw_fragments_msaa(TileContext& context, std::uint32_t draw_number) {
  TriangleGroup& center = context.memory.group;
  const TileDraw& draw = context.frame.draws[draw_number];
  set_up_edges(center, context.tile_x, context.tile_y, context.rect);
  set_up_weights(center);
  std::uint32_t visible = 0;
  for (int s = 0; s < context.samples; ++s) {
    TriangleGroup& g = context.memory.samples->group[s];
    g = center;
    move_group(g, -sample_positions(context.samples)[s].x, -sample_positions(context.samples)[s].y);
    set_up_edges(g, context.tile_x, context.tile_y, context.rect);
    if (draw.path.uses_depth()) set_up_depth(g, context.frame.depth_format, context.tile_x, context.tile_y);
    visible |= g.mask;
  }
  for_each_triangle(visible, [&](int i) TESSERA_LOOP_BODY {
    ShadedTriangle triangle;
    fill_centered_triangle(triangle, context, draw_number, i, is_back(context, draw, i));
    draw_fragments_of(context, i, triangle, [&](FragmentTriangle& fragments) HWY_ATTR {
      SampledBlocks blocks{fragments, {}, {}};
      SampledBounds bounds{};
      for (int s = 0; s < context.samples; ++s) {
        const TriangleGroup& g = context.memory.samples->group[s];
        blocks.edges[s] = tile_edges32(g, i);
        blocks.depth[s].set_up(context.frame, draw, g, i, context.memory.source[i], context.tile_x,
                               context.tile_y);
        Edges64 wide;
        const bool touches_tile =
            g.needs_edges64[i] == 0 ||
            tile_edges64(g, i, context.tile_x, context.tile_y, context.tile_size, blocks.edges[s], wide);
        if (touches_tile) bounds.include(blocks.edges[s], g, i);
        else blocks.edges[s] = kEmptyEdges;
      }
      if (bounds.is_empty) return;
      const BlockOffsets offsets(bounds.edges);
      for_each_block(bounds.edges, offsets, bounds.x0, bounds.y0, bounds.x1, bounds.y1, blocks);
    });
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();
