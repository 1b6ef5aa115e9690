// Texels of a batch of points by their texture's filters. Coordinates become fixed point with 16 fraction bits, components are
// levels with 8: the same bits on every instruction set.
#if defined(TESSERA_SHADING_TEXTURE_SAMPLING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_TEXTURE_SAMPLING_INL_H_
#undef TESSERA_SHADING_TEXTURE_SAMPLING_INL_H_
#else
#define TESSERA_SHADING_TEXTURE_SAMPLING_INL_H_
#endif

#include <algorithm>
#include <bit>

#include "shading/fragment_ops-inl.h"
#include "shading/lighting.h"
#include "shading/power-inl.h"
#include "shading/texture.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// Components of texels with 8 fraction bits, two in each lane: red below blue, green below alpha.
struct Texels {
  Int rb, ga;
};
HWY_INLINE Texels texels_of(Int words) {
  const Int upper = splat(static_cast<std::int32_t>(0xff00ff00u));
  return {hn::And(hn::ShiftLeft<8>(words), upper), hn::And(words, upper)};
}

/// a - (a f >> 16) + (b f >> 16) for each 16 bits: exactly a where b is the same.
HWY_INLINE Int mixed(Int a, Int b, Int f) {
#if HWY_TARGET == HWY_SCALAR
  const auto part = [](std::uint32_t x, std::uint32_t y) { return ((x & 0xffff) * (y & 0xffff) >> 16) | ((x >> 16) * (y >> 16) & 0xffff0000u); };
  const auto x = static_cast<std::uint32_t>(a.raw), y = static_cast<std::uint32_t>(b.raw), share = static_cast<std::uint32_t>(f.raw);
  return Int(static_cast<std::int32_t>(x - part(x, share) + part(y, share)));
#else
  constexpr hn::Repartition<std::uint16_t, IntTag> d;
  const auto x = hn::BitCast(d, a), y = hn::BitCast(d, b), share = hn::BitCast(d, f);
  return hn::BitCast(kInt, hn::Add(hn::Sub(x, hn::MulHigh(x, share)), hn::MulHigh(y, share)));
#endif
}
HWY_INLINE Texels mixed(const Texels& a, const Texels& b, Int f) { return {mixed(a.rb, b.rb, f), mixed(a.ga, b.ga, f)}; }
HWY_INLINE Int twice(Int fraction) { return hn::Or(fraction, hn::ShiftLeft<16>(fraction)); }

/// The words at an index.
HWY_INLINE Int load_words(const std::uint32_t* words, Int index) {
#if HWY_TARGET == HWY_AVX2
  // Loads one by one are faster than a gather.
  alignas(32) std::int32_t at[8];
  hn::Store(index, kInt, at);
  const auto word = [&](int l) HWY_ATTR { return static_cast<std::int32_t>(words[at[l]]); };
  return Int{_mm256_setr_epi32(word(0), word(1), word(2), word(3), word(4), word(5), word(6), word(7))};
#else
  return hn::GatherIndex(kInt, reinterpret_cast<const std::int32_t*>(words), index);
#endif
}

/// The words at an index and after it.
struct TexelPairs {
  Int left, right;
};
HWY_INLINE TexelPairs load_pairs(const std::uint32_t* words, Int index) {
#if HWY_TARGET == HWY_AVX2
  alignas(32) std::int32_t at[8];
  hn::Store(index, kInt, at);
  const auto two = [&](int first, int second) HWY_ATTR {
    return _mm_loadh_pi(_mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(words + at[first]))), reinterpret_cast<const __m64*>(words + at[second]));
  };
  // Pairs of lanes 0 1 4 5 and of lanes 2 3 6 7: what parts them again stays within halves.
  const __m256 low = _mm256_set_m128(two(4, 5), two(0, 1)), high = _mm256_set_m128(two(6, 7), two(2, 3));
  return {Int{_mm256_castps_si256(_mm256_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)))}, Int{_mm256_castps_si256(_mm256_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1)))}};
#elif HWY_TARGET == HWY_AVX3
  const __m512i low = _mm512_i32gather_epi64(_mm512_castsi512_si256(index.raw), words, 4);
  const __m512i high = _mm512_i32gather_epi64(_mm512_extracti64x4_epi64(index.raw, 1), words, 4);
  const __m512i even = _mm512_set_epi32(30, 28, 26, 24, 22, 20, 18, 16, 14, 12, 10, 8, 6, 4, 2, 0);
  const __m512i odd = _mm512_set_epi32(31, 29, 27, 25, 23, 21, 19, 17, 15, 13, 11, 9, 7, 5, 3, 1);
  return {Int{_mm512_permutex2var_epi32(low, even, high)}, Int{_mm512_permutex2var_epi32(low, odd, high)}};
#else
  const std::uint32_t* const at = words + index.raw;
  return {Int(static_cast<std::int32_t>(at[0])), Int(static_cast<std::int32_t>(at[1]))};
