// Stores whole cache lines of planes, 512 pixels of 4 rows at a time, with AVX-512 and products of bit
// matrices (GFNI).
//
// A block of tile memory, 4x4 packed pixels, is one vector. A line is handled in quarters of 128 pixels. Each
// step permutes the 64 bytes of vectors, which are given here as arrays, the last index fastest:
//
//   1. [row 4][pixel 4][byte 4]: a block as it is loaded.
//   2. [row 4][byte 4][pixel 4]: the bytes of a block's pixels, split.
//   3. [row 4][half 2][pixel 8]: one byte of the pixels of 4 blocks, two in each half of the quarter
//      (transpose_byte()).
//   4. [row 4][half 2][plane 8]: bits transposed in squares of 8x8, by products with the identity matrix
//      (transpose_byte()).
//   5. [row 4][half 2][octet 8], an octet being 8 neighbouring pixels of one plane: the 8 vectors of a
//   plane's
//      bytes exchange them, so that each vector holds one plane (exchange_all()).
//   6. [octet 64]: the 4 quarters of a line exchange rows (store_plane_lines()).
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

/// Steps 3 and 4 for byte kByte of the pixels of 4 blocks: every 8 pixels of a row become 8 planes.
///
/// @param split  per block [row 4][byte 4][pixel 4]; blocks 0 and 1 lie in the left half of a quarter, blocks
///               2 and 3 in the right half
template <int kByte>
HWY_INLINE __m512i transpose_byte(const __m512i (&split)[4]) noexcept {
  const __m512i left =
      kByte < 2 ? _mm512_unpacklo_epi32(split[0], split[1]) : _mm512_unpackhi_epi32(split[0], split[1]);
  const __m512i right =
      kByte < 2 ? _mm512_unpacklo_epi32(split[2], split[3]) : _mm512_unpackhi_epi32(split[2], split[3]);
  const __m512i pixels =
      kByte % 2 == 0 ? _mm512_unpacklo_epi64(left, right) : _mm512_unpackhi_epi64(left, right);
  const __m512i identity = _mm512_set1_epi64(static_cast<long long>(0x8040201008040201));
  // The pixels are the matrix operand and the identity is the data: byte k of the result collects bit k of
  // each pixel, the first pixel in the highest bit.
  return _mm512_gf2p8affine_epi64_epi8(identity, pixels, 0);
}

/// Exchanges the bytes of `a` at positions with bit kBit set with those of `b` at positions without it.
template <int kBit>
HWY_INLINE void exchange(__m512i& a, __m512i& b) noexcept {
  constexpr __mmask64 kMasks[] = {0xaaaaaaaaaaaaaaaa, 0xcccccccccccccccc, 0xf0f0f0f0f0f0f0f0};
  constexpr __mmask64 kBitIsSet = kMasks[kBit];
  constexpr int n = 1 << kBit;
  const __m512i other =
      _mm512_broadcast_i32x4(_mm_setr_epi8(n, 1 ^ n, 2 ^ n, 3 ^ n, 4 ^ n, 5 ^ n, 6 ^ n, 7 ^ n, 8 ^ n, 9 ^ n,
                                           10 ^ n, 11 ^ n, 12 ^ n, 13 ^ n, 14 ^ n, 15 ^ n));
  const __m512i kept = a;
  a = _mm512_mask_shuffle_epi8(a, kBitIsSet, b, other);
  b = _mm512_mask_shuffle_epi8(b, ~kBitIsSet, kept, other);
}

/// Exchanges bytes between all pairs of vectors whose numbers differ in bit kBit.
template <int kBit>
HWY_INLINE void exchange_all(__m512i (&v)[8]) noexcept {
#pragma GCC unroll 8
  for (int i = 0; i < 8; ++i)
    if ((i >> kBit & 1) == 0) exchange<kBit>(v[i], v[i | 1 << kBit]);
}

