// Draws whose fragments go through more than the depth test: block by block, in the order of the triangles.
#if defined(TESSERA_SHADING_DRAW_FRAGMENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DRAW_FRAGMENTS_INL_H_
#undef TESSERA_SHADING_DRAW_FRAGMENTS_INL_H_
#else
#define TESSERA_SHADING_DRAW_FRAGMENTS_INL_H_
#endif

#include <bit>

#include "shading/deferred_shading_msaa-inl.h"
#include "shading/draw_group-inl.h"
#include "shading/fragment_depth-inl.h"
#include "shading/fragment_ops-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// The pixels of a block that a triangle covers in one sample, as lanes of -1 and 0, and their depth keys.
struct BlockFragments {
  Int covered[kChunksPerBlock], keys[kChunksPerBlock];
};

/// One triangle of a draw with operations, and what its fragments need to know of it. The same code for every
/// depth format.
struct FragmentTriangle {
  TileContext& context;
  const TileDraw& draw;
  const FragmentOps& ops;
  const ShadedTriangle& triangle;
  bool has_depth;
  StencilTestConstants stencil{};  // of this face, where there is a test
  std::int32_t id = 0;             // for draws that are shaded later
  bool is_packed = false;          // the color is packed already
  std::uint32_t packed_color = 0;
  const float* flat = nullptr;  // r g b a, or an index
  const float* colors_given =
      nullptr;           // of a block's pixels, in place of the triangle's: r of all of them, then g, b and a
  BatchSurface surface;  // for lighting
  bool visible = false;
  const DrawTexture* texture = nullptr;  // or none
  TextureCoordinates coordinates{};      // of a texture with levels

  HWY_INLINE int face() const { return triangle.back ? 1 : 0; }
  HWY_INLINE bool clamps_to_range() const { return attributes_clamp_to_range(context, draw); }

  HWY_INLINE Barycentric at(int bx, int by, int chunk) const {
    return barycentric(triangle, context.memory.edges64.data(), bx, by, chunk);
  }

  HWY_INLINE Float alpha(int bx, int by, int chunk) const {
    if (colors_given != nullptr) return hn::Load(kFloat, colors_given + 3 * kBlockPixels + chunk * kLanes);
    if (flat != nullptr) return splat(flat[3]);
    const int attribute = draw.alpha_attribute[face()];
    return attribute < 0 ? splat(draw.alpha[face()])
                         : clamped_unit(interpolate_clamped(
                               at(bx, by, chunk), make_interpolant(triangle, attribute, clamps_to_range())));
  }

  /// Alpha under the texture.
  HWY_INLINE Float textured_alpha(int bx, int by, int chunk) const {
    const Float own = alpha(bx, by, chunk);
    if (texture == nullptr || !texture->changes_alpha()) return own;
    return texture_env_lanes(*texture, {{own, own, own, own}},
                             texels_at(*texture, context.memory.batch, chunk * kLanes))
        .c[3];
  }
  HWY_INLINE bool tests_texels() const {
    return ops.alpha_test && texture != nullptr && texture->changes_alpha();
  }

  /// Attributes of the block's pixels into the batch.
  HWY_INLINE void gather_block(int bx, int by, std::uint32_t bits) {
    with_known_count(surface, [&](auto count) HWY_ATTR {
      const InterpolantArrays values(triangle, surface.first_attribute,
                                     count.value > 0 ? count.value : surface.attribute_count);
      gather_block_span<count.value>(context, surface, triangle, values, bx, by, bits, 0);
    });
  }
  /// Texels of the block's pixels into the batch.
  HWY_NOINLINE void sample_block(int bx, int by, std::uint32_t bits) {
    if (texture->levels == nullptr) return;
    ShadingBatch& batch = context.memory.batch;
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
      if (chunk_bits(bits, chunk) != 0)
        coordinates.at(at(bx, by, chunk), [&](int field, Float value) HWY_ATTR {
          hn::Store(value, kFloat, batch.field[field] + chunk * kLanes);
        });
    sample_texture_lanes(*texture->levels, batch, kBlockPixels);
  }

