// Draws whose fragments go through more than the depth test: block by block, in the order of the triangles.
#if defined(TESSERA_SHADING_FRAGMENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_FRAGMENTS_INL_H_
#undef TESSERA_SHADING_FRAGMENTS_INL_H_
#else
#define TESSERA_SHADING_FRAGMENTS_INL_H_
#endif

#include <bit>

#include "raster/coverage-inl.h"
#include "raster/triangle_setup-inl.h"
#include "shading/deferred_samples-inl.h"
#include "shading/draw_group-inl.h"
#include "shading/fragment_depth-inl.h"
#include "shading/fragment_ops-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// The pixels of a block that a triangle covers in one sample, as lanes of -1 and 0, and their depth keys.
struct BlockFragments {
  Int covered[kChunksPerBlock], keys[kChunksPerBlock];
};

/// One triangle of a draw with operations, and what its fragments need to know of it. The same code for every
/// depth format.
struct FragmentTriangle {
  TileRun& run;
  const TileDraw& draw;
  const FragmentOps& ops;
  const ShadedTriangle& triangle;
  bool has_depth;
  StencilSteps stencil{};  // of this face, where there is a test
  std::int32_t id = 0;     // for draws that are shaded later
  bool has_word = false;   // there is no colour to be made: it is a word already
  std::uint32_t word = 0;
  const float* flat = nullptr;  // r g b a, or an index
  const float* colors_given =
      nullptr;           // of a block's pixels, in place of the triangle's: r of all of them, then g, b and a
  BatchSurface surface;  // for lighting
  bool seen = false;
  const DrawTexture* texture = nullptr;  // or none
  TextureCoordinates coordinates{};      // of a texture with levels

  HWY_INLINE int face() const { return triangle.back ? 1 : 0; }
  HWY_INLINE bool keeps_range() const { return attributes_keep_range(run, draw); }

  HWY_INLINE Barycentric at(int bx, int by, int chunk) const {
    return barycentric(triangle, run.memory.wide.data(), bx, by, chunk);
  }

  HWY_INLINE Float alpha(int bx, int by, int chunk) const {
    if (colors_given != nullptr) return hn::Load(kFloat, colors_given + 3 * kBlockPixels + chunk * kLanes);
    if (flat != nullptr) return splat(flat[3]);
    const int attribute = draw.alpha_attribute[face()];
    return attribute < 0 ? splat(draw.alpha[face()])
                         : clamped_unit(interpolate_within(at(bx, by, chunk),
                                                           corners(triangle, attribute, keeps_range())));
  }

  /// Alpha under the texture.
  HWY_INLINE Float textured_alpha(int bx, int by, int chunk) const {
    const Float own = alpha(bx, by, chunk);
    if (texture == nullptr || !texture->changes_alpha()) return own;
    return textured_lanes(*texture, {{own, own, own, own}},
                          texels_at(*texture, run.memory.batch, chunk * kLanes))
        .c[3];
  }
  HWY_INLINE bool tests_texels() const {
    return ops.alpha_test && texture != nullptr && texture->changes_alpha();
  }

  /// Attributes of the block's pixels into the batch.
  HWY_INLINE void gather_block(int bx, int by, std::uint32_t bits) {
    with_known_count(surface, [&](auto count) HWY_ATTR {
      const CornerArrays values(triangle, surface.first_attribute,
                                count.value > 0 ? count.value : surface.attribute_count);
      gather_piece<count.value>(run, surface, triangle, values, bx, by, bits, 0);
    });
  }
  /// Texels of the block's pixels into the batch.
  HWY_NOINLINE void sample_block(int bx, int by, std::uint32_t bits) {
    if (texture->levels == nullptr) return;
    ShadingBatch& batch = run.memory.batch;
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
      if (chunk_bits(bits, chunk) != 0)
        coordinates.at(at(bx, by, chunk), [&](int field, Float value) HWY_ATTR {
          hn::Store(value, kFloat, batch.field[field] + chunk * kLanes);
        });
    sample_texture_lanes(*texture->levels, batch, kBlockPixels);
  }

