// Texture filters on a batch of points. Coordinates are converted to fixed point with 16 fraction bits, so
// that the bits are the same on every instruction set.
#if defined(TESSERA_SHADING_TEXTURE_SAMPLING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_TEXTURE_SAMPLING_INL_H_
#undef TESSERA_SHADING_TEXTURE_SAMPLING_INL_H_
#else
#define TESSERA_SHADING_TEXTURE_SAMPLING_INL_H_
#endif

#include <bit>

#include "shading/lighting.h"
#include "shading/power.h"
#include "shading/texels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Applies the wrap mode. The result is in 0..1; a NaN becomes 0.
HWY_INLINE Float wrapped(Float f, TextureWrap wrap) {
  if (wrap == TextureWrap::repeat) return clamped_below(hn::Sub(f, hn::Floor(f)));
  if (wrap == TextureWrap::clamp_to_edge) return clamped_unit(f);
  const Float within_two = neg_mul_add(splat(2.0f), hn::Floor(hn::Mul(f, splat(0.5f))), f);  // 0..2
  return clamped_unit(hn::Min(within_two, hn::Sub(splat(2.0f), within_two)));
}

/// The texel that holds a coordinate.
HWY_INLINE Int nearest_texel(Float unit, const TexelAxis& axis) {
  return hn::ShiftRight<16>(hn::Min(truncate(hn::Mul(unit, splat(axis.scale))), splat(axis.last)));
}

/// The first of the two texels between whose centres a coordinate lies, and the fraction of the way to the
/// next, in both 16-bit halves of the lane.
struct TexelPosition {
  Int texel, fraction;
};
HWY_INLINE TexelPosition bilinear_position(Float unit, const TexelAxis& axis, TextureWrap wrap) {
  Int at = hn::Sub(truncate(hn::Mul(unit, splat(axis.scale))), splat(1 << 15));
  if (wrap == TextureWrap::repeat) {
    // Left of the first centre `at` is negative and wraps to the last texel. Read as unsigned it is large, so
    // the minimum takes at + all.
    at = hn::BitCast(kInt, hn::Min(hn::BitCast(kUint, at), hn::BitCast(kUint, hn::Add(at, splat(axis.all)))));
  } else {
    at = hn::Max(hn::Min(at, splat(axis.last)), hn::Zero(kInt));
  }
  return {hn::ShiftRight<16>(at), in_both_halves(at)};
}

/// Nearest texels, as stored.
/// @param words  texels of the level
HWY_INLINE Int nearest_words(const std::uint32_t* words, const TextureLevel& level, Float s, Float t) {
  const Int column = nearest_texel(s, level.columns);
  const Int row = nearest_texel(t, level.rows);
  return load_words(words, hn::Add(column, hn::Mul(row, splat(level.stride))));
}
HWY_INLINE Texels nearest_texels(const TextureLevels& texture, const TextureLevel& level, Float s, Float t) {
  return texels_of(nearest_words(texture.words + level.first, level, s, t));
}

/// The four texels of a bilinear filter, and their weights.
struct BilinearTexels {
  const std::uint32_t* words;
  std::int32_t stride;
  bool gathers_pairs;
  Int index, to_right, to_next_row;

  HWY_INLINE void place(const TextureLevels& texture, const TextureLevel& level, Float s, Float t) {
    const TexelPosition column = bilinear_position(s, level.columns, texture.wrap_s);
    const TexelPosition row = bilinear_position(t, level.rows, texture.wrap_t);
    words = texture.words + level.first;
    stride = level.stride;
    gathers_pairs = texture.gathers_pairs;
    index = hn::Add(column.texel, hn::Mul(row.texel, splat(level.stride)));
    to_right = column.fraction;
    to_next_row = row.fraction;
  }
  HWY_INLINE Texels filtered() const {
    const Texels lower = lerp_row(words);
    return lerp_texels(lower, lerp_row(words + stride), to_next_row);
  }

 private:
  HWY_INLINE Texels lerp_row(const std::uint32_t* row) const {
    const TexelPairs pairs = load_pairs(row, index, gathers_pairs);
    return lerp_texels(texels_of(pairs.left), texels_of(pairs.right), to_right);
  }
};
HWY_INLINE Texels bilinear_texels(const TextureLevels& texture, const TextureLevel& level, Float s, Float t) {
  BilinearTexels texels;
  texels.place(texture, level, s, t);
  return texels.filtered();
}

/// Polynomial in m - 1 for log2(m) / (2 (m - 1)) with 16 fraction bits, m in [sqrt(1/2), sqrt(2)): a Remez
/// fit, off by less than 1/65536 of a level.
inline constexpr float kLevelCoefficients[] = {5975.88720703125f, -12489.646484375f, 16273.4267578125f,
                                               -23630.955078125f, 47260.09375f};

