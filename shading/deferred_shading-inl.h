// Shading once for each visible pixel: tiles collect which triangle is seen where; then the colours of whole
// batches of pixels come about with full lanes. Attributes come about piece by piece, which is what one block
// shows of one triangle, with masks: no attribute is gathered by pixel.
#if defined(TESSERA_SHADING_DEFERRED_SHADING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DEFERRED_SHADING_INL_H_
#undef TESSERA_SHADING_DEFERRED_SHADING_INL_H_
#else
#define TESSERA_SHADING_DEFERRED_SHADING_INL_H_
#endif

#include <bit>

#include "framebuffer/check.h"
#include "shading/batch_surface-inl.h"
#include "shading/texture_env-inl.h"
#include "shading/texture_sampling-inl.h"
#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

void light_points_lanes(const LightingProgram& program, ShadingBatch& batch,
                        int count);  // lighting.cpp, same instruction set

inline constexpr int kBatchBlocks = kBatchPoints / kBlockPixels;
static_assert(kBatchBlocks * kBlockPixels == kBatchPoints);

/// Pixels of blocks that share a surface. Points of the batch that no triangle covers hold what was there
/// before, any bits: nothing that is stored depends on them.
struct PixelBatch : BatchSurface {
  int blocks = 0;
  int index[kBatchBlocks];  // of each block's first pixel in tile memory
  int bx[kBatchBlocks], by[kBatchBlocks];
  std::uint32_t covered[kBatchBlocks];  // 16 bits
  bool one_surface = false;             // all triangles that were collected are of one
#if HWY_TARGET == HWY_AVX3
  // A block span: the visible pixels of one triangle in one block.
  alignas(64) std::int32_t visibility[kBatchPoints];  // of the triangles seen at the blocks' pixels
  int span_count = 0;  // block by block; each has a pixel at least, so that there is room for a whole block's
  std::int32_t triangle[kBatchPoints], slot[kBatchPoints];
#endif
};

/// Words of one chunk of pixels from interpolated colours that are scaled to levels already.
HWY_INLINE Int pack_scaled(const ColorLayout& layout, const ShadingBatch& batch, int first) {
  const Int red = truncate(hn::Load(kFloat, batch.field[kColorR] + first));
  const Int green = truncate(hn::Load(kFloat, batch.field[kColorG] + first));
  const Int blue = truncate(hn::Load(kFloat, batch.field[kColorB] + first));
  return hn::Or(hn::Or(hn::ShiftLeftSame(red, layout.r_shift()), hn::ShiftLeftSame(green, layout.g_shift())),
                blue);
}

/// Words of one chunk of pixels from colours in 0..1: each component floor(c (2^b - 1) + 0.5), or a grey, or
/// the nearest entry.
HWY_INLINE Int quantize_chunk(const TileFrame& frame, const ShadingBatch& batch, int first,
                              std::uint32_t covered) {
  const ColorLayout& layout = frame.layout;
  const float *r = batch.field[kColorR] + first, *g = batch.field[kColorG] + first,
              *b = batch.field[kColorB] + first;
  if (layout.index || layout.luminance) {
    alignas(64) std::int32_t packed[kLanes] = {};
    for (int l = 0; l < kLanes; ++l)
      if ((covered >> l & 1) != 0)
        packed[l] = static_cast<std::int32_t>(layout.index ? frame.palette_search->nearest(r[l], g[l], b[l])
                                                           : quantize_rgb(layout, r[l], g[l], b[l]));
    return hn::Load(kInt, packed);
  }
  const auto level = [](const float* c, int bits) HWY_ATTR {
    return truncate(mul_add(hn::Load(kFloat, c), splat(static_cast<float>((1 << bits) - 1)), splat(0.5f)));
  };
  return hn::Or(hn::Or(hn::ShiftLeftSame(level(r, layout.r_bits), layout.r_shift()),
                       hn::ShiftLeftSame(level(g, layout.g_bits), layout.g_shift())),
                level(b, layout.b_bits));
}