  /// Tests of one sample, and what they change. Returns the pixels that are seen, 16 bits.
  HWY_INLINE std::uint32_t test(const TilePixels& sample, int bx, int by, const BlockFragments& block) {
    const int index = run.block_index(bx, by);
    std::uint32_t bits = 0;
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      LaneMask mask = hn::MaskFromVec(block.covered[chunk]);
      if (hn::AllFalse(kInt, mask)) continue;
      if (ops.alpha_test)
        mask = hn::And(mask, hn::RebindMask(kInt, comparing(textured_alpha(bx, by, chunk), ops.alpha_func,
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
        zpassed = hn::And(passed, comparing(block.keys[chunk], draw.depth_test, before));
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
               : textured_lanes(*texture, own, texels_at(*texture, run.memory.batch, chunk * kLanes));
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
        out.c[c] = hn::Load(kFloat, run.memory.batch.field[kColorR + c] + chunk * kLanes);
    } else {
      const Barycentric weights = at(bx, by, chunk);
      for (int c = 0; c < 3; ++c)
        out.c[c] = clamped_unit(
            interpolate_within(weights, corners(triangle, draw.color_attribute[face()] + c, keeps_range())));
    }
    out.c[3] = alpha(bx, by, chunk);
    return out;
  }

  /// Masked indices of a chunk.
  HWY_INLINE Float indices(int bx, int by, int chunk) const {
    if (draw.source == ColorSource::constant) return splat(draw.color[face()][0]);
    if (flat != nullptr) return splat(flat[0]);
    if (draw.source == ColorSource::per_pixel)
      return hn::Load(kFloat, run.memory.batch.field[kColorR] + chunk * kLanes);
    return interpolate_within(at(bx, by, chunk),
                              corners(triangle, draw.color_attribute[face()], keeps_range()));
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
      words[l] = static_cast<std::int32_t>(
          run.frame.palette_search->nearest_unclamped(c[0][l] + moved, c[1][l] + moved, c[2][l] + moved));
    }
    return hn::Load(kInt, words);
  }

  /// What a colour, or an index in place of its red, makes of the stored words of one sample.
  HWY_INLINE Int words(Colors source, Float threshold, std::uint32_t lanes, Int stored) const {
    const ColorLayout& layout = run.frame.layout;
    if (has_word) return splat(static_cast<std::int32_t>(word));
    if (draw.index[face()]) {
      const Int result = index_words(layout, source.c[0]);
      return ops.logic == Logic::copy ? result : logic_words(ops.logic, result, stored);
    }
    if (ops.blend) source = blended_colors(ops, source, stored_colors(layout, stored));
    const Int result =
        layout.index ? nearest_entries(source, threshold, lanes) : words_of(layout, source, threshold);
    return ops.logic == Logic::copy ? result : logic_words(ops.logic, result, stored);
  }

  /// A block of fragments in each sample.
  HWY_NOINLINE void operator()(int bx, int by, const BlockFragments* blocks) {
    std::uint32_t passed[kMaxSamples], bits = 0;
    if (tests_texels()) {
      for (int s = 0; s < run.samples; ++s)
        for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
          bits |= mask_bits(kInt, hn::MaskFromVec(blocks[s].covered[chunk])) << (chunk * kLanes);
      if (bits == 0) return;
      sample_block(bx, by, bits);
      bits = 0;
    }
    for (int s = 0; s < run.samples; ++s) bits |= passed[s] = test(run.sample[s], bx, by, blocks[s]);
    if (bits == 0 || draw.write_mask == 0 || draw.source == ColorSource::none) return;
    seen = true;
    const int index = run.block_index(bx, by);
    if (draw.deferred) {
      for (int s = 0; s < run.samples; ++s)
        for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
          auto* const ids = reinterpret_cast<std::int32_t*>(run.sample[s].ids) + index + chunk * kLanes;
          hn::Store(
              hn::IfThenElse(mask_from_bits(passed[s] >> (chunk * kLanes)), splat(id), hn::Load(kInt, ids)),
              kInt, ids);
        }
      return;
    }
    run.counts.shaded_pixels += static_cast<std::uint64_t>(std::popcount(bits));
    if (draw.source == ColorSource::per_pixel) {
      gather_block(bx, by, bits);
      light_points_lanes(*draw.programs[face()], run.memory.batch, kBlockPixels);
      if (draw.captures_normals) store_normals(run, index, bits, 0);
    }
    if (texture != nullptr && !has_word && !tests_texels()) sample_block(bx, by, bits);
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      if (chunk_bits(bits, chunk) == 0) continue;
      const Colors source = has_word             ? Colors{}
                            : draw.index[face()] ? Colors{{indices(bx, by, chunk)}}
                                                 : colors(bx, by, chunk);
      const Float threshold = thresholds(bx, by, chunk);
      for (int s = 0; s < run.samples; ++s) {
        const std::uint32_t lanes = chunk_bits(passed[s], chunk);
        if (lanes == 0) continue;
        std::uint32_t* const color = run.sample[s].color + index + chunk * kLanes;
        const Int stored = hn::Load(kInt, reinterpret_cast<const std::int32_t*>(color));
        store_words(color, words(source, threshold, lanes, stored), mask_from_bits(lanes),
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
    const TileRun& run = fragments.run;
    BlockFragments block;
    depth.block_keys(bx, by, block.keys);
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      auto mask = kFull ? hn::Eq(hn::Zero(kInt), hn::Zero(kInt)) : edges.covered(chunk);
      if (run.cut) mask = hn::And(mask, inside_rect(run.rect, bx, by, chunk));
      block.covered[chunk] = hn::VecFromMask(kInt, mask);
    }
    fragments(bx, by, &block);
  }
};

/// The same where pixels have several samples, each with edges and depth of its own.
struct SampledBlocks {
  FragmentTriangle& fragments;
  TileEdges edges[kMaxSamples];
  FragmentDepth depth[kMaxSamples];

