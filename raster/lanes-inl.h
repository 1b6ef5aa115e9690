// Lane types, and lane operations that Highway lacks or that it does not round identically on every target.
// Included by kernels once per instruction set, see framebuffer/lanes.h.
#if defined(TESSERA_RASTER_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_RASTER_LANES_INL_H_
#undef TESSERA_RASTER_LANES_INL_H_
#else
#define TESSERA_RASTER_LANES_INL_H_
#endif

#include <cmath>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;  // at most the 16 pixels of a block
using IntTag = hn::RebindToSigned<FloatTag>;
using UintTag = hn::RebindToUnsigned<FloatTag>;
using Float = hn::Vec<FloatTag>;
using Int = hn::Vec<IntTag>;
using Uint = hn::Vec<UintTag>;
using LaneMask = hn::Mask<IntTag>;
inline constexpr FloatTag kFloat{};
inline constexpr IntTag kInt{};
inline constexpr UintTag kUint{};
inline constexpr int kLanes = static_cast<int>(hn::MaxLanes(FloatTag()));
inline constexpr int kChunksPerBlock = 16 / kLanes;  // a chunk is kLanes consecutive pixels of a block

HWY_INLINE Float splat(float value) { return hn::Set(kFloat, value); }
HWY_INLINE Int splat(std::int32_t value) { return hn::Set(kInt, value); }

/// a b + c, rounded once on every target.
HWY_INLINE Float mul_add(Float a, Float b, Float c) {
#if HWY_TARGET == HWY_SCALAR
  return Float(std::fma(a.raw, b.raw, c.raw));
#else
  return hn::MulAdd(a, b, c);
#endif
}
/// c - a b, rounded once on every target.
HWY_INLINE Float neg_mul_add(Float a, Float b, Float c) {
#if HWY_TARGET == HWY_SCALAR
  return Float(std::fma(-a.raw, b.raw, c.raw));
#else
  return hn::NegMulAdd(a, b, c);
#endif
}

/// a > b ? a : b; hence b if either is NaN. On x86 one MAXPS, whose operand order Highway keeps.
HWY_INLINE Float greater_of(Float a, Float b) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  return hn::Max(a, b);
#else
  return hn::IfThenElse(hn::Gt(a, b), a, b);
#endif
}
/// a < b ? a : b; hence b if either is NaN.
HWY_INLINE Float lesser_of(Float a, Float b) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  return hn::Min(a, b);
#else
  return hn::IfThenElse(hn::Lt(a, b), a, b);
#endif
}

/// Rounds towards zero. Highway's ConvertTo needs three more instructions, for results beyond 32 bits.
/// @pre the result fits in 32 bits
HWY_INLINE Int truncate(Float v) {
#if HWY_TARGET == HWY_AVX2
  return Int{_mm256_cvttps_epi32(v.raw)};
#elif HWY_TARGET == HWY_AVX3
  return Int{_mm512_cvttps_epi32(v.raw)};
#else
  return hn::ConvertTo(kInt, v);
#endif
}

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
/// Eight lane indices in general registers, two in each, for scalar loads.
struct LaneIndices {
  std::uint64_t pair[4];
  explicit HWY_INLINE LaneIndices(__m256i index) {
    const __m128i low = _mm256_castsi256_si128(index);
    const __m128i high = _mm256_extracti128_si256(index, 1);
    pair[0] = static_cast<std::uint64_t>(_mm_cvtsi128_si64(low));
    pair[1] = static_cast<std::uint64_t>(_mm_extract_epi64(low, 1));
    pair[2] = static_cast<std::uint64_t>(_mm_cvtsi128_si64(high));
    pair[3] = static_cast<std::uint64_t>(_mm_extract_epi64(high, 1));
  }
  HWY_INLINE std::size_t operator[](int lane) const {
    return lane % 2 == 0 ? pair[lane / 2] & 0xffffffffu : pair[lane / 2] >> 32;
  }
};
#endif

/// Loads words[index] per lane, index >= 0. AVX2 uses scalar loads, which are faster there than its gather.
HWY_INLINE Int load_words(const std::uint32_t* words, Int index) {
#if HWY_TARGET == HWY_AVX2
  const LaneIndices at(index.raw);
  const auto word = [&](int l) HWY_ATTR { return static_cast<std::int32_t>(words[at[l]]); };
  return Int{_mm256_setr_epi32(word(0), word(1), word(2), word(3), word(4), word(5), word(6), word(7))};
#else
  return hn::GatherIndex(kInt, reinterpret_cast<const std::int32_t*>(words), index);
#endif
}

/// One bit per lane, lane 0 lowest.
template <class Tag, class Mask>
HWY_INLINE std::uint32_t mask_bits([[maybe_unused]] Tag tag, Mask mask) {
#if HWY_TARGET == HWY_SCALAR
  return mask.bits != 0;
#elif HWY_TARGET == HWY_AVX3
  static_assert(hn::MaxLanes(Tag()) >= 8);  // the mask has no bits beyond the lanes
  return mask.raw;
#else
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(tag, mask, bytes);
  return static_cast<std::uint32_t>(bytes[0] | bytes[1] << 8);
#endif
}
/// Mask of the lanes whose bit is set; bits beyond the lanes are ignored.
HWY_INLINE LaneMask mask_from_bits(std::uint32_t bits) {
#if HWY_TARGET == HWY_AVX3
  return LaneMask{static_cast<__mmask16>(bits)};
#else
  alignas(16) static constexpr std::int32_t kBits[16] = {1,       1 << 1,  1 << 2,  1 << 3, 1 << 4,  1 << 5,
                                                         1 << 6,  1 << 7,  1 << 8,  1 << 9, 1 << 10, 1 << 11,
                                                         1 << 12, 1 << 13, 1 << 14, 1 << 15};
  return hn::TestBit(splat(static_cast<std::int32_t>(bits)), hn::LoadU(kInt, kBits));
#endif
}

/// Mask with the lowest `count` bits set. @pre count < 32
HWY_INLINE std::uint32_t low_bits_mask(int count) { return (1u << count) - 1; }

/// Bits of one chunk's lanes, from the 16 bits of a block.
HWY_INLINE std::uint32_t chunk_bits(std::uint32_t block_bits, int chunk) {
  return block_bits >> (chunk * kLanes) & ((1u << kLanes) - 1);
}

#if HWY_TARGET == HWY_AVX3
/// Lanes whose value equals that of an earlier lane. In assembly, because Highway's AVX3 target does not
/// enable AVX512CD; available_isas() requires it.
HWY_INLINE LaneMask duplicate_lanes(Int v) {
  __m512i earlier;  // per lane: one bit per equal earlier lane
  asm("vpconflictd %1, %0" : "=v"(earlier) : "v"(v.raw));
  return hn::Ne(Int{earlier}, hn::Zero(kInt));
}
#endif

// Pixel p of a 4x4 block is in column p % 4 and row p / 4.
alignas(64) inline constexpr std::int32_t kBlockColumn[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) inline constexpr std::int32_t kBlockRow[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
HWY_INLINE Int block_columns(int chunk) { return hn::Load(kInt, kBlockColumn + chunk * kLanes); }
HWY_INLINE Int block_rows(int chunk) { return hn::Load(kInt, kBlockRow + chunk * kLanes); }

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
