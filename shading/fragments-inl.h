// Draws whose fragments go through more than the depth test: block by block, in the order of the triangles.
#if defined(TESSERA_SHADING_FRAGMENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_FRAGMENTS_INL_H_
#undef TESSERA_SHADING_FRAGMENTS_INL_H_
#else
#define TESSERA_SHADING_FRAGMENTS_INL_H_
#endif

#include <bit>
#include <type_traits>

#include "raster/coverage-inl.h"
#include "raster/depth_offset-inl.h"
#include "raster/triangle_setup-inl.h"
#include "shading/deferred-inl.h"
#include "shading/draw_group-inl.h"
#include "shading/fragment_ops-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// The pixels of a block that a triangle covers, as lanes of -1 and 0, and their depth keys.
struct BlockFragments {
  Int covered[kChunksPerBlock], keys[kChunksPerBlock];
};

/// One triangle of a draw with operations, and what its fragments need to know of it. The same code for every depth format.
struct FragmentTriangle {
  TileRun& run;
  const TileDraw& draw;
  const FragmentOps& ops;
  const ShadedTriangle& triangle;
  bool has_depth;
  std::int32_t id = 0;            // for draws that are shaded later
  std::uint32_t number = 0;       // of the triangle in its mesh
  const float* flat = nullptr;    // r g b a
  PixelBatch pixels;              // of this surface, for lighting
  bool seen = false;

  HWY_INLINE int face() const { return triangle.back ? 1 : 0; }

  HWY_INLINE Barycentric at(int bx, int by, int chunk) const { return barycentric(triangle, run.memory.wide.data(), bx, by, chunk); }

  HWY_INLINE Float alpha(int bx, int by, int chunk) const {
    if (flat != nullptr) return splat(flat[3]);
    const int attribute = draw.alpha_attribute[face()];
    return attribute < 0 ? splat(draw.alpha[face()]) : clamped_unit(interpolate(at(bx, by, chunk), corners(triangle, attribute)));
  }

