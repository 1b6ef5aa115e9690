// Colours of a batch of points, evaluated in steps by deferred shading and for blocks of fragments:
//   attributes gathered (batch_surface-inl.h) -> lit -> clamped -> textured -> packed
#if defined(TESSERA_SHADING_BATCH_COLORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_BATCH_COLORS_INL_H_
#undef TESSERA_SHADING_BATCH_COLORS_INL_H_
#else
#define TESSERA_SHADING_BATCH_COLORS_INL_H_
#endif

#include "shading/batch_surface-inl.h"
#include "shading/stage_blocks-inl.h"
#include "shading/texture_env-inl.h"
#include "shading/texture_sampling-inl.h"
#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

void light_points_lanes(const LightingProgram& program, ShadingBatch& batch, int count);  // lighting.cpp

/// Packed colours of one vector of points, from colours in levels.
HWY_INLINE Int pack_levels(const ColorLayout& layout, const ShadingBatch& batch, int first) {
  const Int red = truncate(hn::Load(kFloat, batch.field[kColorR] + first));
  const Int green = truncate(hn::Load(kFloat, batch.field[kColorG] + first));
  const Int blue = truncate(hn::Load(kFloat, batch.field[kColorB] + first));
  return hn::Or(hn::Or(hn::ShiftLeftSame(red, layout.r_shift()), hn::ShiftLeftSame(green, layout.g_shift())),
                blue);
}

/// Packed colours of one vector of points, from colours 0..1. RGB layouts: each component is
/// floor(c (2^bits - 1) + 0.5). Other layouts: the luminance, or the nearest palette entry.
/// @param covered  points that need a colour, one bit each
HWY_INLINE Int pack_unit_colors(const TileFrame& frame, const ShadingBatch& batch, int first,
                                std::uint32_t covered) {
  const ColorLayout& layout = frame.layout;
  const float* const r = batch.field[kColorR] + first;
  const float* const g = batch.field[kColorG] + first;
  const float* const b = batch.field[kColorB] + first;
  if (layout.index || layout.luminance) {
    alignas(64) std::int32_t packed[kLanes] = {};
    for (int l = 0; l < kLanes; ++l) {
      if ((covered >> l & 1) == 0) continue;
      packed[l] = static_cast<std::int32_t>(layout.index ? frame.palette_search->nearest(r[l], g[l], b[l])
                                                         : quantize_rgb(layout, r[l], g[l], b[l]));
    }
    return hn::Load(kInt, packed);
  }
  const auto level = [](const float* c, int bits) HWY_ATTR {
    return truncate(mul_add(hn::Load(kFloat, c), splat(static_cast<float>((1 << bits) - 1)), splat(0.5f)));
  };
  const Int red = hn::ShiftLeftSame(level(r, layout.r_bits), layout.r_shift());
  const Int green = hn::ShiftLeftSame(level(g, layout.g_bits), layout.g_shift());
  return hn::Or(hn::Or(red, green), level(b, layout.b_bits));
}

/// Thresholds of a chunk of a block. @param x, y  the block's top left pixel in the frame
HWY_INLINE Float dither_thresholds(const DitherPattern& pattern, int x, int y, int chunk) {
  alignas(64) float thresholds[kLanes];
  const int first = chunk * kLanes;
  if constexpr (kLanes >= kBlockSize) {
    for (int row = 0; row < kLanes / kBlockSize; ++row)
      std::copy_n(pattern.four_from(x, y + first / kBlockSize + row), kBlockSize,
                  thresholds + row * kBlockSize);
  } else {
    for (int l = 0; l < kLanes; ++l)
      thresholds[l] = pattern.at(x + (first + l) % kBlockSize, y + (first + l) / kBlockSize);
  }
  return hn::Load(kFloat, thresholds);
}

/// Palette entries nearest to colours 0..1: those of dithered_entry(), or without dither the nearest.
/// @param dither   null: none, and thresholds are ignored
/// @param covered  points that need an entry, one bit each
HWY_INLINE Int nearest_entries(const PaletteSearch& search, const ColorDither* dither, const Colors& colors,
                               Float threshold, std::uint32_t covered) {
  alignas(64) float c[3][kLanes];
  alignas(64) float t[kLanes];
  alignas(64) std::int32_t packed[kLanes] = {};
  for (int k = 0; k < 3; ++k) hn::Store(colors.c[k], kFloat, c[k]);
  hn::Store(threshold, kFloat, t);
  for (int l = 0; l < kLanes; ++l) {
    if ((covered >> l & 1) == 0) continue;
    packed[l] = static_cast<std::int32_t>(
        dither != nullptr ? dithered_entry(*dither, search, c[0][l], c[1][l], c[2][l], t[l])
                          : search.nearest(c[0][l], c[1][l], c[2][l]));
  }
  return hn::Load(kInt, packed);
}

/// pack_unit_colors() with a dither. @param threshold  of the points
HWY_INLINE Int pack_dithered_colors(const TileFrame& frame, const ColorDither& dither,
                                    const ShadingBatch& batch, int first, std::uint32_t covered,
                                    Float threshold) {
  Colors colors{};
  for (int c = 0; c < 3; ++c) colors.c[c] = hn::Load(kFloat, batch.field[kColorR + c] + first);
  if (frame.layout.index) return nearest_entries(*frame.palette_search, &dither, colors, threshold, covered);
  return pack_colors(frame.layout, colors, threshold, &dither);
}

