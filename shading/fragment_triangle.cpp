// Operations on a block of fragments [GL 2.1, 4.1]: alpha test, stencil test, depth test; then its colours
// are evaluated, blended, dithered, combined by a logic operation and stored under the write mask.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/fragment_triangle.cpp"
#include "framebuffer/lanes.h"

#include <bit>

#include "shading/batch_colors-inl.h"
#include "shading/coarse_cells-inl.h"
#include "shading/fragment_triangle-inl.h"
#include "shading/stage_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

HWY_NOINLINE void FragmentTriangle::operator()(int bx, int by, const BlockFragments* blocks) {
  if (HWY_UNLIKELY(runs_stage_first)) return draw_staged(bx, by, blocks);
  if (tests_texels()) {
    std::uint32_t covered = 0;
    for (int s = 0; s < context.samples; ++s)
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
        covered |= mask_bits(kInt, hn::MaskFromVec(blocks[s].covered[chunk])) << (chunk * kLanes);
    if (covered == 0) return;
    sample_block(bx, by, covered);
  }
  std::uint32_t passed[kMaxSamples];
  const std::uint32_t passed_any = run_tests(bx, by, blocks, passed);
  const ColorWrite color_write = draw.path.color_write;
  if (passed_any == 0 || color_write == ColorWrite::none) return;
  visible = true;
  if (color_write == ColorWrite::deferred) return store_ids(context.block_index(bx, by), passed, blocks);
  if (evaluates_colors) evaluate_block<false>(bx, by, passed_any);
  if (HWY_UNLIKELY(draw.stage != nullptr))
    context.counts.non_finite_fragments +=
        static_cast<std::uint64_t>(std::popcount(run_stage_on_block(bx, by, blocks[0].keys, passed_any)));
  store_colors(bx, by, passed, passed_any);
}

/// The fragments of a draw whose stage runs before the tests.
HWY_NOINLINE void FragmentTriangle::draw_staged(int bx, int by, const BlockFragments* blocks) {
  BlockFragments kept[kMaxSamples];
  if (!run_stage_before_tests(bx, by, blocks, kept)) return;
  std::uint32_t passed[kMaxSamples];
  const std::uint32_t passed_any = run_tests(bx, by, kept, passed);
  if (passed_any == 0 || draw.path.color_write == ColorWrite::none) return;
  visible = true;
  if (draw.captures_normals) capture_block_normals(bx, by, passed_any);
  store_colors(bx, by, passed, passed_any);
}

/// Runs the tests of all samples.
/// @param passed  receives the pixels that passed, per sample
/// @return  pixels that passed at any sample
HWY_INLINE std::uint32_t FragmentTriangle::run_tests(int bx, int by, const BlockFragments* blocks,
                                                     std::uint32_t* passed) {
  std::uint32_t passed_any = 0;
  for (int s = 0; s < context.samples; ++s) {
    passed[s] = test(context.sample[s], bx, by, blocks[s]);
    passed_any |= passed[s];
  }
  return passed_any;
}