  template <bool>
  HWY_INLINE void operator()(int bx, int by, const BlockEdges&) {
    draw(bx, by);
  }
  HWY_NOINLINE void draw(int bx, int by) {
    const TileRun& run = fragments.run;
    BlockFragments blocks[kMaxSamples];
    for (int s = 0; s < run.samples; ++s) {
      const TileEdges& t = edges[s];
      const BlockOffsets offsets(t);
      const BlockEdges at{{t.at(0, bx, by), t.at(1, bx, by), t.at(2, bx, by)}, &offsets};
      depth[s].block_keys(bx, by, blocks[s].keys);
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
        auto mask = at.covered(chunk);
        if (run.cut) mask = hn::And(mask, inside_rect(run.rect, bx, by, chunk));
        blocks[s].covered[chunk] = hn::VecFromMask(kInt, mask);
      }
    }
    fragments(bx, by, blocks);
  }
};

/// Of draws that have no operations and come here all the same.
inline constexpr FragmentOps kNoOperations{};
HWY_INLINE bool has_words(const TileDraw& draw) {
  if (draw.texture != nullptr) return false;
  return draw.source == ColorSource::constant || draw.source == ColorSource::vertex_word ||
         draw.source == ColorSource::triangle_word;
}

/// Runs blocks(fragments) for one triangle of the group, whose pixels' centres stand in `triangle`.
template <class Blocks>
HWY_INLINE void draw_fragments_of(TileRun& run, std::uint32_t draw_number, int i,
                                  const ShadedTriangle& triangle, const Blocks& blocks) {
  TileWorkspace::Memory& memory = run.memory;
  const TileDraw& draw = run.frame.draws[draw_number];
  FragmentTriangle fragments{.run = run,
                             .draw = draw,
                             .ops = draw.ops != nullptr ? *draw.ops : kNoOperations,
                             .triangle = triangle,
                             .has_depth = has_depth(run.frame, draw),
                             .surface = {}};
  if (fragments.ops.stencil)
    fragments.stencil = stencil_steps(fragments.ops.faces[fragments.face()], fragments.ops.stencil_most);
  fragments.id = static_cast<std::int32_t>(memory.triangles.size());
  fragments.has_word = draw.number != TileDraw::Number::none || (draw.ops == nullptr && has_words(draw));
  if (fragments.has_word)
    fragments.word = draw.number == TileDraw::Number::primitive ? memory.source[i] / draw.primitive_triangles
                                                                : triangle_word(run, draw, i, triangle.back);
  if (draw.flat) fragments.flat = flat_color(draw, memory.source[i], triangle.back);
  if (draw.source == ColorSource::per_pixel) begin_surface(run, fragments.surface, triangle);
  fragments.surface.texture = nullptr;  // its texels come about block by block
  fragments.texture = texture_of(draw, triangle.back);
  if (fragments.texture != nullptr && fragments.texture->levels != nullptr &&
      (!draw.deferred || fragments.tests_texels()))
    fragments.coordinates.set_up(triangle, memory.wide.data(), *fragments.texture,
                                 draw.topology == Topology::lines, run.samples);
  blocks(fragments);
  if (draw.deferred && fragments.seen) {
    memory.triangles.push_back(triangle);
    if (run.frame.shade_at_once) shade_whole_tile(run);
  } else if (triangle.wide >= 0) {
    memory.wide.pop_back();
  }
}