  /// Tests, and what they change. Returns the pixels that are seen, 16 bits.
  HWY_INLINE std::uint32_t test(int bx, int by, const BlockFragments& block) {
    const int index = run.block_index(bx, by);
    const StencilSide& stencil = ops.faces[face()];
    std::uint32_t bits = 0;
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      LaneMask mask = hn::MaskFromVec(block.covered[chunk]);
      if (hn::AllFalse(kInt, mask)) continue;
      if (ops.alpha_test) mask = hn::And(mask, hn::RebindMask(kInt, comparing(alpha(bx, by, chunk), ops.alpha_func, splat(ops.alpha_reference))));
      LaneMask failed = no_lanes(), passed = mask;
      Int stored = hn::Zero(kInt);
      if (ops.stencil) {
        stored = hn::Load(kInt, run.memory.stencil->value + index + chunk * kLanes);
        passed = hn::And(mask, stencil_passes(stencil, stored));
        failed = hn::AndNot(passed, mask);
      }
      LaneMask zpassed = passed;
      if (has_depth) {
        std::int32_t* const depth = run.memory.depth + index + chunk * kLanes;
        const Int before = hn::Load(kInt, depth);
        zpassed = hn::And(passed, comparing(block.keys[chunk], draw.depth_test, before));
        if (draw.depth_write) hn::Store(hn::IfThenElse(zpassed, block.keys[chunk], before), kInt, depth);
      }
      if (ops.stencil)
        hn::Store(stencil_result(stencil, ops.stencil_most, stored, failed, hn::AndNot(zpassed, passed), zpassed), kInt, run.memory.stencil->value + index + chunk * kLanes);
      bits |= mask_bits(kInt, zpassed) << (chunk * kLanes);
    }
    return bits;
  }

  /// Colours 0..1 of a chunk; of lit pixels they stand in the batch.
  HWY_INLINE Colors colors(int bx, int by, int chunk) const {
    const auto splats = [](const float* c) HWY_ATTR { return Colors{{splat(c[0]), splat(c[1]), splat(c[2]), splat(c[3])}}; };
    if (draw.source == ColorSource::constant) return splats(draw.color[face()].data());
    if (flat != nullptr) return splats(flat);
    Colors out;
    if (draw.source == ColorSource::per_pixel) {
      for (int c = 0; c < 3; ++c) out.c[c] = hn::Load(kFloat, run.memory.batch.field[kColorR + c] + chunk * kLanes);
    } else {
      const Barycentric weights = at(bx, by, chunk);
      for (int c = 0; c < 3; ++c) out.c[c] = clamped_unit(interpolate(weights, corners(triangle, draw.color_attribute[face()] + c)));
    }
    out.c[3] = alpha(bx, by, chunk);
    return out;
  }

  HWY_INLINE Float thresholds(int bx, int by, int chunk) const {
    if (!ops.dither) return splat(0.5f);
    alignas(64) float t[kLanes];
    for (int l = 0; l < kLanes; ++l) {
      const int p = chunk * kLanes + l;
      t[l] = ops.threshold[(run.tile_y + by + p / 4) % kDitherSize][(run.tile_x + bx + p % 4) % kDitherSize];
    }
    return hn::Load(kFloat, t);
  }

  HWY_INLINE Int nearest_entries(const Colors& colors, Float threshold, std::uint32_t lanes) const {
    alignas(64) float c[3][kLanes], t[kLanes];
    alignas(64) std::int32_t words[kLanes] = {};
    for (int k = 0; k < 3; ++k) hn::Store(colors.c[k], kFloat, c[k]);
    hn::Store(threshold, kFloat, t);
    for (int l = 0; l < kLanes; ++l) {
      if ((lanes >> l & 1) == 0) continue;
      const float moved = (t[l] - 0.5f) * ops.palette_spread;
      words[l] = static_cast<std::int32_t>(color_word(run.frame.layout, run.frame.palette_search, c[0][l] + moved, c[1][l] + moved, c[2][l] + moved));
    }
    return hn::Load(kInt, words);
  }

  HWY_INLINE Int words(int bx, int by, int chunk, std::uint32_t lanes, Int stored) const {
    const ColorLayout& layout = run.frame.layout;
    if (draw.number != TileDraw::Number::none) return splat(static_cast<std::int32_t>(draw.number == TileDraw::Number::draw ? draw.word : number));
    Colors source = colors(bx, by, chunk);
    if (ops.blend) source = blended_colors(ops, source, stored_colors(layout, stored));
    const Float threshold = thresholds(bx, by, chunk);
    const Int result = layout.index ? nearest_entries(source, threshold, lanes) : words_of(layout, source, threshold);
    return ops.logic == Logic::copy ? result : logic_words(ops.logic, result, stored);
  }

  HWY_NOINLINE void operator()(int bx, int by, const BlockFragments& block) {
    const std::uint32_t bits = test(bx, by, block);
    if (bits == 0 || draw.source == ColorSource::none) return;
    seen = true;
    const int index = run.block_index(bx, by);
    if (draw.deferred) {
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
        auto* const ids = reinterpret_cast<std::int32_t*>(run.memory.ids) + index + chunk * kLanes;
        hn::Store(hn::IfThenElse(mask_from_bits(bits >> (chunk * kLanes)), splat(id), hn::Load(kInt, ids)), kInt, ids);
      }
      return;
    }
    run.counts.shaded_pixels += static_cast<std::uint64_t>(std::popcount(bits));
    if (draw.source == ColorSource::per_pixel) {
      gather_attributes(run, pixels, triangle, bx, by, bits, 0);
      light_points_lanes(*draw.programs[face()], run.memory.batch, kBlockPixels);
      if (draw.captures_normals) {
        pixels.index[0] = index;
        pixels.covered[0] = bits;
        pixels.blocks = 1;
        store_normals(run, pixels);
        pixels.blocks = 0;
      }
    }
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const std::uint32_t lanes = bits >> (chunk * kLanes) & ((1u << kLanes) - 1);
      if (lanes == 0) continue;
      std::uint32_t* const color = run.memory.color + index + chunk * kLanes;
      const Int stored = hn::Load(kInt, reinterpret_cast<const std::int32_t*>(color));
      store_words(color, words(bx, by, chunk, lanes, stored), mask_from_bits(lanes), splat(static_cast<std::int32_t>(draw.write_mask)));
    }
  }
};