#endif
}

/// A finite coordinate in the image, 0..1.
HWY_INLINE Float wrapped(Float f, Wrap wrap) {
  if (wrap == Wrap::clamp_to_edge) return clamped_unit(f);
  if (wrap == Wrap::repeat) return hn::Sub(f, hn::Floor(f));
  const Float there_and_back = neg_mul_add(splat(2.0f), hn::Floor(hn::Mul(f, splat(0.5f))), f);  // 0..2
  return hn::Min(there_and_back, hn::Sub(splat(2.0f), there_and_back));
}

/// The texel that holds a coordinate.
HWY_INLINE Int nearest_texel(Float unit, std::int32_t size) { return hn::Min(truncate(hn::Mul(unit, splat(static_cast<float>(size)))), splat(size - 1)); }

/// The first of the two texels whose centres a coordinate lies between, and how far it is from there to the next.
struct TexelPlace {
  Int texel, fraction;
};
HWY_INLINE TexelPlace linear_place(Float unit, std::int32_t size, Wrap wrap) {
  Int at = hn::Sub(truncate(hn::Mul(unit, splat(static_cast<float>(size) * 65536.0f))), splat(1 << 15));
  if (wrap != Wrap::repeat) at = hn::Max(hn::Min(at, splat((size - 1) << 16)), hn::Zero(kInt));
  Int texel = hn::ShiftRight<16>(at);
  if (wrap == Wrap::repeat) texel = hn::Add(texel, hn::And(hn::ShiftRight<31>(at), splat(size)));  // before the first: the last
  return {texel, hn::And(at, splat(0xffff))};
}

HWY_INLINE Texels nearest_texels(const TextureLevels& texture, const TextureLevel& level, Float s, Float t) {
  Int index = hn::Add(nearest_texel(s, level.width), splat(level.first));
  if (level.height > 1) index = hn::Add(index, hn::Mul(nearest_texel(t, level.height), splat(level.stride())));
  return texels_of(load_words(texture.words, index));
}

HWY_INLINE Texels linear_texels(const TextureLevels& texture, const TextureLevel& level, Float s, Float t) {
  const TexelPlace column = linear_place(s, level.width, texture.wrap_s);
  const Int to_right = twice(column.fraction);
  const auto row_of = [&](Int index) HWY_ATTR {
    const TexelPairs pairs = load_pairs(texture.words, index);
    return mixed(texels_of(pairs.left), texels_of(pairs.right), to_right);
  };
  const Int in_row = hn::Add(column.texel, splat(level.first));
  if (level.height == 1) return row_of(in_row);
  const TexelPlace row = linear_place(t, level.height, texture.wrap_t);
  const Int index = hn::Add(in_row, hn::Mul(row.texel, splat(level.stride())));
  return mixed(row_of(index), row_of(hn::Add(index, splat(level.stride()))), twice(row.fraction));
}

HWY_INLINE Texels texels_in(const TextureLevels& texture, int level, bool linear, Float s, Float t) {
  return linear ? linear_texels(texture, texture.level[level], s, t) : nearest_texels(texture, texture.level[level], s, t);
}

/// The level of detail of minified points with 16 fraction bits; whole where levels are not blended. GL 2.1, 3.8.8.
HWY_INLINE Int level_of_detail(const TextureLevels& texture, Float footprint) {
  if (texture.last == 0) return hn::Zero(kInt);
  Int level;
  if (texture.blends_levels) {
    level = truncate(hn::Mul(log2_lanes(footprint), splat(0.5f * 65536.0f)));
  } else {
    // The footprint is squared: level d is that of 2^(2d - 1), exclusive, to 2^(2d + 1), inclusive.
    const Int exponent = hn::Sub(hn::ShiftRight<23>(hn::Sub(hn::BitCast(kInt, footprint), splat(1))), splat(127));
    level = hn::ShiftLeft<16>(hn::ShiftRight<1>(hn::Add(exponent, splat(1))));
  }
  return hn::Max(hn::Min(level, splat(texture.last << 16)), hn::Zero(kInt));
}