  /// Tests of one sample, and what they change. Returns the pixels that are visible, 16 bits.
  HWY_INLINE std::uint32_t test(const TileAttachments& sample, int bx, int by, const BlockFragments& block) {
    const int index = context.block_index(bx, by);
    std::uint32_t bits = 0;
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      LaneMask mask = hn::MaskFromVec(block.covered[chunk]);
      if (hn::AllFalse(kInt, mask)) continue;
      if (ops.alpha_test)
        mask = hn::And(mask, hn::RebindMask(kInt, compare_lanes(textured_alpha(bx, by, chunk), ops.alpha_func,
                                                                splat(ops.alpha_reference))));
      LaneMask failed = no_lanes(), passed = mask;
      Int stored = hn::Zero(kInt);
      if (ops.stencil) {
        stored = hn::Load(kInt, sample.stencil + index + chunk * kLanes);
        passed = hn::And(mask, stencil_passes(stencil, stored));
        failed = hn::AndNot(passed, mask);
      }
      LaneMask zpassed = passed;
      if (has_depth) {
        std::int32_t* const depth = sample.depth + index + chunk * kLanes;
        const Int before = hn::Load(kInt, depth);
        zpassed = hn::And(passed, compare_lanes(block.keys[chunk], draw.depth_test, before));
        if (draw.depth_write) hn::Store(hn::IfThenElse(zpassed, block.keys[chunk], before), kInt, depth);
      }
      if (stencil.writes())
        hn::Store(stencil_result(stencil, stored, failed, hn::AndNot(zpassed, passed), zpassed), kInt,
                  sample.stencil + index + chunk * kLanes);
      bits |= mask_bits(kInt, zpassed) << (chunk * kLanes);
    }
    return bits;
  }

  /// Colours 0..1 of a chunk, under the texture whose texels stand in the batch.
  HWY_INLINE Colors colors(int bx, int by, int chunk) const {
    const Colors own = own_colors(bx, by, chunk);
    return texture == nullptr
               ? own
               : texture_env_lanes(*texture, own, texels_at(*texture, context.memory.batch, chunk * kLanes));
  }
  /// Without the texture; of lit pixels they stand in the batch.
  HWY_INLINE Colors own_colors(int bx, int by, int chunk) const {
    const auto splats = [](const float* c) HWY_ATTR {
      return Colors{{splat(c[0]), splat(c[1]), splat(c[2]), splat(c[3])}};
    };
    if (draw.source == ColorSource::constant) return splats(draw.color[face()].data());
    if (flat != nullptr) return splats(flat);
    Colors out;
    if (colors_given != nullptr) {
      for (int c = 0; c < 3; ++c)
        out.c[c] = hn::Load(kFloat, colors_given + c * kBlockPixels + chunk * kLanes);
    } else if (draw.source == ColorSource::per_pixel) {
      for (int c = 0; c < 3; ++c)
        out.c[c] = hn::Load(kFloat, context.memory.batch.field[kColorR + c] + chunk * kLanes);
    } else {
      const Barycentric weights = at(bx, by, chunk);
      for (int c = 0; c < 3; ++c)
        out.c[c] = clamped_unit(interpolate_clamped(
            weights, make_interpolant(triangle, draw.color_attribute[face()] + c, clamps_to_range())));
    }
    out.c[3] = alpha(bx, by, chunk);
    return out;
  }

  /// Masked indices of a chunk.
  HWY_INLINE Float indices(int bx, int by, int chunk) const {
    if (draw.source == ColorSource::constant) return splat(draw.color[face()][0]);
    if (flat != nullptr) return splat(flat[0]);
    if (draw.source == ColorSource::per_pixel)
      return hn::Load(kFloat, context.memory.batch.field[kColorR] + chunk * kLanes);
    return interpolate_clamped(at(bx, by, chunk),
                               make_interpolant(triangle, draw.color_attribute[face()], clamps_to_range()));
  }

  HWY_INLINE Float thresholds(int bx, int by, int chunk) const {
    if (!ops.dither) return splat(0.5f);
    alignas(64) float t[kLanes];
    for (int l = 0; l < kLanes; ++l) {
      const int p = chunk * kLanes + l;
      t[l] = ops.threshold[(context.tile_y + by + p / 4) % kDitherSize]
                          [(context.tile_x + bx + p % 4) % kDitherSize];
    }
    return hn::Load(kFloat, t);
  }

  HWY_INLINE Int nearest_entries(const Colors& colors, Float threshold, std::uint32_t lanes) const {
    alignas(64) float c[3][kLanes], t[kLanes];
    alignas(64) std::int32_t packed[kLanes] = {};
    for (int k = 0; k < 3; ++k) hn::Store(colors.c[k], kFloat, c[k]);
    hn::Store(threshold, kFloat, t);
    for (int l = 0; l < kLanes; ++l) {
      if ((lanes >> l & 1) == 0) continue;
      const float moved = (t[l] - 0.5f) * ops.palette_spread;
      packed[l] = static_cast<std::int32_t>(
          context.frame.palette_search->nearest_unclamped(c[0][l] + moved, c[1][l] + moved, c[2][l] + moved));
    }
    return hn::Load(kInt, packed);
  }

  /// What a colour, or an index in place of its red, makes of the stored packed colors of one sample.
  HWY_INLINE Int packed(Colors source, Float threshold, std::uint32_t lanes, Int stored) const {
    const ColorLayout& layout = context.frame.layout;
    if (is_packed) return splat(static_cast<std::int32_t>(packed_color));
    if (draw.index[face()]) {
      const Int result = pack_indices(layout, source.c[0]);
      return ops.logic == LogicOp::copy ? result : logic_op_lanes(ops.logic, result, stored);
    }
    if (ops.blend) source = blend_lanes(ops, source, unpack_colors(layout, stored));
    const Int result =
        layout.index ? nearest_entries(source, threshold, lanes) : pack_colors(layout, source, threshold);
    return ops.logic == LogicOp::copy ? result : logic_op_lanes(ops.logic, result, stored);
  }

  /// A block of fragments in each sample.
  HWY_NOINLINE void operator()(int bx, int by, const BlockFragments* blocks) {
    std::uint32_t passed[kMaxSamples], bits = 0;
    if (tests_texels()) {
      for (int s = 0; s < context.samples; ++s)
        for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
          bits |= mask_bits(kInt, hn::MaskFromVec(blocks[s].covered[chunk])) << (chunk * kLanes);
      if (bits == 0) return;
      sample_block(bx, by, bits);
      bits = 0;
    }
    for (int s = 0; s < context.samples; ++s) bits |= passed[s] = test(context.sample[s], bx, by, blocks[s]);
    if (bits == 0 || draw.path.color_write == ColorWrite::none) return;
    visible = true;
    const int index = context.block_index(bx, by);
    if (draw.deferred) {
      for (int s = 0; s < context.samples; ++s)
        for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
          auto* const visibility =
              reinterpret_cast<std::int32_t*>(context.sample[s].visibility) + index + chunk * kLanes;
          hn::Store(hn::IfThenElse(mask_from_bits(passed[s] >> (chunk * kLanes)), splat(id),
                                   hn::Load(kInt, visibility)),
                    kInt, visibility);
        }
      return;
    }
    context.counts.shaded_pixels += static_cast<std::uint64_t>(std::popcount(bits));
    if (draw.source == ColorSource::per_pixel) {
      gather_block(bx, by, bits);
      light_points_lanes(*draw.programs[face()], context.memory.batch, kBlockPixels);
      if (draw.captures_normals) store_normals(context, index, bits, 0);
    }
    if (texture != nullptr && !is_packed && !tests_texels()) sample_block(bx, by, bits);
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      if (chunk_bits(bits, chunk) == 0) continue;
      const Colors source = is_packed            ? Colors{}
                            : draw.index[face()] ? Colors{{indices(bx, by, chunk)}}
                                                 : colors(bx, by, chunk);
      const Float threshold = thresholds(bx, by, chunk);
      for (int s = 0; s < context.samples; ++s) {
        const std::uint32_t lanes = chunk_bits(passed[s], chunk);
        if (lanes == 0) continue;
        std::uint32_t* const color = context.sample[s].color + index + chunk * kLanes;
        const Int stored = hn::Load(kInt, reinterpret_cast<const std::int32_t*>(color));
        store_packed(color, packed(source, threshold, lanes, stored), mask_from_bits(lanes),
                     splat(static_cast<std::int32_t>(draw.write_mask)));
      }
    }
  }
};

