// Draws of textured triangles where each pixel that is seen is shaded at once: coordinates, texels and colours stay in registers. The same
// bits as where they wait (deferred-inl.h).
#if defined(TESSERA_SHADING_TEXTURED_GROUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_TEXTURED_GROUP_INL_H_
#undef TESSERA_SHADING_TEXTURED_GROUP_INL_H_
#else
#define TESSERA_SHADING_TEXTURED_GROUP_INL_H_
#endif

#include <bit>

#include "shading/fragments-inl.h"
#include "shading/texture_coordinates-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// Those without operations, into RGB buffers, of colours that are there already.
HWY_INLINE bool textures_at_once(const TileFrame& frame, const TileDraw& draw) {
  return frame.shade_at_once && frame.samples == 1 && draw.ops == nullptr && draw.texture != nullptr && draw.texture->levels != nullptr && !frame.layout.index && !frame.layout.luminance &&
         frame.layout.alpha_bits == 0 && (draw.source == ColorSource::constant || draw.source == ColorSource::interpolated) && !draw.index[0] && !draw.index[1];
}

/// One triangle's way through the blocks of a tile.
struct TexturedBlocks {
  TileRun& run;
  const TileDraw& draw;
  const ShadedTriangle& triangle;
  bool uses_depth, texels_alone, full;
  FragmentDepth depth;
  TextureCoordinates coordinates;
  Corners color[3];
  Int seen = hn::Zero(kInt);  // minus the number of pixels that passed, in each lane

  HWY_INLINE void set_up(int i) {
    uses_depth = has_depth(run.frame, draw);
    const ColorLayout& layout = run.frame.layout;
    texels_alone = draw.texture->function == TextureFunction::replace && layout.r_bits == 8 && layout.g_bits == 8 && layout.b_bits == 8;
    depth.set_up(run.frame, draw, run.memory.group, i, run.memory.source[i], run.tile_x, run.tile_y);
    coordinates.set_up(triangle, run.memory.wide.data(), *draw.texture, false);
    for (int c = 0; c < 3; ++c) {
      const std::size_t face = triangle.back ? 1 : 0;
      color[c] = draw.source == ColorSource::constant ? Corners{draw.color[face][static_cast<std::size_t>(c)], 0, 0} : corners(triangle, draw.color_attribute[face] + c);
    }
  }

  template <bool kFull>
  HWY_INLINE void operator()(int bx, int by, const BlockEdges& edges) {
    full = kFull;  // no argument: the compiler would make a copy of draw_block for each
    draw_block(bx, by, edges);
  }
  HWY_NOINLINE void draw_block(int bx, int by, const BlockEdges& edges) {
    const int block = run.block_index(bx, by);
    Int keys[kChunksPerBlock];
    depth.block_keys(bx, by, keys);
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const int index = block + chunk * kLanes;
      auto mask = full ? hn::Eq(hn::Zero(kInt), hn::Zero(kInt)) : edges.covered(chunk);
      if (run.cut) mask = hn::And(mask, inside_rect(run.rect, bx, by, chunk));
      if (uses_depth) {
        std::int32_t* const at = run.memory.depth + index;
        const Int stored = hn::Load(kInt, at);
        mask = hn::And(mask, comparing(keys[chunk], draw.depth_test, stored));
        if (draw.depth_write) hn::Store(hn::IfThenElse(mask, keys[chunk], stored), kInt, at);
      }
      if (hn::AllFalse(kInt, mask)) continue;
      seen = hn::Add(seen, hn::VecFromMask(kInt, mask));
      store_words(run.memory.color + index, words(bx, by, chunk, edges), mask, splat(static_cast<std::int32_t>(draw.write_mask)));
    }
  }

 private:
  HWY_INLINE Int words(int bx, int by, int chunk, const BlockEdges& edges) const {
    const Barycentric at = triangle.wide >= 0 ? barycentric_wide(triangle, run.memory.wide[static_cast<std::size_t>(triangle.wide)], bx, by, chunk)
                                              : barycentric_from_edges(triangle, edges.at(0, chunk), edges.at(1, chunk), edges.at(2, chunk));
    Float s = hn::Zero(kFloat), t = hn::Zero(kFloat), footprint = hn::Zero(kFloat);
    coordinates.at(at, [&](int field, Float value) HWY_ATTR { (field == kTextureS ? s : field == kTextureT ? t : footprint) = value; });
    const Texels texels = texels_where(*draw.texture->levels, s, t, footprint);
    if (texels_alone) return words_of_texels(texels);
    const Colors own{{interpolate(at, color[0]), interpolate(at, color[1]), interpolate(at, color[2]), splat(1.0f)}};
    return words_of(run.frame.layout, textured_lanes(*draw.texture, own, colors_of(texels)), splat(0.5f));
  }
};

inline void draw_textured(TileRun& run, std::uint32_t draw_number) {
  TriangleGroup& g = run.memory.group;
  const TileDraw& draw = run.frame.draws[draw_number];
  set_up_edges(g, run.tile_x, run.tile_y, run.rect);
  if (g.mask == 0) return;
  if (has_depth(run.frame, draw)) set_up_depth(g, run.frame.depth_kind, run.tile_x, run.tile_y);
  set_up_weights(g);
  for (std::uint32_t left = g.mask; left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    TileEdges edges = tile_edges(g, i);
    WideEdges wide_edges;
    if (g.wide[i] != 0 && !tile_edges_of_wide(g, i, run.tile_x, run.tile_y, run.tile_size, edges, wide_edges)) continue;
    ShadedTriangle triangle;
    fill_shaded_triangle(triangle, run, draw_number, i, is_back(run, draw, i));
    if (g.wide[i] != 0) keep_wide_edges(triangle, run.memory, wide_edges);
    TexturedBlocks blocks{.run = run, .draw = draw, .triangle = triangle};
    blocks.set_up(i);
    const BlockOffsets offsets(edges);
    for_each_block(edges, offsets, g.x0[i], g.y0[i], g.x1[i], g.y1[i], blocks);
    run.counts.shaded_pixels += count_of(blocks.seen);
    run.memory.wide.clear();
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
