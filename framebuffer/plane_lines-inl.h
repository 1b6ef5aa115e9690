// Whole cache lines of planes, 512 pixels of 4 rows at a time, for AVX-512 with products of bits (GFNI).
//
// A block of tile memory, 4x4 words, is one vector. From words to lines of planes by exchanges, until the
// place of a byte among the 64 of a vector stands for, from its highest bits to the lowest:
//
//   row, pixel of 4, byte       blocks, as they are loaded
//   row, half, pixel of 8       bytes of 4 blocks, split by which byte of the word they are; halves of 128
//   pixels row, half, plane of 8       the same times 1: each 8x8 bits transposed row, half, byte of 64 8 of
//   those, exchanged by the bits of their places: 128 pixels of 4 rows of one plane byte of 512 4 of those,
//   exchanged by rows: a line
#if defined(TESSERA_FRAMEBUFFER_PLANE_LINES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_FRAMEBUFFER_PLANE_LINES_INL_H_
#undef TESSERA_FRAMEBUFFER_PLANE_LINES_INL_H_
#else
#define TESSERA_FRAMEBUFFER_PLANE_LINES_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cstdint>

#include "framebuffer/prefetch_lines.h"
#include "framebuffer/strip_rows.h"

#if HWY_TARGET == HWY_AVX3
HWY_PUSH_ATTRIBUTES(HWY_TARGET_STR ",gfni")
namespace tessera::detail {
namespace HWY_NAMESPACE {

inline constexpr int kQuarterPixels = kLinePixels / 4;

/// Byte kByte of the words of 4 blocks, each 8 pixels of a row as 8 planes: the first two are of the left
/// half of a quarter.
template <int kByte>
HWY_INLINE __m512i planes_of(const __m512i (&split)[4]) noexcept {
  const __m512i left =
      kByte < 2 ? _mm512_unpacklo_epi32(split[0], split[1]) : _mm512_unpackhi_epi32(split[0], split[1]);
  const __m512i right =
      kByte < 2 ? _mm512_unpacklo_epi32(split[2], split[3]) : _mm512_unpackhi_epi32(split[2], split[3]);
  const __m512i pixels =
      kByte % 2 == 0 ? _mm512_unpacklo_epi64(left, right) : _mm512_unpackhi_epi64(left, right);
  const __m512i one = _mm512_set1_epi64(static_cast<long long>(0x8040201008040201));
  return _mm512_gf2p8affine_epi64_epi8(
      one, pixels,
      0);  // the pixels are the matrix: byte k becomes bit k of each of them, the first one highest
}

/// Those bytes of `a` whose place has bit kBit change places with those of `b` that lack it.
template <int kBit>
HWY_INLINE void exchange(__m512i& a, __m512i& b) noexcept {
  constexpr __mmask64 kHave = kBit == 0   ? 0xaaaaaaaaaaaaaaaa
                              : kBit == 1 ? 0xcccccccccccccccc
                                          : 0xf0f0f0f0f0f0f0f0;
  constexpr int n = 1 << kBit;
  const __m512i other =
      _mm512_broadcast_i32x4(_mm_setr_epi8(n, 1 ^ n, 2 ^ n, 3 ^ n, 4 ^ n, 5 ^ n, 6 ^ n, 7 ^ n, 8 ^ n, 9 ^ n,
                                           10 ^ n, 11 ^ n, 12 ^ n, 13 ^ n, 14 ^ n, 15 ^ n));
  const __m512i kept = a;
  a = _mm512_mask_shuffle_epi8(a, kHave, b, other);
  b = _mm512_mask_shuffle_epi8(b, ~kHave, kept, other);
}
template <int kBit>
HWY_INLINE void exchange_all(__m512i (&v)[8]) noexcept {
#pragma GCC unroll 8
  for (int i = 0; i < 8; ++i)
    if ((i >> kBit & 1) == 0) exchange<kBit>(v[i], v[i | 1 << kBit]);
}

/// The quarter of the strip that begins with pixel x, of the 4 rows from y on: plane k of its rows, one after
/// the other.
///
/// @param bytes  of words, each of which holds 8 planes
HWY_INLINE void transpose_quarter(const StripRows& strip, int x, int y, int bytes, __m512i* planes) noexcept {
  const __m512i split =
      _mm512_broadcast_i32x4(_mm_setr_epi8(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15));
  // Through memory: more vectors than there are registers.
  alignas(64) __m512i eights[4][8];
#pragma GCC unroll 1
  for (int i = 0; i < 8; ++i) {
    const auto* const left = reinterpret_cast<const __m512i*>(strip.pixels(x + 8 * i, y));
    const auto* const right =
        reinterpret_cast<const __m512i*>(strip.pixels(x + kQuarterPixels / 2 + 8 * i, y));
    const __m512i blocks[4] = {_mm512_shuffle_epi8(_mm512_load_si512(left), split),
                               _mm512_shuffle_epi8(_mm512_load_si512(left + 1), split),
                               _mm512_shuffle_epi8(_mm512_load_si512(right), split),
                               _mm512_shuffle_epi8(_mm512_load_si512(right + 1), split)};
    _mm512_store_si512(&eights[0][i], planes_of<0>(blocks));
    if (bytes > 1) _mm512_store_si512(&eights[1][i], planes_of<1>(blocks));
    if (bytes > 2) _mm512_store_si512(&eights[2][i], planes_of<2>(blocks));
    if (bytes > 3) _mm512_store_si512(&eights[3][i], planes_of<3>(blocks));
  }
#pragma GCC unroll 1
  for (int b = 0; b < bytes; ++b) {
    __m512i v[8];
#pragma GCC unroll 8
    for (int i = 0; i < 8; ++i) v[i] = _mm512_load_si512(&eights[b][i]);
    exchange_all<0>(v);
    exchange_all<1>(v);
    exchange_all<2>(v);
#pragma GCC unroll 8
    for (int i = 0; i < 8; ++i) _mm512_store_si512(planes + 8 * b + i, v[i]);
  }
}

/// Bits of the first `inside_px` pixels of a line.
inline __m512i line_mask(int inside_px) noexcept {
  alignas(64) std::uint8_t bytes[kLinePixels / 8];
  for (int i = 0; i < kLinePixels / 8; ++i)
    bytes[i] = static_cast<std::uint8_t>(0xff00 >> std::clamp(inside_px - 8 * i, 0, 8));
  return _mm512_load_si512(bytes);
}

/// @pre the strip takes all of the picture's pixels in a line of the planes
inline void store_lines(const StripRows& strip, std::uint32_t flip, std::uint32_t mask) noexcept {
  const int bytes = (std::bit_width(mask) + 7) / 8;
  alignas(64) __m512i quarters[4][kMaxPlanes] = {};  // those outside the picture are masked away
  const __m512i inside = line_mask(strip.width_px);
  for (int y = 0; y < strip.height_px; y += kBlockSize) {
    const StripBits line{strip.bits.first + y * strip.stride_bytes, strip.bits.plane_stride};
    const int rows = std::min(kBlockSize, strip.height_px - y);
    for (int k = 0; k < 8 * bytes; ++k)  // the lines come while the bits are collected
      if ((mask >> k & 1) != 0) prefetch_lines(line.plane(k), strip.stride_bytes, 1, rows);
    for (int x = 0; x < strip.width_px; x += kQuarterPixels)
      transpose_quarter(strip, x, y, bytes, quarters[x / kQuarterPixels]);
    for (int k = 0; k < 8 * bytes; ++k) {
      if ((mask >> k & 1) == 0) continue;
      const __m512i flips = _mm512_set1_epi32((flip >> k & 1) != 0 ? -1 : 0);
      const __m512i a = quarters[0][k], b = quarters[1][k], c = quarters[2][k], d = quarters[3][k];
      const __m512i ab01 = _mm512_shuffle_i32x4(a, b, 0x44), ab23 = _mm512_shuffle_i32x4(a, b, 0xee);
      const __m512i cd01 = _mm512_shuffle_i32x4(c, d, 0x44), cd23 = _mm512_shuffle_i32x4(c, d, 0xee);
      const __m512i lines[kBlockSize] = {
          _mm512_shuffle_i32x4(ab01, cd01, 0x88), _mm512_shuffle_i32x4(ab01, cd01, 0xdd),
          _mm512_shuffle_i32x4(ab23, cd23, 0x88), _mm512_shuffle_i32x4(ab23, cd23, 0xdd)};
      std::uint8_t* const to = line.plane(k);
#pragma GCC unroll 4
      for (int r = 0; r < kBlockSize; ++r)
        if (r < rows)
          _mm512_store_si512(to + r * strip.stride_bytes,
                             _mm512_and_si512(_mm512_xor_si512(lines[r], flips), inside));
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_POP_ATTRIBUTES
#endif

#endif