/// Stores the evaluated colours of the pixels that passed.
HWY_INLINE void FragmentTriangle::store_colors(int bx, int by, const std::uint32_t* passed,
                                               std::uint32_t passed_any) {
  context.counts.shaded_pixels += static_cast<std::uint64_t>(std::popcount(passed_any));
  const int index = context.block_index(bx, by);
  const bool is_constant = draw.path.color_write == ColorWrite::constant;
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
    if (chunk_bits(passed_any, chunk) == 0) continue;
    const Colors source = is_constant ? Colors{} : colors(bx, by, chunk);
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

/// Runs the tests of one sample, and stores its new depths and stencil values. Returns the pixels that
/// passed, 16 bits.
HWY_INLINE std::uint32_t FragmentTriangle::test(const TileAttachments& sample, int bx, int by,
                                                const BlockFragments& block) {
  const int index = context.block_index(bx, by);
  std::uint32_t bits = 0;
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
    LaneMask mask = hn::MaskFromVec(block.covered[chunk]);
    if (hn::AllFalse(kInt, mask)) continue;
    if (ops.alpha_test) {
      const Float alpha = alpha_of_chunk(bx, by, chunk);
      const auto alpha_passed = compare_lanes(alpha, ops.alpha_func, splat(ops.alpha_reference));
      mask = hn::And(mask, hn::RebindMask(kInt, alpha_passed));
    }
    LaneMask failed = no_lanes();
    LaneMask passed = mask;
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

/// Samples the texture at the block's pixels into the batch.
/// @param bits  pixels that need a texel
HWY_NOINLINE void FragmentTriangle::sample_block(int bx, int by, std::uint32_t bits) {
  if (texture->levels == nullptr) return;
  ShadingBatch& batch = context.memory.batch;
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
    if (chunk_bits(bits, chunk) != 0)
      coordinates.at(at(bx, by, chunk), [&](int field, Float value) HWY_ATTR {
        hn::Store(value, kFloat, batch.field[field] + chunk * kLanes);
      });
  sample_texture_lanes(*texture->levels, batch, kBlockPixels);
}

/// ColorWrite::deferred: stores the triangle's number in the visibility buffer.
/// With a stage that reads depth, the depth keys are stored, too.
/// @param index   of the block's first pixel in the tile
/// @param passed  visible pixels of each sample
HWY_INLINE void FragmentTriangle::store_ids(int index, const std::uint32_t* passed,
                                            const BlockFragments* blocks) {
  const bool keeps_depth = draw.stage != nullptr && draw.stage->stage.reads.depth;
  for (int chunk = 0; keeps_depth && chunk < kChunksPerBlock; ++chunk) {
    std::int32_t* const keys = context.memory.stage_depth->key + index + chunk * kLanes;
    const LaneMask mask = mask_from_bits(passed[0] >> (chunk * kLanes));
    hn::Store(hn::IfThenElse(mask, blocks[0].keys[chunk], hn::Load(kInt, keys)), kInt, keys);
  }
  for (int s = 0; s < context.samples; ++s)
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      auto* const ids =
          reinterpret_cast<std::int32_t*>(context.sample[s].visibility) + index + chunk * kLanes;
      const LaneMask mask = mask_from_bits(passed[s] >> (chunk * kLanes));
      hn::Store(hn::IfThenElse(mask, splat(id), hn::Load(kInt, ids)), kInt, ids);
    }
}

/// Evaluates red, green and blue of the block's pixels, the set bits, into the batch.
/// @param kBeforeTests  for a stage that runs before the tests: a separate copy, so that the other is inlined
template <bool kBeforeTests>
HWY_INLINE void FragmentTriangle::evaluate_block(int bx, int by, std::uint32_t bits) {
  ShadingBatch& batch = context.memory.batch;
  if (has_given_colors && flat_color != nullptr) {
    fill_colors(flat_color, batch, kBlockPixels);
  } else if (has_given_colors) {
    for (int c = 0; c < 3; ++c)
      std::copy_n(block_colors + c * kBlockPixels, kBlockPixels, batch.field[kColorR + c]);
  } else if (surface.cell_size > 0) {
    CellBatch& cells = context.memory.cells;
    alignas(64) std::int32_t cell_of_pixel[kBlockPixels] = {};
    add_cells(context, surface, triangle, bx, by, bits, cells, cell_of_pixel);
    light_cells(surface, cells);
    spread_cells(cells, cell_of_pixel, batch, kBlockPixels);
    cells.count = 0;
  } else if (surface.attribute_count > 0) {
    with_known_count(surface, [&](auto count) HWY_ATTR {
      const InterpolantArrays values(triangle, surface.first_attribute,
                                     count.value > 0 ? count.value : surface.attribute_count);
      gather_block_span<count.value>(context, surface, triangle, values, bx, by, bits, 0);
    });
  }
  const bool is_sampled = tests_texels();  // before the alpha test
  const bool writes_given_color = draw.path.color_write == ColorWrite::constant && !kBeforeTests;
  const bool uses_texels = texture != nullptr && !writes_given_color;
  if (uses_texels && !is_sampled) sample_block(bx, by, bits);
  if (HWY_UNLIKELY(draw.stage != nullptr)) store_alpha(bx, by);
  evaluate_colors(context, surface, kBlockPixels);
  if (draw.captures_normals && !kBeforeTests) store_normals(context, context.block_index(bx, by), bits, 0);
}

/// Stores the alpha of the block's pixels, before texture, for the fragment stage.
HWY_NOINLINE void FragmentTriangle::store_alpha(int bx, int by) const {
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
    hn::Store(surface.is_constant ? splat(surface.alpha) : untextured_alpha(bx, by, chunk), kFloat,
              context.memory.stage.field[kStageAlpha] + chunk * kLanes);
}

/// Runs the fragment stage on the block, whose colours are evaluated.
/// @param keys  depth keys of sample 0
/// @param bits  fragments, not 0
/// @return  those of them with a colour that is not finite
HWY_NOINLINE std::uint32_t FragmentTriangle::run_stage_on_block(int bx, int by, const Int* keys,
                                                                std::uint32_t bits) {
  const TileFragmentStage& stage = *draw.stage;
  if (stage.stage.reads.position) store_positions(context, bx, by, 0);
  if (stage.stage.reads.depth) {
    alignas(64) std::int32_t stored[kBlockPixels];
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
      hn::Store(keys[chunk], kInt, stored + chunk * kLanes);
    store_depths(context, stored, 0);
  } else if (stage.stage.writes_depth) {
    std::fill_n(context.memory.stage.depth, kBlockPixels, 0.0);
  }
  const bool is_gathered = surface.attribute_count > 0;  // with the attributes
  for (int chunk = 0; !is_gathered && chunk < kChunksPerBlock; ++chunk) {
    if (chunk_bits(bits, chunk) == 0) continue;
    interpolate_stage_inputs(context, surface, triangle, at(bx, by, chunk),
                             [&](int field, Float value) HWY_ATTR {
                               if (field != kStageAlpha)
                                 hn::Store(value, kFloat, context.memory.stage.field[field] + chunk * kLanes);
                             });
  }
  if (bits != kWholeBlock) repeat_covered_point(context, stage, 0, bits);
  run_stage(context, surface, kBlockPixels);
  return clamp_block_colors(context, 0) & bits;
}

/// Runs the fragment stage on the fragments that the depth test does not reject anyway.
/// @param blocks  one per sample
/// @param kept    receives the fragments that the stage keeps, with their depths
/// @return  false if none is left
HWY_NOINLINE bool FragmentTriangle::run_stage_before_tests(int bx, int by, const BlockFragments* blocks,
                                                           BlockFragments* kept) {
  const FragmentStage& stage = draw.stage->stage;
  const int index = context.block_index(bx, by);
  const bool rejects_early = has_depth && !stage.writes_depth && !stencil.writes();
  std::uint32_t bits = 0;
  for (int s = 0; s < context.samples; ++s)
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      LaneMask mask = hn::MaskFromVec(blocks[s].covered[chunk]);
      if (rejects_early)
        mask = hn::And(mask, compare_lanes(blocks[s].keys[chunk], draw.depth_test,
                                           hn::Load(kInt, context.sample[s].depth + index + chunk * kLanes)));
      kept[s].covered[chunk] = hn::VecFromMask(kInt, mask);
      kept[s].keys[chunk] = blocks[s].keys[chunk];
      bits |= mask_bits(kInt, mask) << (chunk * kLanes);
    }
  if (bits == 0) return false;
  evaluate_block<true>(bx, by, bits);
  std::uint32_t non_finite = run_stage_on_block(bx, by, blocks[0].keys, bits);
  alignas(64) std::int32_t keys[kBlockPixels] = {};
  if (stage.writes_depth) {
    const std::uint32_t dropped = bits & ~written_keys(context, keys);
    non_finite |= dropped;
    bits &= ~dropped;
  }
  for (int i = 0; stage.discards && i < kBlockPixels; ++i)
    if (context.memory.stage.keep[i] == 0) bits &= ~(1u << i);
  context.counts.non_finite_fragments += static_cast<std::uint64_t>(std::popcount(non_finite));
  for (int s = 0; s < context.samples; ++s)
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      kept[s].covered[chunk] =
          hn::And(kept[s].covered[chunk], hn::VecFromMask(kInt, mask_from_bits(chunk_bits(bits, chunk))));
      if (stage.writes_depth && has_depth) kept[s].keys[chunk] = hn::Load(kInt, keys + chunk * kLanes);
    }
  return bits != 0;
}

