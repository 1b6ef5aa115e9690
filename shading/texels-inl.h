// Texels of a batch of points: loaded, interpolated, and as colors. Components are levels with 8 fraction
// bits, two in each lane.
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

/// Blue below red, green below alpha.
struct Texels {
  Int br, ga;
};

#if HWY_TARGET == HWY_SCALAR
/// The 16 bits' lower bytes as upper ones, above zeros.
HWY_INLINE Int lower_bytes_up(Int words) {
  return hn::And(hn::ShiftLeft<8>(words), splat(static_cast<std::int32_t>(0xff00ff00u)));
}
/// 16 bits' upper byte as the lower one.
HWY_INLINE Int upper_bytes_down(Int words) {
  return hn::And(hn::BitCast(kInt, hn::ShiftRight<8>(hn::BitCast(kUint, words))), splat(0x00ff00ff));
}
/// Each lane's lower 16 bits, twice.
HWY_INLINE Int twice(Int lower) { return hn::Or(hn::And(lower, splat(0xffff)), hn::ShiftLeft<16>(lower)); }
/// a - (a f >> 16) + (b f >> 16) for each 16 bits: exactly a where b is the same.
HWY_INLINE Int lerp_texels(Int a, Int b, Int f) {
  const auto part = [](std::uint32_t x, std::uint32_t y) {
    return ((x & 0xffff) * (y & 0xffff) >> 16) | ((x >> 16) * (y >> 16) & 0xffff0000u);
  };
  const auto x = static_cast<std::uint32_t>(a.raw), y = static_cast<std::uint32_t>(b.raw),
             share = static_cast<std::uint32_t>(f.raw);
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
HWY_INLINE Int twice(Int lower) {
  return hn::BitCast(
      kInt, hn::OddEven(hn::BitCast(kHalves, hn::ShiftLeft<16>(lower)), hn::BitCast(kHalves, lower)));
}
HWY_INLINE Int lerp_texels(Int a, Int b, Int f) {
  const auto x = hn::BitCast(kHalves, a), y = hn::BitCast(kHalves, b), share = hn::BitCast(kHalves, f);
  return hn::BitCast(kInt, hn::Add(hn::Sub(x, hn::MulHigh(x, share)), hn::MulHigh(y, share)));
}
#endif

HWY_INLINE Texels texels_of(Int words) {
  return {lower_bytes_up(words), hn::And(words, splat(static_cast<std::int32_t>(0xff00ff00u)))};
}
HWY_INLINE Texels lerp_texels(const Texels& a, const Texels& b, Int f) {
  return {lerp_texels(a.br, b.br, f), lerp_texels(a.ga, b.ga, f)};
}

/// The words at an index and after it.
struct TexelPairs {
  Int left, right;
};
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
/// Those of two lanes, the second above the first.
HWY_INLINE __m128 two_pairs(const std::uint32_t* words, const LaneIndices& at, int lane) {
  return _mm_loadh_pi(_mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(words + at[lane]))),
                      reinterpret_cast<const __m64*>(words + at[lane + 1]));
}
/// Those of four lanes, the last two four lanes after the first: what parts them again stays within halves.
HWY_INLINE __m256 four_pairs(const std::uint32_t* words, const LaneIndices& at, int lane) {
  return _mm256_set_m128(two_pairs(words, at, lane + 4), two_pairs(words, at, lane));
}
#endif
/// @param gathers  AVX-512 gathers them; else they come one by one, which is the faster way on most machines
HWY_INLINE TexelPairs load_pairs(const std::uint32_t* words, Int index, [[maybe_unused]] bool gathers) {
#if HWY_TARGET == HWY_AVX2
  const LaneIndices at(index.raw);
  const __m256 low = four_pairs(words, at, 0), high = four_pairs(words, at, 2);
  return {Int{_mm256_castps_si256(_mm256_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)))},
          Int{_mm256_castps_si256(_mm256_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1)))}};
#elif HWY_TARGET == HWY_AVX3
  if (gathers) {
    const __m512i low = _mm512_i32gather_epi64(_mm512_castsi512_si256(index.raw), words, 4),
                  high = _mm512_i32gather_epi64(_mm512_extracti64x4_epi64(index.raw, 1), words, 4);
    const __m512i left = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30),
                  right = _mm512_or_si512(left, _mm512_set1_epi32(1));
    return {Int{_mm512_permutex2var_epi32(low, left, high)},
            Int{_mm512_permutex2var_epi32(low, right, high)}};
  }
  const LaneIndices lower(_mm512_castsi512_si256(index.raw)), upper(_mm512_extracti64x4_epi64(index.raw, 1));
  const auto eight_pairs = [&](int lane) HWY_ATTR {
    return _mm512_insertf32x8(_mm512_castps256_ps512(four_pairs(words, lower, lane)),
                              four_pairs(words, upper, lane), 1);
  };
  const __m512 low = eight_pairs(0), high = eight_pairs(2);
  return {Int{_mm512_castps_si512(_mm512_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)))},
          Int{_mm512_castps_si512(_mm512_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1)))}};
#else
  const std::uint32_t* const at = words + index.raw;
  return {Int(static_cast<std::int32_t>(at[0])), Int(static_cast<std::int32_t>(at[1]))};
#endif
}

/// component / kTexelOne, correctly rounded for 0 .. kTexelOne: a product, and what it lacks.
HWY_INLINE Float unit_component(Int component) {
  constexpr float kScale = 1.0f / kTexelOne;
  const Float whole = hn::ConvertTo(kFloat, component), quotient = hn::Mul(whole, splat(kScale));
  return mul_add(neg_mul_add(quotient, splat(kTexelOne), whole), splat(kScale), quotient);
}
HWY_INLINE Colors colors_of(const Texels& texels) {
  const auto upper = [](Int two)
                         HWY_ATTR { return hn::BitCast(kInt, hn::ShiftRight<16>(hn::BitCast(kUint, two))); };
  const Int lower = splat(0xffff);
  return {{unit_component(upper(texels.br)), unit_component(hn::And(texels.ga, lower)),
           unit_component(hn::And(texels.br, lower)), unit_component(upper(texels.ga))}};
}

/// Words of 8 bits a component, none of alpha: a component's level, floor(255 c + 0.5), is that of its 16
/// bits rounded to 8.
HWY_INLINE Int pack_texels(const Texels& texels) {
  const Int g = hn::And(hn::Add(texels.ga, splat(0x80)), splat(0xff00));
  return hn::Or(upper_bytes_down(hn::Add(texels.br, splat(0x00800080))), g);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