/// Coverage and depth of a triangle's blocks.
template <class Depth>
struct FragmentBlocks {
  FragmentTriangle& fragments;
  Depth depth;

  template <bool kFull>
  HWY_INLINE void operator()(int bx, int by, const BlockEdges& edges) {
    const TileRun& run = fragments.run;
    BlockFragments block;
    const auto block_depth = depth.block(bx, by);
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      auto mask = kFull ? hn::Eq(hn::Zero(kInt), hn::Zero(kInt)) : edges.covered(chunk);
      if (run.cut) mask = hn::And(mask, inside_rect(run.rect, bx, by, chunk));
      block.covered[chunk] = hn::VecFromMask(kInt, mask);
      if constexpr (kHasDepth<Depth>) block.keys[chunk] = depth.keys(block_depth, chunk);
    }
    fragments(bx, by, block);
  }
};

/// The colour of a flat triangle: its own, or that of its provoking vertex.
HWY_INLINE const float* flat_color(const TileDraw& draw, std::uint32_t source, bool back) {
  const int face = back ? 1 : 0;
  if (draw.face_colors[face] != nullptr) return draw.face_colors[face] + std::size_t{source} * 4;
  const std::size_t corner = std::size_t{source} * 3 + static_cast<std::size_t>(draw.provoking);
  const std::size_t vertex = draw.indices ? draw.indices[corner] : corner;
  return draw.attributes + vertex * static_cast<std::size_t>(draw.attribute_stride) + draw.color_attribute[face];
}

template <class Depth>
void draw_fragments(TileRun& run, std::uint32_t draw_number) {
  TileWorkspace::Memory& memory = run.memory;
  TriangleGroup& g = memory.group;
  const TileDraw& draw = run.frame.draws[draw_number];
  set_up_edges(g, run.tile_x, run.tile_y, run.rect);
  if (g.mask == 0) return;
  constexpr bool kOffset = std::is_same_v<Depth, OffsetUnormDepth> || std::is_same_v<Depth, OffsetFloat32Depth>;
  if constexpr (kHasDepth<Depth>) set_up_depth(g, run.frame.depth_kind, run.tile_x, run.tile_y, kOffset);
  set_up_weights(g);
  for (std::uint32_t left = g.mask; left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    const bool back = !is_front(g.signed_area[i], draw.front_is_clockwise);
    TileEdges edges = tile_edges(g, i);
    WideEdges wide_edges;
    if (g.wide[i] != 0 && !tile_edges_of_wide(g, i, run.tile_x, run.tile_y, run.tile_size, edges, wide_edges)) continue;
    ShadedTriangle triangle;
    fill_shaded_triangle(triangle, run, draw_number, i, back);
    if (g.wide[i] != 0) keep_wide_edges(triangle, memory, wide_edges);

    FragmentTriangle fragments{.run = run, .draw = draw, .ops = *draw.ops, .triangle = triangle, .has_depth = kHasDepth<Depth>, .pixels = {}};
    fragments.id = static_cast<std::int32_t>(memory.triangles.size());
    fragments.number = memory.source[i];
    if (draw.flat) fragments.flat = flat_color(draw, memory.source[i], back);
    if (draw.source == ColorSource::per_pixel) begin_surface(run, fragments.pixels, draw_number, back);
    FragmentBlocks<Depth> blocks{fragments, {}};
    blocks.depth.set_up(g, i, run.tile_x, run.tile_y, run.frame.depth_kind);
    if constexpr (kOffset) blocks.depth.offset_by(g, i, draw.offset_factor, draw.offset_units);
    blocks.depth.prepare_blocks();
    const BlockOffsets offsets(edges);
    for_each_block(edges, offsets, g.x0[i], g.y0[i], g.x1[i], g.y1[i], blocks);

    if (draw.deferred && fragments.seen) {
      memory.triangles.push_back(triangle);
      if (run.frame.shade_at_once) shade_whole_tile(run);
    } else if (triangle.wide >= 0) {
      memory.wide.pop_back();
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