inline void draw_fragments(TileRun& run, std::uint32_t draw_number) {
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
    if (g.wide[i] != 0 && !tile_edges_of_wide(g, i, run.tile_x, run.tile_y, run.tile_size, edges, wide_edges))
      continue;
    ShadedTriangle triangle;
    fill_shaded_triangle(triangle, run, draw_number, i, is_back(run, draw, i));
    if (g.wide[i] != 0) keep_wide_edges(triangle, run.memory, wide_edges);
    draw_fragments_of(run, draw_number, i, triangle, [&](FragmentTriangle& fragments) HWY_ATTR {
      FragmentBlocks blocks{fragments, {}};
      blocks.depth.set_up(run.frame, draw, g, i, run.memory.source[i], run.tile_x, run.tile_y);
      const BlockOffsets offsets(edges);
      for_each_block(edges, offsets, g.x0[i], g.y0[i], g.x1[i], g.y1[i], blocks);
    });
  }
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
inline HWY_NOINLINE void fill_centered_triangle(ShadedTriangle& triangle, TileRun& run,
                                                std::uint32_t draw_number, int i, bool back) {
  const TriangleGroup& g = run.memory.group;
  fill_shaded_triangle(triangle, run, draw_number, i, back);
  if (g.wide[i] == 0) return;
  TileEdges edges;
  WideEdges wide;
  tile_edges_of_wide(g, i, run.tile_x, run.tile_y, run.tile_size, edges, wide);
  keep_wide_edges(triangle, run.memory, wide);
}

/// Edges and bounds that hold those of all samples.
struct SampledBounds {
  TileEdges edges;
  int x0, y0, x1, y1;
  bool first = true;
  HWY_INLINE void include(const TileEdges& of_sample, const TriangleGroup& g, int i) {
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

inline void draw_fragments_samples(TileRun& run, std::uint32_t draw_number) {
  TriangleGroup& center = run.memory.group;
  const TileDraw& draw = run.frame.draws[draw_number];
  set_up_edges(center, run.tile_x, run.tile_y, run.rect);
  set_up_weights(center);
  std::uint32_t visible = 0;
  for (int s = 0; s < run.samples; ++s) {
    TriangleGroup& g = run.memory.samples->group[s];
    g = center;
    move_group(g, -sample_positions(run.samples)[s].x, -sample_positions(run.samples)[s].y);
    set_up_edges(g, run.tile_x, run.tile_y, run.rect);
    if (has_depth(run.frame, draw)) set_up_depth(g, run.frame.depth_kind, run.tile_x, run.tile_y);
    visible |= g.mask;
  }
  for (std::uint32_t left = visible; left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    ShadedTriangle triangle;
    fill_centered_triangle(triangle, run, draw_number, i, is_back(run, draw, i));
    draw_fragments_of(run, draw_number, i, triangle, [&](FragmentTriangle& fragments) HWY_ATTR {
      SampledBlocks blocks{fragments, {}, {}};
      SampledBounds bounds{};
      for (int s = 0; s < run.samples; ++s) {
        const TriangleGroup& g = run.memory.samples->group[s];
        blocks.edges[s] = tile_edges(g, i);
        WideEdges wide;
        blocks.depth[s].set_up(run.frame, draw, g, i, run.memory.source[i], run.tile_x, run.tile_y);
        if (g.wide[i] == 0 ||
            tile_edges_of_wide(g, i, run.tile_x, run.tile_y, run.tile_size, blocks.edges[s], wide))
          bounds.include(blocks.edges[s], g, i);
        else
          blocks.edges[s] = {
              {0, 0, 0}, {0, 0, 0}, {-1, -1, -1}};  // outside of the tile; its edges do not fit 32 bits
      }
      if (bounds.first) return;
      const BlockOffsets offsets(bounds.edges);
      for_each_block(bounds.edges, offsets, bounds.x0, bounds.y0, bounds.x1, bounds.y1, blocks);
    });
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