/// Captures: stores the normals of a draw whose stage has run before the tests.
HWY_NOINLINE void FragmentTriangle::capture_block_normals(int bx, int by, std::uint32_t bits) {
  BatchSurface normals;
  begin_surface(context, normals, triangle, draw);
  normals.stage = nullptr;
  normals.gathers_coordinates = false;
  const InterpolantArrays values(triangle, normals.first_attribute, normals.attribute_count);
  gather_block_span<0>(context, normals, triangle, values, bx, by, bits, 0);
  light_points_lanes(*normals.program, context.memory.batch, kBlockPixels);
  store_normals(context, context.block_index(bx, by), bits, 0);
}

HWY_INLINE Barycentric FragmentTriangle::at(int bx, int by, int chunk) const {
  return barycentric(triangle, context.memory.edges64.data(), bx, by, chunk);
}

/// Alpha of a chunk before its texture is applied.
HWY_INLINE Float FragmentTriangle::untextured_alpha(int bx, int by, int chunk) const {
  if (block_colors != nullptr) return hn::Load(kFloat, block_colors + 3 * kBlockPixels + chunk * kLanes);
  if (flat_color != nullptr) return splat(flat_color[3]);
  const int attribute = colors_of.alpha_attribute[face];
  if (attribute < 0) return splat(colors_of.alpha[face]);
  const Interpolant alpha =
      make_interpolant(triangle, attribute, attributes_clamp_to_range(context, colors_of));
  return clamped_unit(interpolate_clamped(at(bx, by, chunk), alpha));
}