/// Steps 1 to 4 for a quarter line, 128 pixels from x on, of the rows y .. y + 3. planes[k] gets plane k, row
/// by row.
///
/// @param bytes  used bytes per pixel, 1 to 4; 8 planes each
HWY_INLINE void transpose_quarter(const StripRows& strip, int x, int y, int bytes, __m512i* planes) noexcept {
  const __m512i split =
      _mm512_broadcast_i32x4(_mm_setr_epi8(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15));
  // eights[b][i]: the planes of byte b at the 8 pixels from x + 8 i on, and at those half a quarter further
  // on. In memory, because there are more vectors than registers.
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
    _mm512_store_si512(&eights[0][i], transpose_byte<0>(blocks));
    if (bytes > 1) _mm512_store_si512(&eights[1][i], transpose_byte<1>(blocks));
    if (bytes > 2) _mm512_store_si512(&eights[2][i], transpose_byte<2>(blocks));
    if (bytes > 3) _mm512_store_si512(&eights[3][i], transpose_byte<3>(blocks));
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

/// Mask of the first `inside_px` pixels of a line.
inline __m512i line_mask(int inside_px) noexcept {
  alignas(64) std::uint8_t bytes[kLinePixels / 8];
  for (int i = 0; i < kLinePixels / 8; ++i)
    bytes[i] = static_cast<std::uint8_t>(0xff00 >> std::clamp(inside_px - 8 * i, 0, 8));
  return _mm512_load_si512(bytes);
}

/// Step 5: assembles and stores the lines of one plane from quarters of 4 rows. `flips` inverts bits,
/// `inside` masks pixels outside the picture.
HWY_INLINE void store_plane_lines(__m512i a, __m512i b, __m512i c, __m512i d, __m512i flips, __m512i inside,
                                  std::uint8_t* to, std::ptrdiff_t stride_bytes, int rows) noexcept {
  // ab01: rows 0 and 1 of the quarters a and b.
  const __m512i ab01 = _mm512_shuffle_i32x4(a, b, 0x44);
  const __m512i ab23 = _mm512_shuffle_i32x4(a, b, 0xee);
  const __m512i cd01 = _mm512_shuffle_i32x4(c, d, 0x44);
  const __m512i cd23 = _mm512_shuffle_i32x4(c, d, 0xee);
  const __m512i lines[kBlockSize] = {
      _mm512_shuffle_i32x4(ab01, cd01, 0x88), _mm512_shuffle_i32x4(ab01, cd01, 0xdd),
      _mm512_shuffle_i32x4(ab23, cd23, 0x88), _mm512_shuffle_i32x4(ab23, cd23, 0xdd)};
#pragma GCC unroll 4
  for (int r = 0; r < kBlockSize; ++r)
    if (r < rows)
      _mm512_store_si512(to + r * stride_bytes, _mm512_and_si512(_mm512_xor_si512(lines[r], flips), inside));
}

/// Stores a strip of tiles in whole lines. @pre the strip covers all pixels of the picture in its cache line
inline void store_lines(const StripRows& strip, std::uint32_t flip, std::uint32_t mask) noexcept {
  const int bytes = (std::bit_width(mask) + 7) / 8;
  alignas(64) __m512i quarters[4][kMaxPlanes] = {};  // quarters outside the picture are masked out
  const __m512i inside = line_mask(strip.width_px);
  for (int y = 0; y < strip.height_px; y += kBlockSize) {
    const StripBits line{strip.bits.first + y * strip.stride_bytes, strip.bits.plane_stride};
    const int rows = std::min(kBlockSize, strip.height_px - y);
    for (int k = 0; k < 8 * bytes; ++k)  // prefetch the lines during the transposition
      if ((mask >> k & 1) != 0) prefetch_lines(line.plane(k), strip.stride_bytes, 1, rows);
    for (int x = 0; x < strip.width_px; x += kQuarterPixels)
      transpose_quarter(strip, x, y, bytes, quarters[x / kQuarterPixels]);
    for (int k = 0; k < 8 * bytes; ++k) {
      if ((mask >> k & 1) == 0) continue;
      const __m512i flips = _mm512_set1_epi32((flip >> k & 1) != 0 ? -1 : 0);
      store_plane_lines(quarters[0][k], quarters[1][k], quarters[2][k], quarters[3][k], flips, inside,
                        line.plane(k), strip.stride_bytes, rows);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_POP_ATTRIBUTES
#endif

#endif