/// Coverage and depth of a triangle's blocks.
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

/// The same where pixels have several samples, each with edges and depth of its own.
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

/// Of draws that have no operations and come here all the same.
inline constexpr FragmentOps kNoOperations{};
/// Runs blocks(fragments) for one triangle of the group, whose pixels' centres stand in `triangle`.
template <class Blocks>
HWY_INLINE void draw_fragments_of(TileContext& context, std::uint32_t draw_number, int i,
                                  const ShadedTriangle& triangle, const Blocks& blocks) {
  TileWorkspace::Memory& memory = context.memory;
  const TileDraw& draw = context.frame.draws[draw_number];
  FragmentTriangle fragments{.context = context,
                             .draw = draw,
                             .ops = draw.ops != nullptr ? *draw.ops : kNoOperations,
                             .triangle = triangle,
                             .has_depth = draw.path.uses_depth(),
                             .surface = {}};
  if (fragments.ops.stencil)
    fragments.stencil =
        stencil_test_constants(fragments.ops.faces[fragments.face()], fragments.ops.stencil_max);
  fragments.id = static_cast<std::int32_t>(memory.visible_triangles.size());
  fragments.is_packed = draw.path.color_write == ColorWrite::constant;
  if (fragments.is_packed)
    fragments.packed_color = draw.id_output == TileDraw::IdOutput::primitive
                                 ? memory.source[i] / draw.primitive_triangles
                                 : packed_color_of(context, draw, i, triangle.back);
  if (draw.flat) fragments.flat = flat_color(draw, memory.source[i], triangle.back);
  if (draw.source == ColorSource::per_pixel) begin_surface(context, fragments.surface, triangle);
  fragments.surface.texture = nullptr;  // its texels come about block by block
  fragments.texture = texture_of(draw, triangle.back);
  if (fragments.texture != nullptr && fragments.texture->levels != nullptr &&
      (!draw.deferred || fragments.tests_texels()))
    fragments.coordinates.set_up(triangle, memory.edges64.data(), *fragments.texture,
                                 draw.topology == Topology::lines, context.samples);
  blocks(fragments);
  if (draw.deferred && fragments.visible) {
    memory.visible_triangles.push_back(triangle);
    if (context.frame.shade_immediately) shade_whole_tile(context);
  } else if (triangle.edges64_index >= 0) {
    memory.edges64.pop_back();
  }
}