/// Alpha of a chunk after its texture is applied. @pre the batch has the texels
HWY_INLINE Float FragmentTriangle::textured_alpha(Float untextured, int chunk) const {
  if (texture == nullptr || !texture->changes_alpha()) return untextured;
  const Colors texels = texels_at(*texture, context.memory.batch, chunk * kLanes);
  return texture_env_alpha(*texture, untextured, texels.c[3]);
}

/// Alpha of a chunk for the alpha test. @pre the batch has the texels, or the stage has run
HWY_INLINE Float FragmentTriangle::alpha_of_chunk(int bx, int by, int chunk) const {
  if (runs_stage_first) return hn::Load(kFloat, context.memory.stage.field[kStageAlpha] + chunk * kLanes);
  return textured_alpha(untextured_alpha(bx, by, chunk), chunk);
}

/// Evaluated colours 0..1 of a chunk; or an index in place of red.
HWY_INLINE Colors FragmentTriangle::colors(int bx, int by, int chunk) const {
  Colors out{};
  for (int c = 0; c < 3; ++c)
    out.c[c] = hn::Load(kFloat, context.memory.batch.field[kColorR + c] + chunk * kLanes);
  if (draw.index[face]) return out;
  if (draw.stage != nullptr) {
    out.c[3] = hn::Load(kFloat, context.memory.stage.field[kStageAlpha] + chunk * kLanes);
    return out;
  }
  const Float alpha = surface.is_constant ? splat(draw.color[face][3]) : untextured_alpha(bx, by, chunk);
  out.c[3] = textured_alpha(alpha, chunk);
  return out;
}

/// Rounding thresholds of a chunk: 0.5, or the dither pattern.
HWY_INLINE Float FragmentTriangle::thresholds(int bx, int by, int chunk) const {
  if (ops.dither == nullptr) return splat(0.5f);
  return dither_thresholds(ops.dither->pattern(), context.tile_x + bx, context.tile_y + by, chunk);
}

/// Packed colours to store in one sample.
/// @param source  colours, or an index in place of red
/// @param lanes   lanes that are stored
/// @param stored  packed colours that the sample has
HWY_INLINE Int FragmentTriangle::packed(Colors source, Float threshold, std::uint32_t lanes,
                                        Int stored) const {
  const ColorLayout& layout = context.frame.layout;
  if (draw.path.color_write == ColorWrite::constant) return splat(static_cast<std::int32_t>(packed_color));
  if (draw.index[face]) {
    const Int result = pack_indices(layout, source.c[0]);
    return ops.logic == LogicOp::copy ? result : logic_op_lanes(ops.logic, result, stored);
  }
  if (ops.blend) source = blend_lanes(ops, source, unpack_colors(layout, stored));
  const Int result =
      layout.index ? nearest_entries(*context.frame.palette_search, ops.dither, source, threshold, lanes)
                   : pack_colors(layout, source, threshold, ops.dither);
  return ops.logic == LogicOp::copy ? result : logic_op_lanes(ops.logic, result, stored);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();
