// Texels in lanes: loads, interpolation, and conversion to colours. Components are levels with 8 fraction
// bits, two per lane.
#if defined(TESSERA_SHADING_TEXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_TEXELS_INL_H_
#undef TESSERA_SHADING_TEXELS_INL_H_
#else
#define TESSERA_SHADING_TEXELS_INL_H_
#endif

#include "shading/fragment_ops-inl.h"
#include "shading/texture.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Per lane: red above blue, alpha above green, 16 bits each.
struct Texels {
  Int br, ga;
};

#if HWY_TARGET == HWY_SCALAR
/// For each 16 bits: the lower byte moved to the upper one.
HWY_INLINE Int lower_bytes_up(Int words) {
  return hn::And(hn::ShiftLeft<8>(words), splat(static_cast<std::int32_t>(0xff00ff00u)));
}
/// For each 16 bits: the upper byte moved to the lower one.
HWY_INLINE Int upper_bytes_down(Int words) {
  return hn::And(hn::BitCast(kInt, hn::ShiftRight<8>(hn::BitCast(kUint, words))), splat(0x00ff00ff));
}
/// The lower 16 bits of each lane in both halves.
HWY_INLINE Int in_both_halves(Int lower) {
  return hn::Or(hn::And(lower, splat(0xffff)), hn::ShiftLeft<16>(lower));
}
/// a - (a f >> 16) + (b f >> 16) for each 16 bits: exactly a if b equals a.
HWY_INLINE Int lerp_texels(Int a, Int b, Int f) {
  const auto part = [](std::uint32_t x, std::uint32_t y) {
    return ((x & 0xffff) * (y & 0xffff) >> 16) | ((x >> 16) * (y >> 16) & 0xffff0000u);
  };
  const auto x = static_cast<std::uint32_t>(a.raw), y = static_cast<std::uint32_t>(b.raw);
  const auto share = static_cast<std::uint32_t>(f.raw);
  return Int(static_cast<std::int32_t>(x - part(x, share) + part(y, share)));
}
#else
inline constexpr hn::Repartition<std::uint16_t, IntTag> kHalves{};
HWY_INLINE Int lower_bytes_up(Int words) {
  return hn::BitCast(kInt, hn::ShiftLeft<8>(hn::BitCast(kHalves, words)));
}
HWY_INLINE Int upper_bytes_down(Int words) {
  return hn::BitCast(kInt, hn::ShiftRight<8>(hn::BitCast(kHalves, words)));
}
HWY_INLINE Int in_both_halves(Int lower) {
  return hn::BitCast(
      kInt, hn::OddEven(hn::BitCast(kHalves, hn::ShiftLeft<16>(lower)), hn::BitCast(kHalves, lower)));
}
HWY_INLINE Int lerp_texels(Int a, Int b, Int f) {
  const auto x = hn::BitCast(kHalves, a), y = hn::BitCast(kHalves, b);
  const auto share = hn::BitCast(kHalves, f);
  return hn::BitCast(kInt, hn::Add(hn::Sub(x, hn::MulHigh(x, share)), hn::MulHigh(y, share)));
}
#endif

HWY_INLINE Texels texels_of(Int words) {
  return {lower_bytes_up(words), hn::And(words, splat(static_cast<std::int32_t>(0xff00ff00u)))};
}
HWY_INLINE Texels lerp_texels(const Texels& a, const Texels& b, Int f) {
  return {lerp_texels(a.br, b.br, f), lerp_texels(a.ga, b.ga, f)};
}

/// Per lane: the texel at an index, and the next one.
struct TexelPairs {
  Int left, right;
};
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
/// Pairs of two lanes, the second above the first.
HWY_INLINE __m128 two_pairs(const std::uint32_t* words, const LaneIndices& at, int lane) {
  return _mm_loadh_pi(_mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(words + at[lane]))),
                      reinterpret_cast<const __m64*>(words + at[lane + 1]));
}
/// Pairs of lanes `lane`, `lane` + 1, `lane` + 4 and `lane` + 5, so that later shuffles stay within halves.
HWY_INLINE __m256 four_pairs(const std::uint32_t* words, const LaneIndices& at, int lane) {
  return _mm256_set_m128(two_pairs(words, at, lane + 4), two_pairs(words, at, lane));
}
#endif
/// Loads the texels at `index` and the next ones.
/// @param gathers  AVX-512: use gathers; single loads are faster on most machines
HWY_INLINE TexelPairs load_pairs(const std::uint32_t* words, Int index, [[maybe_unused]] bool gathers) {
#if HWY_TARGET == HWY_AVX2
  const LaneIndices at(index.raw);
  const __m256 low = four_pairs(words, at, 0);
  const __m256 high = four_pairs(words, at, 2);
  return {Int{_mm256_castps_si256(_mm256_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)))},
          Int{_mm256_castps_si256(_mm256_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1)))}};
#elif HWY_TARGET == HWY_AVX3
  if (gathers) {
    const __m512i low = _mm512_i32gather_epi64(_mm512_castsi512_si256(index.raw), words, 4);
    const __m512i high = _mm512_i32gather_epi64(_mm512_extracti64x4_epi64(index.raw, 1), words, 4);
    const __m512i left = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    const __m512i right = _mm512_or_si512(left, _mm512_set1_epi32(1));
    return {Int{_mm512_permutex2var_epi32(low, left, high)},
            Int{_mm512_permutex2var_epi32(low, right, high)}};
  }
  const LaneIndices lower(_mm512_castsi512_si256(index.raw));
  const LaneIndices upper(_mm512_extracti64x4_epi64(index.raw, 1));
  const auto eight_pairs = [&](int lane) HWY_ATTR {
    return _mm512_insertf32x8(_mm512_castps256_ps512(four_pairs(words, lower, lane)),
                              four_pairs(words, upper, lane), 1);
  };
  const __m512 low = eight_pairs(0);
  const __m512 high = eight_pairs(2);
  return {Int{_mm512_castps_si512(_mm512_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)))},
          Int{_mm512_castps_si512(_mm512_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1)))}};
#else
  const std::uint32_t* const at = words + index.raw;
  return {Int(static_cast<std::int32_t>(at[0])), Int(static_cast<std::int32_t>(at[1]))};
#endif
}

/// component / kTexelOne, correctly rounded for 0 .. kTexelOne: a product and its correction.
HWY_INLINE Float unit_component(Int component) {
  constexpr float kScale = 1.0f / kTexelOne;
  const Float whole = hn::ConvertTo(kFloat, component);
  const Float quotient = hn::Mul(whole, splat(kScale));
  return mul_add(neg_mul_add(quotient, splat(kTexelOne), whole), splat(kScale), quotient);
}
HWY_INLINE Colors colors_of(const Texels& texels) {
  const auto upper = [](Int two)
                         HWY_ATTR { return hn::BitCast(kInt, hn::ShiftRight<16>(hn::BitCast(kUint, two))); };
  const Int lower = splat(0xffff);
  return {{unit_component(upper(texels.br)), unit_component(hn::And(texels.ga, lower)),
           unit_component(hn::And(texels.br, lower)), unit_component(upper(texels.ga))}};
}

/// Packed 8-bit RGB without alpha: the level floor(255 c + 0.5) is the 16-bit component rounded to 8 bits.
HWY_INLINE Int pack_texels(const Texels& texels) {
  const Int red_blue = upper_bytes_down(hn::Add(texels.br, splat(0x00800080)));
  const Int green = hn::And(hn::Add(texels.ga, splat(0x80)), splat(0xff00));
  return hn::Or(red_blue, green);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