/// Masked indices, rounded like quantize_index(). An extrapolated index wraps around: beyond the ends of a
/// line, and where a sample is covered but not the pixel's centre.
HWY_INLINE Int pack_indices(const ColorLayout& layout, Float interpolated) {
  const float modulus = layout.index_modulus();
  const Float turns = hn::Floor(hn::Mul(interpolated, splat(1 / modulus)));
  // Exact, except where the result is rounded up to the modulus.
  const Float within = neg_mul_add(turns, splat(modulus), interpolated);
  const Float index = hn::IfThenElseZero(hn::Eq(within, within), within);  // a NaN becomes 0
  const Int whole = truncate(hn::Max(index, hn::Zero(kFloat)));
  const auto up = hn::RebindMask(kInt, hn::Ge(hn::Sub(index, hn::ConvertTo(kFloat, whole)), splat(0.5f)));
  const Int nearest = hn::Sub(whole, hn::VecFromMask(kInt, up));
  return hn::Or(hn::And(nearest, splat(static_cast<std::int32_t>(layout.index_mask()))),
                splat(static_cast<std::int32_t>(layout.index_flag())));
}

/// Packed colours of one vector of evaluated points.
HWY_INLINE Int pack_batch_colors(const TileFrame& frame, const BatchSurface& surface,
                                 const ShadingBatch& batch, int first, std::uint32_t covered) {
  switch (surface.packing) {
    case BatchSurface::Packing::indices:
      return pack_indices(frame.layout, hn::Load(kFloat, batch.field[kColorR] + first));
    case BatchSurface::Packing::levels: return pack_levels(frame.layout, batch, first);
    default: return pack_unit_colors(frame, batch, first, covered);
  }
}

/// Stores the unit normals of the lit points of a block, for captures.
/// @param index    of the block's first pixel in the tile
/// @param covered  pixels to store, 16 bits
/// @param first    point of the block's first pixel in the batch
inline HWY_NOINLINE void store_normals(TileContext& context, int index, std::uint32_t covered, int first) {
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
    const auto mask = hn::RebindMask(kFloat, mask_from_bits(chunk_bits(covered, chunk)));
    for (int c = 0; c < 3; ++c) {
      const float* const from = context.memory.batch.field[kNormalX + c] + first + chunk * kLanes;
      float* const to = context.memory.normals->component[c] + index + chunk * kLanes;
      store_where(mask, hn::Load(kFloat, from), kFloat, to);
    }
  }
}

/// Gives the first `count` points the same colour.
/// @param color  r g b
HWY_INLINE void fill_colors(const float* color, ShadingBatch& batch, int count) {
  for (int c = 0; c < 3; ++c)
    for (int point = 0; point < count; point += kLanes)
      hn::Store(splat(color[c]), kFloat, batch.field[kColorR + c] + point);
}

/// Clamps extrapolated colours to 0..1.
HWY_INLINE void clamp_colors(ShadingBatch& batch, int count) {
  for (int point = 0; point < count; point += kLanes)
    for (int c = 0; c < 3; ++c) {
      float* const color = batch.field[kColorR + c] + point;
      hn::Store(clamped_unit(hn::Load(kFloat, color)), kFloat, color);
    }
}

/// Applies the texture environment to colours and texels of the batch.
/// @param kAlpha  alpha is computed, too
/// @param alpha   alpha of the points, in and out; null without kAlpha
template <bool kAlpha>
HWY_NOINLINE void apply_texture_env(const DrawTexture& texture, ShadingBatch& batch, float* alpha,
                                    int count) {
  for (int point = 0; point < count; point += kLanes) {
    Colors colors{{hn::Zero(kFloat), hn::Zero(kFloat), hn::Zero(kFloat), splat(1.0f)}};
    if (kAlpha) colors.c[3] = hn::Load(kFloat, alpha + point);
    for (int c = 0; c < 3; ++c) colors.c[c] = hn::Load(kFloat, batch.field[kColorR + c] + point);
    colors = texture_env_lanes(texture, colors, texels_at(texture, batch, point));
    for (int c = 0; c < 3; ++c) hn::Store(colors.c[c], kFloat, batch.field[kColorR + c] + point);
    if (kAlpha) hn::Store(colors.c[3], kFloat, alpha + point);
  }
}

/// Turns gathered attributes into colours: 0..1, levels or indices, according to surface.packing.
/// With a fragment stage, which runs afterwards, alpha is textured as well.
/// @param count  number of points, rounded up to whole vectors; unused points may hold any bits
HWY_INLINE void evaluate_colors(TileContext& context, const BatchSurface& surface, int count) {
  ShadingBatch& batch = context.memory.batch;
  if (surface.is_constant) fill_colors(surface.tile_draw->color[surface.back ? 1 : 0].data(), batch, count);
  if (surface.program != nullptr) light_points_lanes(*surface.program, batch, count);
  if (surface.clamps_colors) clamp_colors(batch, count);
  if (surface.gathers_coordinates) sample_texture_lanes(*surface.texture->levels, batch, count);
  if (surface.texture == nullptr) return;
  if (surface.stage != nullptr)
    apply_texture_env<true>(*surface.texture, batch, context.memory.stage.field[kStageAlpha], count);
  else apply_texture_env<false>(*surface.texture, batch, nullptr, count);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