/// Words of masked indices, step by step quantize_index(). Beyond the ends of a line, and where a sample
/// alone is covered, an index may have left its range: it comes back at the other end.
HWY_INLINE Int pack_indices(const ColorLayout& layout, Float interpolated) {
  const float modulus = layout.index_modulus();
  const Float turns = hn::Floor(hn::Mul(interpolated, splat(1 / modulus)));
  const Float within =
      neg_mul_add(turns, splat(modulus), interpolated);  // exact, but for what is rounded up to the modulus
  const Float index = hn::IfThenElseZero(hn::Eq(within, within), within);  // a NaN is 0
  const Int whole = truncate(hn::Max(index, hn::Zero(kFloat)));
  const auto up = hn::RebindMask(kInt, hn::Ge(hn::Sub(index, hn::ConvertTo(kFloat, whole)), splat(0.5f)));
  return hn::And(hn::Sub(whole, hn::VecFromMask(kInt, up)),
                 splat(static_cast<std::int32_t>(layout.value_mask())));
}

/// Lit points have normals of length 1 in the batch.
/// @param index  of the block's first pixel in tile memory
/// @param first  its point in the batch
inline HWY_NOINLINE void store_normals(TileContext& context, int index, std::uint32_t covered, int first) {
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
    const auto mask = hn::RebindMask(kFloat, mask_from_bits(chunk_bits(covered, chunk)));
    for (int c = 0; c < 3; ++c)
      store_where(mask, hn::Load(kFloat, context.memory.batch.field[kNormalX + c] + first + chunk * kLanes),
                  kFloat, context.memory.normals->component[c] + index + chunk * kLanes);
  }
}

/// The colours of a draw that has one, for a texture to work on.
HWY_INLINE void fill_colors(const TileDraw& draw, bool back, ShadingBatch& batch) {
  for (int c = 0; c < 3; ++c)
    for (int point = 0; point < kBatchPoints; point += kLanes)
      hn::Store(splat(draw.color[back ? 1 : 0][static_cast<std::size_t>(c)]), kFloat,
                batch.field[kColorR + c] + point);
}

/// The colours of the first `count` points, and of the rest of their vector. What was extrapolated is cut.
HWY_INLINE void clamp_colors(ShadingBatch& batch, int count) {
  for (int point = 0; point < count; point += kLanes)
    for (int c = 0; c < 3; ++c) {
      float* const color = batch.field[kColorR + c] + point;
      hn::Store(clamped_unit(hn::Load(kFloat, color)), kFloat, color);
    }
}

/// The colours of the first `count` points, whole vectors of lanes, under the texture. What follows them in
/// the batch may be anything.
inline HWY_NOINLINE void apply_texture(const DrawTexture& texture, ShadingBatch& batch, int count) {
  if (texture.levels != nullptr) sample_texture_lanes(*texture.levels, batch, count);
  for (int point = 0; point < count; point += kLanes) {
    Colors colors{{hn::Zero(kFloat), hn::Zero(kFloat), hn::Zero(kFloat), splat(1.0f)}};
    for (int c = 0; c < 3; ++c) colors.c[c] = hn::Load(kFloat, batch.field[kColorR + c] + point);
    colors = texture_env_lanes(texture, colors, texels_at(texture, batch, point));
    for (int c = 0; c < 3; ++c) hn::Store(colors.c[c], kFloat, batch.field[kColorR + c] + point);
  }
}

/// The pixels of a block whose triangles' numbers compare so.
template <class Predicate>
HWY_INLINE std::uint32_t pixels_where(const std::int32_t* visibility, Predicate predicate) {
  std::uint32_t bits = 0;
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
    bits |= mask_bits(kInt, predicate(hn::Load(kInt, visibility + chunk * kLanes))) << (chunk * kLanes);
  return bits;
}
HWY_INLINE std::uint32_t pixels_of(const std::int32_t* visibility, std::int32_t id) {
  const Int wanted = splat(id);
  return pixels_where(visibility, [wanted](Int at) HWY_ATTR { return hn::Eq(at, wanted); });
}

/// Gathers the pixels of one triangle in the block of a slot.
template <int kCount>
HWY_INLINE void gather_visible(const TileContext& context, PixelBatch& pixels, int slot,
                               const ShadedTriangle& triangle, const TriangleInterpolants& interpolants,
                               std::uint32_t covered) {
  static_assert(kCount <= TriangleInterpolants::kCapacity);
  const int bx = pixels.bx[slot], by = pixels.by[slot], first = slot * kBlockPixels;
  if constexpr (kCount > 0)
    gather_block_span<kCount>(context, pixels, triangle, interpolants, bx, by, covered, first);
  else
    gather_block_span<0>(context, pixels, triangle,
                         InterpolantArrays(triangle, pixels.first_attribute, pixels.attribute_count), bx, by,
                         covered, first);
}