/// Level of detail with 16 fraction bits [GL 2.1, 3.8.8]: 0 for magnified points; a whole number unless
/// levels are blended.
/// @param footprint  squared texels per pixel; numbers that are not positive yield 0
HWY_INLINE Int level_of_detail(const TextureLevels& texture, Float footprint) {
  const Int bits = hn::BitCast(kInt, footprint);
  Int level;
  if (texture.blends_levels) {
    // m 2^e with m in [sqrt(1/2), sqrt(2)).
    const Int exponent = hn::ShiftRight<23>(hn::Sub(bits, splat(kSqrtHalfBits)));
    const Float m = hn::BitCast(kFloat, hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
    const Float above_one = hn::Sub(m, splat(1.0f));
    Float sum = splat(kLevelCoefficients[0]);
    for (int k = 1; k < 5; ++k) sum = mul_add(sum, above_one, splat(kLevelCoefficients[k]));
    level = hn::Add(truncate(hn::Mul(sum, above_one)), hn::ShiftLeft<15>(exponent));
  } else {
    // Level d serves squared footprints in (2^(2d - 1), 2^(2d + 1)].
    const Int exponent = hn::Sub(hn::ShiftRight<23>(hn::Sub(bits, splat(1))), splat(127));
    level = hn::ShiftLeft<16>(hn::ShiftRight<1>(hn::Add(exponent, splat(1))));
  }
  const Int within = hn::Max(hn::Min(level, splat(texture.last << 16)), hn::Zero(kInt));
  return hn::IfThenElseZero(hn::RebindMask(kInt, hn::Gt(footprint, splat(texture.magnification_limit))),
                            within);
}

/// Linearly filtered texels of chunks whose points all lie at `level`, or between it and the next smaller
/// one.
/// @param level_of  levels of detail; their whole part is `level`
template <int kChunks>
HWY_INLINE void mipmapped_linear_texels(const TextureLevels& texture, int level,
                                        const Int (&level_of)[kChunks], const Float (&s)[kChunks],
                                        const Float (&t)[kChunks], Texels (&texels)[kChunks]) {
  BilinearTexels linear[2][kChunks];
  for (int i = 0; i < kChunks; ++i) linear[0][i].place(texture, texture.level[level], s[i], t[i]);
  if (!texture.blends_levels || level == texture.last) {
    for (int i = 0; i < kChunks; ++i) texels[i] = linear[0][i].filtered();
    return;
  }
  for (int i = 0; i < kChunks; ++i) linear[1][i].place(texture, texture.level[level + 1], s[i], t[i]);
  for (int i = 0; i < kChunks; ++i) {
    const Texels larger = linear[0][i].filtered();
    texels[i] = lerp_texels(larger, linear[1][i].filtered(), in_both_halves(level_of[i]));
  }
}
HWY_INLINE Texels mipmapped_linear_texels(const TextureLevels& texture, int level, Int level_of, Float s,
                                          Float t) {
  Texels texels[1];
  mipmapped_linear_texels<1>(texture, level, {level_of}, {s}, {t}, texels);
  return texels[0];
}
HWY_INLINE Texels mipmapped_nearest_texels(const TextureLevels& texture, int level, Int level_of, Float s,
                                           Float t) {
  const Texels larger = nearest_texels(texture, texture.level[level], s, t);
  return texture.blends_levels && level < texture.last
             ? lerp_texels(larger, nearest_texels(texture, texture.level[level + 1], s, t),
                           in_both_halves(level_of))
             : larger;
}

/// Texels of one chunk whose points may have different levels: one pass per level, nearly always one or two.
inline HWY_NOINLINE Texels texels_from_levels(const TextureLevels& texture, Float s, Float t,
                                              Float footprint) {
  const auto minified = hn::RebindMask(kInt, hn::Gt(footprint, splat(texture.magnification_limit)));
  // Magnified points are points of level 0, unless their filter differs.
  const bool filters_differ = texture.mag_linear != texture.min_linear;
  Texels all{hn::Zero(kInt), hn::Zero(kInt)};
  if (filters_differ && !hn::AllTrue(kInt, minified))
    all = texture.mag_linear ? bilinear_texels(texture, texture.level[0], s, t)
                             : nearest_texels(texture, texture.level[0], s, t);
  const Int level_of = level_of_detail(texture, footprint);
  const Int whole = hn::ShiftRight<16>(level_of);
  alignas(64) std::int32_t levels[kLanes];
  hn::Store(whole, kInt, levels);
  for (std::uint32_t left = filters_differ ? mask_bits(kInt, minified) : (1u << kLanes) - 1; left != 0;) {
    const int level = levels[std::countr_zero(left)];
    const Texels here = texture.min_linear ? mipmapped_linear_texels(texture, level, level_of, s, t)
                                           : mipmapped_nearest_texels(texture, level, level_of, s, t);
    auto same = hn::Eq(whole, splat(level));
    if (filters_differ) same = hn::And(same, minified);
    all = {hn::IfThenElse(same, here.br, all.br), hn::IfThenElse(same, here.ga, all.ga)};
    left &= ~mask_bits(kInt, same);
  }
  return all;
}

/// Filtered texels of several chunks. Each step runs for all chunks before the next, because the steps of one
/// chunk depend on each other.
/// @param s, t       coordinates before wrapping
/// @param footprint  squared texels per pixel; unused if the filter does not need it
template <TexelFilter kFilter, int kChunks>
HWY_INLINE void texels_where(const TextureLevels& texture, Float (&s)[kChunks], Float (&t)[kChunks],
                             const Float (&footprint)[kChunks], Texels (&texels)[kChunks]) {
  for (Float& f : s) f = wrapped(f, texture.wrap_s);
  for (Float& f : t) f = wrapped(f, texture.wrap_t);
  if constexpr (kFilter == TexelFilter::nearest) {
    for (int i = 0; i < kChunks; ++i) texels[i] = nearest_texels(texture, texture.level[0], s[i], t[i]);
  } else if constexpr (kFilter == TexelFilter::linear) {
    BilinearTexels linear[kChunks];
    for (int i = 0; i < kChunks; ++i) linear[i].place(texture, texture.level[0], s[i], t[i]);
    for (int i = 0; i < kChunks; ++i) texels[i] = linear[i].filtered();
  } else if constexpr (kFilter == TexelFilter::linear_mipmapped) {
    Int level_of[kChunks];
    for (int i = 0; i < kChunks; ++i) level_of[i] = level_of_detail(texture, footprint[i]);
    const int level = hn::GetLane(hn::ShiftRight<16>(level_of[0]));
    auto same = hn::Eq(hn::ShiftRight<16>(level_of[0]), splat(level));
    for (int i = 1; i < kChunks; ++i)
      same = hn::And(same, hn::Eq(hn::ShiftRight<16>(level_of[i]), splat(level)));
    if (hn::AllTrue(kInt, same)) return mipmapped_linear_texels(texture, level, level_of, s, t, texels);
    for (int i = 0; i < kChunks; ++i) texels[i] = texels_from_levels(texture, s[i], t[i], footprint[i]);
  } else {
    for (int i = 0; i < kChunks; ++i) texels[i] = texels_from_levels(texture, s[i], t[i], footprint[i]);
  }
}

/// Calls run.operator()<kFilter>() for the texture's filter.
template <class Run>
HWY_INLINE void with_filter(const TextureLevels& texture, const Run& run) {
  switch (texture.filter()) {
    case TexelFilter::nearest: return run.template operator()<TexelFilter::nearest>();
    case TexelFilter::linear: return run.template operator()<TexelFilter::linear>();
    case TexelFilter::linear_mipmapped: return run.template operator()<TexelFilter::linear_mipmapped>();
    case TexelFilter::any: return run.template operator()<TexelFilter::any>();
  }
}

/// Samples the texture at the first `count` points, whole blocks.
inline HWY_NOINLINE void sample_texture_lanes(const TextureLevels& texture, ShadingBatch& batch, int count) {
  with_filter(texture, [&]<TexelFilter kFilter>() HWY_ATTR {
    for (int first = 0; first < count; first += kBlockPixels) {
      Float at_s[kChunksPerBlock], at_t[kChunksPerBlock], footprint[kChunksPerBlock];
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
        const auto field = [&](int number) HWY_ATTR {
          return hn::Load(kFloat, batch.field[number] + first + chunk * kLanes);
        };
        at_s[chunk] = field(kTextureS);
        at_t[chunk] = field(kTextureT);
        footprint[chunk] = field(kFootprintSquared);
      }
      Texels texels[kChunksPerBlock];
      texels_where<kFilter>(texture, at_s, at_t, footprint, texels);
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
        const Colors colors = colors_of(texels[chunk]);
        for (int c = 0; c < 4; ++c)
          hn::Store(colors.c[c], kFloat, batch.field[kTexelR + c] + first + chunk * kLanes);
      }
    }
  });
}

/// Texels of the chunk of points from `point` on.
/// @pre sample_texture_lanes() has run, if the texture has levels
HWY_INLINE Colors texels_at(const DrawTexture& texture, const ShadingBatch& batch, int point) {
  Colors texel;
  for (int c = 0; c < 4; ++c)
    texel.c[c] = texture.levels != nullptr ? hn::Load(kFloat, batch.field[kTexelR + c] + point)
                                           : splat(texture.texel[static_cast<std::size_t>(c)]);
  return texel;
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