/// Points of one chunk at whatever levels they have: one pass for each of those, nearly always one or two.
/// @param footprint  squared texels a pixel spans, 0 where that decides nothing
HWY_INLINE Texels filtered_texels(const TextureLevels& texture, Float s, Float t, Float footprint) {
  if (!texture.needs_footprint()) return texels_in(texture, 0, texture.mag_linear, s, t);
  Texels all{hn::Zero(kInt), hn::Zero(kInt)};
  const auto minified = hn::Gt(footprint, splat(texture.most_magnified));
  const bool any_minified = !hn::AllFalse(kFloat, minified);
  // Magnified points are points of level 0 like others, unless they have a filter of their own.
  const bool apart = texture.mag_linear != texture.min_linear;
  if (!any_minified || (apart && !hn::AllTrue(kFloat, minified))) all = texels_in(texture, 0, texture.mag_linear, s, t);
  if (!any_minified) return all;

  // Whatever stands in lanes that nobody looks at: a number.
  const Float most = splat(0x1p60f), sound = hn::IfThenElse(minified, hn::IfThenElse(hn::Lt(footprint, most), footprint, most), splat(1.0f));
  const auto minified_lanes = hn::RebindMask(kInt, minified);
  const Int level_of = hn::IfThenElseZero(minified_lanes, level_of_detail(texture, sound));
  const Int whole = hn::ShiftRight<16>(level_of), fraction = twice(hn::And(level_of, splat(0xffff)));
  alignas(64) std::int32_t levels[kLanes];
  hn::Store(whole, kInt, levels);
  for (std::uint32_t left = apart ? mask_bits(kInt, minified_lanes) : (1u << kLanes) - 1; left != 0;) {
    const int level = levels[std::countr_zero(left)], last = texture.blends_levels ? std::min(level + 1, texture.last) : level;
    Texels here;
    for (int k = level; k <= last; ++k) {
      const Texels texels = texels_in(texture, k, texture.min_linear, s, t);
      here = k == level ? texels : mixed(here, texels, fraction);
    }
    auto same = hn::Eq(whole, splat(level));
    if (apart) same = hn::And(same, minified_lanes);
    all = {hn::IfThenElse(same, here.rb, all.rb), hn::IfThenElse(same, here.ga, all.ga)};
    left &= ~mask_bits(kInt, same);
  }
  return all;
}

/// What a chunk's points see of a texture with levels, coordinates as they come.
inline HWY_NOINLINE Texels texels_where(const TextureLevels& texture, Float s, Float t, Float footprint) {
  if (texture.level[0].height == 1) t = hn::Zero(kFloat);  // a 1-D texture
  // A plane beyond its horizon, at a centre that is not covered.
  const auto finite = hn::Eq(hn::Add(hn::Sub(s, s), hn::Sub(t, t)), hn::Zero(kFloat));
  s = wrapped(hn::IfThenElseZero(finite, s), texture.wrap_s);
  t = wrapped(hn::IfThenElseZero(finite, t), texture.wrap_t);
  return filtered_texels(texture, s, t, footprint);
}

/// component / kTexelOne, correctly rounded for 0 .. kTexelOne: a product, and what it lacks.
HWY_INLINE Float unit_component(Int component) {
  constexpr float kScale = 1.0f / kTexelOne;
  const Float whole = hn::ConvertTo(kFloat, component), quotient = hn::Mul(whole, splat(kScale));
  return mul_add(neg_mul_add(quotient, splat(kTexelOne), whole), splat(kScale), quotient);
}
HWY_INLINE Colors colors_of(const Texels& texels) {
  const auto upper = [](Int two) HWY_ATTR { return hn::BitCast(kInt, hn::ShiftRight<16>(hn::BitCast(kUint, two))); };
  const Int lower = splat(0xffff);
  return {{unit_component(hn::And(texels.rb, lower)), unit_component(hn::And(texels.ga, lower)), unit_component(upper(texels.rb)), unit_component(upper(texels.ga))}};
}

/// Words of 8 bits a component: a component's level, floor(255 c + 0.5), is that of its 16 bits rounded to 8.
HWY_INLINE Int words_of_texels(const Texels& texels) {
  const Int level = splat(0xff00);
  const Int r = hn::ShiftLeft<8>(hn::And(hn::Add(texels.rb, splat(0x80)), level)), g = hn::And(hn::Add(texels.ga, splat(0x80)), level);
  const Int b = hn::BitCast(kInt, hn::ShiftRight<24>(hn::BitCast(kUint, hn::Add(texels.rb, splat(0x800000)))));
  return hn::Or(hn::Or(r, g), b);
}

/// Texels of the first `count` points, whole vectors of lanes.
inline HWY_NOINLINE void sample_texture_lanes(const TextureLevels& texture, ShadingBatch& batch, int count) {
  for (int point = 0; point < count; point += kLanes) {
    const Float footprint = texture.needs_footprint() ? hn::Load(kFloat, batch.field[kTexelsSquared] + point) : hn::Zero(kFloat);
    const Colors colors = colors_of(texels_where(texture, hn::Load(kFloat, batch.field[kTextureS] + point), hn::Load(kFloat, batch.field[kTextureT] + point), footprint));
    for (int c = 0; c < 4; ++c) hn::Store(colors.c[c], kFloat, batch.field[kTexelR + c] + point);
  }
}

/// What a chunk's points see of a texture. @pre sample_texture_lanes, where it has levels
HWY_INLINE Colors texels_at(const DrawTexture& texture, const ShadingBatch& batch, int point) {
  Colors texel;
  for (int c = 0; c < 4; ++c)
    texel.c[c] = texture.levels != nullptr ? hn::Load(kFloat, batch.field[kTexelR + c] + point) : splat(texture.texel[static_cast<std::size_t>(c)]);
  return texel;
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