inline void draw_fragments(TileContext& context, std::uint32_t draw_number) {
  const TriangleGroup& g = context.memory.group;
  const TileDraw& draw = context.frame.draws[draw_number];
  const std::uint32_t in_tile = set_up_group(context, draw.path.uses_depth(), true);
  for_each_visible_triangle(context, in_tile, [&](int i, const TileEdges& edges) TESSERA_LOOP_BODY {
    ShadedTriangle triangle;
    fill_shaded_triangle(triangle, context, draw_number, i, is_back(context, draw, i), edges);
    draw_fragments_of(context, draw_number, i, triangle, [&](FragmentTriangle& fragments) HWY_ATTR {
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

/// Triangle i of a group that stands where its vertices are: what its pixels' centres see, inside of it or
/// not.
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

/// Edges and bounds that hold those of all samples.
struct SampledBounds {
  Edges32 edges;
  int x0, y0, x1, y1;
  bool first = true;
  HWY_INLINE void include(const Edges32& of_sample, const TriangleGroup& g, int i) {
    for (int k = 0; k < 3; ++k) {
      // An edge that a wide triangle's sample has dropped is dropped.
      const bool dropped = of_sample.a[k] == 0 && of_sample.b[k] == 0;
      if (first || dropped)
        edges.a[k] = of_sample.a[k], edges.b[k] = of_sample.b[k], edges.e[k] = of_sample.e[k];
      else if (edges.a[k] != 0 || edges.b[k] != 0) edges.e[k] = std::max(edges.e[k], of_sample.e[k]);
    }
    x0 = first ? g.x0[i] : std::min(x0, g.x0[i]);
    y0 = first ? g.y0[i] : std::min(y0, g.y0[i]);
    x1 = first ? g.x1[i] : std::max(x1, g.x1[i]);
    y1 = first ? g.y1[i] : std::max(y1, g.y1[i]);
    first = false;
  }
};

inline void draw_fragments_msaa(TileContext& context, std::uint32_t draw_number) {
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
    draw_fragments_of(context, draw_number, i, triangle, [&](FragmentTriangle& fragments) HWY_ATTR {
      SampledBlocks blocks{fragments, {}, {}};
      SampledBounds bounds{};
      for (int s = 0; s < context.samples; ++s) {
        const TriangleGroup& g = context.memory.samples->group[s];
        blocks.edges[s] = tile_edges32(g, i);
        Edges64 wide;
        blocks.depth[s].set_up(context.frame, draw, g, i, context.memory.source[i], context.tile_x,
                               context.tile_y);
        if (g.needs_edges64[i] == 0 ||
            tile_edges64(g, i, context.tile_x, context.tile_y, context.tile_size, blocks.edges[s], wide))
          bounds.include(blocks.edges[s], g, i);
        else
          blocks.edges[s] = {
              {0, 0, 0}, {0, 0, 0}, {-1, -1, -1}};  // outside of the tile; its edges do not fit 32 bits
      }
      if (bounds.first) return;
      const BlockOffsets offsets(bounds.edges);
      for_each_block(bounds.edges, offsets, bounds.x0, bounds.y0, bounds.x1, bounds.y1, blocks);
    });
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