// Two ways of taking the pixels of the batch's surface into its next slot, both of which return which pixels
// they are.
//
//   visibility      of the block's pixels
//   pending  pixels whose triangles have not been taken
#if HWY_TARGET == HWY_AVX3
// The first pixels of a block's triangles are found side by side, and all that the batch shows of one
// triangle in one block is gathered afterwards, one after the other: what cannot be foretold, how many
// triangles a block has, does not hold up the long sums.

template <int kCount>
HWY_NOINLINE void gather_block_spans(const TileContext& context, PixelBatch& pixels) {
  for (int i = 0; i < pixels.span_count; ++i) {
    const int slot = pixels.slot[i];
    const std::int32_t id = pixels.triangle[i];
    gather_visible<kCount>(
        context, pixels, slot, context.memory.visible_triangles[static_cast<std::size_t>(id)],
        context.memory.interpolants[id], pixels_of(pixels.visibility + slot * kBlockPixels, id));
  }
}
HWY_INLINE void gather_pending(const TileContext& context, PixelBatch& pixels) {
  with_known_count(pixels, [&](auto count) HWY_ATTR { gather_block_spans<count.value>(context, pixels); });
  pixels.span_count = 0;
}

HWY_INLINE std::uint32_t take_surface_pixels(const TileContext& context, PixelBatch& pixels,
                                             const std::int32_t* visibility, std::uint32_t pending) {
  TESSERA_ASSERT(pixels.span_count <= pixels.blocks * kBlockPixels);
  const Int at = hn::Load(kInt, visibility);
  std::uint32_t covered = pending;
  if (!pixels.one_surface)
    covered &=
        mask_bits(kInt, hn::Eq(hn::GatherIndex(kInt, context.memory.surfaces, hn::Max(at, hn::Zero(kInt))),
                               splat(pixels.surface_number())));
  const std::uint32_t first = covered & ~mask_bits(kInt, duplicate_lanes(at));
  hn::StoreU(hn::Compress(at, mask_from_bits(first)), kInt, pixels.triangle + pixels.span_count);
  hn::StoreU(splat(pixels.blocks), kInt, pixels.slot + pixels.span_count);
  hn::Store(at, kInt, pixels.visibility + pixels.blocks * kBlockPixels);
  pixels.span_count += std::popcount(first);
  return covered;
}
#else
HWY_INLINE void gather_pending(const TileContext&, PixelBatch&) {}

HWY_INLINE std::uint32_t take_surface_pixels(const TileContext& context, PixelBatch& pixels,
                                             const std::int32_t* visibility, std::uint32_t pending) {
  std::uint32_t taken = 0;
  for (std::uint32_t left = pending; left != 0;) {
    const std::int32_t id = visibility[std::countr_zero(left)];
    const std::uint32_t covered = pixels_of(visibility, id);
    left &= ~covered;
    if (context.memory.surfaces[id] != pixels.surface_number()) continue;
    const ShadedTriangle& triangle = context.memory.visible_triangles[static_cast<std::size_t>(id)];
    with_known_count(pixels, [&](auto count) HWY_ATTR {
      gather_visible<count.value>(context, pixels, pixels.blocks, triangle, context.memory.interpolants[id],
                                  covered);
    });
    taken |= covered;
  }
  return taken;
}
#endif

