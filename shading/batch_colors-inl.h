// Colors of a batch of points. Deferred shading and blocks of fragments evaluate their colors here, step by
// step:
//   attributes gathered (batch_surface-inl.h) -> lit -> clamped -> textured -> packed
#if defined(TESSERA_SHADING_BATCH_COLORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_BATCH_COLORS_INL_H_
#undef TESSERA_SHADING_BATCH_COLORS_INL_H_
#else
#define TESSERA_SHADING_BATCH_COLORS_INL_H_
#endif

#include "shading/batch_surface-inl.h"
#include "shading/texture_env-inl.h"
#include "shading/texture_sampling-inl.h"
#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

void light_points_lanes(const LightingProgram& program, ShadingBatch& batch, int count);  // lighting.cpp

/// Packed colors of one vector of points, from colors in levels.
HWY_INLINE Int pack_levels(const ColorLayout& layout, const ShadingBatch& batch, int first) {
  const Int red = truncate(hn::Load(kFloat, batch.field[kColorR] + first));
  const Int green = truncate(hn::Load(kFloat, batch.field[kColorG] + first));
  const Int blue = truncate(hn::Load(kFloat, batch.field[kColorB] + first));
  return hn::Or(hn::Or(hn::ShiftLeftSame(red, layout.r_shift()), hn::ShiftLeftSame(green, layout.g_shift())),
                blue);
}

/// Packed colors of one vector of points, from colors 0..1: each component is floor(c (2^bits - 1) + 0.5); or
/// the luminance, or the nearest palette entry.
/// @param covered  points that need a color, one bit each
HWY_INLINE Int pack_unit_colors(const TileFrame& frame, const ShadingBatch& batch, int first,
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

/// Masked indices as quantize_index() rounds them. Beyond the ends of a line, and where only a sample is
/// covered, an extrapolated index wraps around.
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

/// Packed colors of one vector of evaluated points.
HWY_INLINE Int pack_batch_colors(const TileFrame& frame, const BatchSurface& surface,
                                 const ShadingBatch& batch, int first, std::uint32_t covered) {
  switch (surface.packing) {
    case BatchSurface::Packing::indices:
      return pack_indices(frame.layout, hn::Load(kFloat, batch.field[kColorR] + first));
    case BatchSurface::Packing::levels: return pack_levels(frame.layout, batch, first);
    default: return pack_unit_colors(frame, batch, first, covered);
  }
}

/// Stores the unit normals of lit points for a capture.
/// @param index  of the block's first pixel in tile memory
/// @param first  point of that pixel in the batch
inline HWY_NOINLINE void store_normals(TileContext& context, int index, std::uint32_t covered, int first) {
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
    const auto mask = hn::RebindMask(kFloat, mask_from_bits(chunk_bits(covered, chunk)));
    for (int c = 0; c < 3; ++c)
      store_where(mask, hn::Load(kFloat, context.memory.batch.field[kNormalX + c] + first + chunk * kLanes),
                  kFloat, context.memory.normals->component[c] + index + chunk * kLanes);
  }
}

/// Gives the first `count` points one color, r g b.
HWY_INLINE void fill_colors(const float* color, ShadingBatch& batch, int count) {
  for (int c = 0; c < 3; ++c)
    for (int point = 0; point < count; point += kLanes)
      hn::Store(splat(color[c]), kFloat, batch.field[kColorR + c] + point);
}

/// Clamps extrapolated colors to 0..1.
HWY_INLINE void clamp_colors(ShadingBatch& batch, int count) {
  for (int point = 0; point < count; point += kLanes)
    for (int c = 0; c < 3; ++c) {
      float* const color = batch.field[kColorR + c] + point;
      hn::Store(clamped_unit(hn::Load(kFloat, color)), kFloat, color);
    }
}

/// Applies the texture environment to colors and texels of the batch.
inline HWY_NOINLINE void apply_texture_env(const DrawTexture& texture, ShadingBatch& batch, int count) {
  for (int point = 0; point < count; point += kLanes) {
    Colors colors{{hn::Zero(kFloat), hn::Zero(kFloat), hn::Zero(kFloat), splat(1.0f)}};
    for (int c = 0; c < 3; ++c) colors.c[c] = hn::Load(kFloat, batch.field[kColorR + c] + point);
    colors = texture_env_lanes(texture, colors, texels_at(texture, batch, point));
    for (int c = 0; c < 3; ++c) hn::Store(colors.c[c], kFloat, batch.field[kColorR + c] + point);
  }
}

/// Turns gathered attributes into colors 0..1, levels or indices, as surface.packing says.
/// @param count  points, rounded up to whole vectors; later points of the batch may hold any bits
HWY_INLINE void evaluate_colors(TileContext& context, const BatchSurface& surface, int count) {
  ShadingBatch& batch = context.memory.batch;
  if (surface.is_constant)
    fill_colors(context.frame.draws[surface.draw].color[surface.back ? 1 : 0].data(), batch, count);
  if (surface.program != nullptr) light_points_lanes(*surface.program, batch, count);
  if (surface.clamps_colors) clamp_colors(batch, count);
  if (surface.gathers_coordinates) sample_texture_lanes(*surface.texture->levels, batch, count);
  if (surface.texture != nullptr) apply_texture_env(*surface.texture, batch, count);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