/// Shades the batch, and empties it.
inline HWY_NOINLINE void shade_batch(TileContext& context, PixelBatch& pixels) {
  if (pixels.blocks == 0) return;
  gather_pending(context, pixels);
  const TileDraw& draw = context.frame.draws[pixels.draw];
  ShadingBatch& batch = context.memory.batch;
  const bool per_pixel = draw.source == ColorSource::per_pixel;
  if (per_pixel) light_points_lanes(*draw.programs[pixels.back ? 1 : 0], batch, pixels.blocks * kBlockPixels);
  if (draw.captures_normals)
    for (int slot = 0; slot < pixels.blocks; ++slot)
      store_normals(context, pixels.index[slot], pixels.covered[slot], slot * kBlockPixels);
  // Pixels of a line may lie beyond its ends.
  if (draw.topology == Topology::lines && draw.source == ColorSource::interpolated &&
      !draw.index[pixels.back ? 1 : 0])
    clamp_colors(batch, pixels.blocks * kBlockPixels);
  if (pixels.texture != nullptr) {
    if (draw.source == ColorSource::constant) fill_colors(draw, pixels.back, batch);
    apply_texture(*pixels.texture, batch, pixels.blocks * kBlockPixels);
  }
  for (int slot = 0; slot < pixels.blocks; ++slot) {
    context.counts.shaded_pixels += static_cast<std::uint64_t>(std::popcount(pixels.covered[slot]));
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const std::uint32_t covered_lanes = chunk_bits(pixels.covered[slot], chunk);
      if (covered_lanes == 0) continue;
      const int first = slot * kBlockPixels + chunk * kLanes;
      const Int packed =
          draw.index[pixels.back ? 1 : 0]
              ? pack_indices(context.frame.layout, hn::Load(kFloat, batch.field[kColorR] + first))
          : !per_pixel && draw.scaled_colors ? pack_scaled(context.frame.layout, batch, first)
                                             : quantize_chunk(context.frame, batch, first, covered_lanes);
      store_packed(context.color + pixels.index[slot] + chunk * kLanes, packed, mask_from_bits(covered_lanes),
                   splat(static_cast<std::int32_t>(draw.write_mask)));
    }
  }
  pixels.blocks = 0;
}

/// Makes what finding and gathering need of each triangle that was collected. Returns whether all are of one
/// surface.
HWY_INLINE bool prepare_triangles(const TileContext& context) {
  TileWorkspace::Memory& memory = context.memory;
  TESSERA_ASSERT(memory.visible_triangles.size() <= kVisibleTriangleCapacity);
  BatchSurface surface;
  bool stores_interpolants = false;
  int changes = 0;
  for (std::size_t i = 0; i < memory.visible_triangles.size(); ++i) {
    const ShadedTriangle& triangle = memory.visible_triangles[i];
    if (!surface.is_of(triangle)) {
      begin_surface(context, surface, triangle);
      stores_interpolants = known_count(surface) > 0;
      ++changes;
    }
    memory.surfaces[i] = surface.surface_number();
    if (stores_interpolants) store_interpolants(triangle, surface.first_attribute, memory.interpolants[i]);
  }
  return changes == 1;
}

/// Shades what was collected in the blocks of [x0, x1] x [y0, y1], pixels of the tile, and forgets it.
inline HWY_NOINLINE void shade_visible(TileContext& context, int x0, int y0, int x1, int y1) {
  TileWorkspace::Memory& memory = context.memory;
  PixelBatch pixels;
  pixels.one_surface = prepare_triangles(context);
  for (int by = y0 & ~3; by <= y1; by += 4) {
    for (int bx = x0 & ~3; bx <= x1; bx += 4) {
      const int index = context.block_index(bx, by);
      auto* const visibility = reinterpret_cast<std::int32_t*>(memory.visibility) + index;
      std::uint32_t pending = pixels_where(visibility, [](Int at) HWY_ATTR { return hn::Gt(at, splat(-1)); });
      if (pending == 0) continue;
      while (pending != 0) {
        // All pixels of the block that belong to the surface of the first one still pending.
        const ShadedTriangle& leader =
            memory.visible_triangles[static_cast<std::size_t>(visibility[std::countr_zero(pending)])];
        const bool other_surface = !pixels.is_of(leader);
        if (pixels.blocks == kBatchBlocks || other_surface) shade_batch(context, pixels);
        if (other_surface) begin_surface(context, pixels, leader);
        pixels.index[pixels.blocks] = index;
        pixels.bx[pixels.blocks] = bx;
        pixels.by[pixels.blocks] = by;
        const std::uint32_t taken = take_surface_pixels(context, pixels, visibility, pending);
        pending &= ~taken;
        pixels.covered[pixels.blocks++] = taken;
      }
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
        hn::Store(splat(-1), kInt, visibility + chunk * kLanes);
    }
  }
  shade_batch(context, pixels);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
