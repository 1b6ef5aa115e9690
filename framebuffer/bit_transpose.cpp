// Tiles and planes meet in strips of a row, as long as the instruction set likes. With vectors of bytes: 32 pixels are stored
// by the sign masks of their bytes, 64 are loaded as 8x8 squares of bits. Elsewhere: 8 pixels, a square in a 64-bit integer.
//
// Based on: H. S. Warren, Hacker's Delight, 2nd edition 2012, 7-3 (8x8 bits by three rounds of exchanges).
#include "framebuffer/bit_transpose.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "framebuffer/bit_transpose.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "framebuffer/check.h"
#include "framebuffer/tile_grid.h"

#ifndef TESSERA_BIT_TRANSPOSE_ONCE
#define TESSERA_BIT_TRANSPOSE_ONCE
namespace tessera {
namespace {

static_assert(std::endian::native == std::endian::little);  // a strip's bits are stored as one integer

// The strip's bytes in plane 0, and the way from there to the other planes.
struct StripBits {
  std::uint8_t* first;
  std::size_t plane_stride;
  std::uint8_t* plane(int k) const noexcept { return first + static_cast<std::size_t>(k) * plane_stride; }
};
struct ConstStripBits {
  const std::uint8_t* first;
  std::size_t plane_stride;
  const std::uint8_t* plane(int k) const noexcept { return first + static_cast<std::size_t>(k) * plane_stride; }
};

/// What of a tile takes part, and the planes' bits of its top left pixel.
template <class Word, class Bits>
struct TileRows {
  Word* tile;
  int tile_size, width_px, height_px;
  Bits bits;
  std::ptrdiff_t stride_bytes;  ///< of the planes' rows
  /// Of pixel 0 of row y; those of pixel x, a multiple of 4, come x * kBlockSize later.
  Word* words(int y) const noexcept { return tile + tile_index(0, y, tile_size); }
};

inline void assert_tile_fits([[maybe_unused]] const TilePlace& place, [[maybe_unused]] const BitplaneStack& planes) noexcept {
  TESSERA_ASSERT(place.tile_size == 32 || place.tile_size == 64 || place.tile_size == 128);
  TESSERA_ASSERT(place.x0_px >= 0 && place.x0_px < planes.width_px() && place.x0_px % place.tile_size == 0);
  TESSERA_ASSERT(place.y0_px >= 0 && place.y0_px < planes.height_px() && place.y0_px % place.tile_size == 0);
  // Rows are padded to a multiple of every tile size, so that no column of a tile falls off the end of its row.
  static_assert(kPlaneAlignment * 8 % kMaxTileSize == 0);
}

}  // namespace
}  // namespace tessera
#endif

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3

// Two groups of 4 pixels, 16 pixels apart: they share a vector because bytes are shuffled within its halves.
HWY_INLINE __m256i load_groups(const std::uint32_t* words, int group) noexcept {
  const std::uint32_t* const low = words + group * kBlockPixels;
  const __m128i* const high = reinterpret_cast<const __m128i*>(low + 4 * kBlockPixels);
  return _mm256_inserti128_si256(_mm256_castsi128_si256(_mm_load_si128(reinterpret_cast<const __m128i*>(low))), _mm_load_si128(high), 1);
}
HWY_INLINE void store_groups(__m256i groups, std::uint32_t* words, int group) noexcept {
  std::uint32_t* const low = words + group * kBlockPixels;
  _mm_store_si128(reinterpret_cast<__m128i*>(low), _mm256_castsi256_si128(groups));
  _mm_store_si128(reinterpret_cast<__m128i*>(low + 4 * kBlockPixels), _mm256_extracti128_si256(groups, 1));
}

/// Stores those of 8 planes whose bit is set in `mask`; `bytes` has plane k's pixels in bit k. The sign mask takes bit 7 of
/// all bytes; adding a byte to itself brings the next one up.
HWY_INLINE void store_byte_planes(__m256i bytes, StripBits to, std::uint32_t mask) noexcept {
  if (mask == 0) return;
  for (int k = 7; k >= 0; --k) {
    if ((mask >> k & 1) != 0) {
      const int bits = _mm256_movemask_epi8(bytes);
      std::memcpy(to.plane(k), &bits, sizeof bits);
    }
    bytes = _mm256_add_epi8(bytes, bytes);
  }
}

/// 32 pixels of a row.
///
/// @param kWholeBytes  the mask holds all of the lowest 8 kWholeBytes planes and no other; 0: any mask
/// @param inside_px    how many of the pixels lie in the picture, from the left; 32 or more: all
template <int kWholeBytes>
HWY_INLINE void store_strip(const std::uint32_t* words, __m256i flips, int inside_px, StripBits to, std::uint32_t mask) noexcept {
  // In each group of 4 words: byte 0 of all, byte 1 of all, ...; right to left, because bit 7 is the leftmost pixel but
  // byte 0 gives bit 0 of a sign mask.
  const __m256i split = _mm256_setr_epi8(12, 8, 4, 0, 13, 9, 5, 1, 14, 10, 6, 2, 15, 11, 7, 3,  //
                                         12, 8, 4, 0, 13, 9, 5, 1, 14, 10, 6, 2, 15, 11, 7, 3);
  const __m256i a = _mm256_shuffle_epi8(_mm256_xor_si256(load_groups(words, 0), flips), split);
  const __m256i b = _mm256_shuffle_epi8(_mm256_xor_si256(load_groups(words, 1), flips), split);
  const __m256i c = _mm256_shuffle_epi8(_mm256_xor_si256(load_groups(words, 2), flips), split);
  const __m256i d = _mm256_shuffle_epi8(_mm256_xor_si256(load_groups(words, 3), flips), split);
  // 4x4 transposition; within a byte of the plane the left group is the upper half.
  const __m256i ba01 = _mm256_unpacklo_epi32(b, a), ba23 = _mm256_unpackhi_epi32(b, a);
  const __m256i dc01 = _mm256_unpacklo_epi32(d, c), dc23 = _mm256_unpackhi_epi32(d, c);
  __m256i bytes[4] = {_mm256_unpacklo_epi64(ba01, dc01), _mm256_unpackhi_epi64(ba01, dc01),
                      _mm256_unpacklo_epi64(ba23, dc23), _mm256_unpackhi_epi64(ba23, dc23)};
  if (inside_px < 32) {
    const __m256i pixel = _mm256_setr_epi8(7, 6, 5, 4, 3, 2, 1, 0, 15, 14, 13, 12, 11, 10, 9, 8,  //
                                           23, 22, 21, 20, 19, 18, 17, 16, 31, 30, 29, 28, 27, 26, 25, 24);
    const __m256i inside = _mm256_cmpgt_epi8(_mm256_set1_epi8(static_cast<char>(inside_px)), pixel);
    for (__m256i& byte : bytes) byte = _mm256_and_si256(byte, inside);
  }
  constexpr int kBytes = kWholeBytes == 0 ? 4 : kWholeBytes;
#pragma GCC unroll 4
  for (int i = 0; i < kBytes; ++i)
    store_byte_planes(bytes[i], {to.plane(8 * i), to.plane_stride}, kWholeBytes != 0 ? 0xff : mask >> (8 * i) & 0xff);
}

#if HWY_TARGET == HWY_AVX3
/// 64 pixels of a row that all lie in the picture: the steps of store_strip(), with four groups in a vector.
template <int kWholeBytes>
HWY_INLINE void store_wide_strip(const std::uint32_t* words, std::uint32_t flip, StripBits to, std::uint32_t mask) noexcept {
  const __m512i flips = _mm512_set1_epi32(static_cast<int>(flip)), split = _mm512_broadcast_i32x4(_mm_setr_epi8(12, 8, 4, 0, 13, 9, 5, 1, 14, 10, 6, 2, 15, 11, 7, 3));
  const auto split_groups = [&](int group) HWY_ATTR {
    const __m512i groups = _mm512_inserti64x4(_mm512_castsi256_si512(load_groups(words, group)), load_groups(words + 8 * kBlockPixels, group), 1);
    return _mm512_shuffle_epi8(_mm512_xor_si512(groups, flips), split);
  };
  const __m512i a = split_groups(0), b = split_groups(1), c = split_groups(2), d = split_groups(3);
  const __m512i ba01 = _mm512_unpacklo_epi32(b, a), ba23 = _mm512_unpackhi_epi32(b, a), dc01 = _mm512_unpacklo_epi32(d, c), dc23 = _mm512_unpackhi_epi32(d, c);
  const __m512i bytes[4] = {_mm512_unpacklo_epi64(ba01, dc01), _mm512_unpackhi_epi64(ba01, dc01), _mm512_unpacklo_epi64(ba23, dc23), _mm512_unpackhi_epi64(ba23, dc23)};
  constexpr int kBytes = kWholeBytes == 0 ? 4 : kWholeBytes;
#pragma GCC unroll 4
  for (int i = 0; i < kBytes; ++i) {
    const std::uint32_t planes = kWholeBytes != 0 ? 0xff : mask >> (8 * i) & 0xff;
    if (planes == 0) continue;
    for (int k = 0; k < 8; ++k)
      if ((planes >> k & 1) != 0) {
        const __mmask64 bits = _mm512_test_epi8_mask(bytes[i], _mm512_set1_epi8(static_cast<char>(1 << k)));
        std::memcpy(to.plane(8 * i + k), &bits, sizeof bits);
      }
  }
}
#endif

template <int kWholeBytes>
void store_rows_of(const TileRows<const std::uint32_t, StripBits> rows, std::uint32_t flip, std::uint32_t mask) noexcept {
  const __m256i flips = _mm256_set1_epi32(static_cast<int>(flip));
  StripBits row = rows.bits;
  for (int y = 0; y < rows.height_px; ++y, row.first += rows.stride_bytes) {
    const std::uint32_t* const words = rows.words(y);
    int x = 0;
#if HWY_TARGET == HWY_AVX3
    for (; x + 64 <= rows.width_px; x += 64) store_wide_strip<kWholeBytes>(words + x * kBlockSize, flip, {row.first + x / 8, row.plane_stride}, mask);
#endif
    for (; x < rows.width_px; x += 32)
      store_strip<kWholeBytes>(words + x * kBlockSize, flips, rows.width_px - x, {row.first + x / 8, row.plane_stride}, mask);
  }
}

void store_rows(const TileRows<const std::uint32_t, StripBits>& rows, std::uint32_t flip, std::uint32_t mask) noexcept {
  switch (mask) {
    case 0xff: return store_rows_of<1>(rows, flip, mask);
    case 0xffff: return store_rows_of<2>(rows, flip, mask);
    case 0xffffff: return store_rows_of<3>(rows, flip, mask);
    case 0xffffffff: return store_rows_of<4>(rows, flip, mask);
    default: return store_rows_of<0>(rows, flip, mask);
  }
}

/// Bit b of byte k goes to bit 7 - k of byte 7 - b, in each 64 bits: transposed about the other diagonal, which is what turns
/// pixels whose first one is byte 0 into planes whose first pixel is bit 7. Its own inverse.
HWY_INLINE __m256i anti_transpose_8x8(__m256i x) noexcept {
  const auto pattern = [](std::uint64_t bits) HWY_ATTR { return _mm256_set1_epi64x(static_cast<long long>(bits)); };
  __m256i t = _mm256_and_si256(_mm256_xor_si256(x, _mm256_slli_epi64(x, 9)), pattern(0xaa00aa00aa00aa00));
  x = _mm256_xor_si256(_mm256_xor_si256(x, t), _mm256_srli_epi64(t, 9));
  t = _mm256_and_si256(_mm256_xor_si256(x, _mm256_slli_epi64(x, 18)), pattern(0xcccc0000cccc0000));
  x = _mm256_xor_si256(_mm256_xor_si256(x, t), _mm256_srli_epi64(t, 18));
  t = _mm256_and_si256(_mm256_xor_si256(x, _mm256_slli_epi64(x, 36)), pattern(0xf0f0f0f000000000));
  return _mm256_xor_si256(_mm256_xor_si256(x, t), _mm256_srli_epi64(t, 36));
}

/// Bits of 32 or 64 pixels in two planes.
template <int kPixels>
HWY_INLINE __m128i load_pair(const std::uint8_t* low, const std::uint8_t* high) noexcept {
  if constexpr (kPixels == 64)
    return _mm_unpacklo_epi64(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(low)),
                              _mm_loadl_epi64(reinterpret_cast<const __m128i*>(high)));
  int bits[2];
  std::memcpy(&bits[0], low, sizeof bits[0]);
  std::memcpy(&bits[1], high, sizeof bits[1]);
  return _mm_unpacklo_epi64(_mm_cvtsi32_si128(bits[0]), _mm_cvtsi32_si128(bits[1]));
}

/// 8 planes -> a byte for each pixel, left to right; the left 32 pixels in `left`, the others, if there are any, in `right`.
template <int kPixels>
HWY_INLINE void load_byte_planes(const std::uint8_t* first, const std::size_t* offset, __m256i& left, __m256i& right) noexcept {
  // 8x8 transposition of bytes, to 8 planes of 8 pixels in each 64 bits, plane 7 in the lowest byte.
  const __m256i pairs = _mm256_setr_epi8(0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15,  //
                                         0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15);
  const __m256i planes76_32 = _mm256_set_m128i(load_pair<kPixels>(first + offset[3], first + offset[2]),
                                               load_pair<kPixels>(first + offset[7], first + offset[6]));
  const __m256i planes54_10 = _mm256_set_m128i(load_pair<kPixels>(first + offset[1], first + offset[0]),
                                               load_pair<kPixels>(first + offset[5], first + offset[4]));
  const __m256i a = _mm256_shuffle_epi8(planes76_32, pairs), b = _mm256_shuffle_epi8(planes54_10, pairs);
  const __m256i zip = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7);
  left = anti_transpose_8x8(_mm256_permutevar8x32_epi32(_mm256_unpacklo_epi16(a, b), zip));
  if (kPixels == 64) right = anti_transpose_8x8(_mm256_permutevar8x32_epi32(_mm256_unpackhi_epi16(a, b), zip));
}

/// 32 pixels from their bytes.
HWY_INLINE void store_words(const __m256i (&bytes)[4], __m256i flips, std::uint32_t* words) noexcept {
  const __m256i left01 = _mm256_unpacklo_epi8(bytes[0], bytes[1]), right01 = _mm256_unpackhi_epi8(bytes[0], bytes[1]);
  const __m256i left23 = _mm256_unpacklo_epi8(bytes[2], bytes[3]), right23 = _mm256_unpackhi_epi8(bytes[2], bytes[3]);
  store_groups(_mm256_xor_si256(_mm256_unpacklo_epi16(left01, left23), flips), words, 0);
  store_groups(_mm256_xor_si256(_mm256_unpackhi_epi16(left01, left23), flips), words, 1);
  store_groups(_mm256_xor_si256(_mm256_unpacklo_epi16(right01, right23), flips), words, 2);
  store_groups(_mm256_xor_si256(_mm256_unpackhi_epi16(right01, right23), flips), words, 3);
}

template <int kPixels, int kBytes>
void load_rows(const TileRows<std::uint32_t, ConstStripBits> rows, std::uint32_t flip, int plane_count) noexcept {
  // Planes that are absent from the last byte are read from the last plane and masked away: no branch for each plane.
  std::size_t offset[kMaxPlanes];
  for (int k = 0; k < kMaxPlanes; ++k) offset[k] = static_cast<std::size_t>(std::min(k, plane_count - 1)) * rows.bits.plane_stride;
  const __m256i present = _mm256_set1_epi8(static_cast<char>(0xff >> (8 * kBytes - plane_count)));
  const __m256i flips = _mm256_set1_epi32(static_cast<int>(flip));
  const std::uint8_t* row = rows.bits.first;
  for (int y = 0; y < rows.height_px; ++y, row += rows.stride_bytes)
    for (int x = 0; x < rows.width_px; x += kPixels) {
      __m256i left[4] = {}, right[4] = {};
#pragma GCC unroll 4
      for (int i = 0; i < kBytes; ++i) load_byte_planes<kPixels>(row + x / 8, offset + 8 * i, left[i], right[i]);
      left[kBytes - 1] = _mm256_and_si256(left[kBytes - 1], present);
      right[kBytes - 1] = _mm256_and_si256(right[kBytes - 1], present);
      std::uint32_t* const words = rows.words(y) + x * kBlockSize;
      store_words(left, flips, words);
      if (kPixels == 64) store_words(right, flips, words + 32 * kBlockSize);
    }
}

template <int kPixels>
void load_rows_of(const TileRows<std::uint32_t, ConstStripBits>& rows, std::uint32_t flip, int plane_count) noexcept {
  switch ((plane_count + 7) / 8) {
    case 1: return load_rows<kPixels, 1>(rows, flip, plane_count);
    case 2: return load_rows<kPixels, 2>(rows, flip, plane_count);
    case 3: return load_rows<kPixels, 3>(rows, flip, plane_count);
    default: return load_rows<kPixels, 4>(rows, flip, plane_count);
  }
}

void load_rows(const TileRows<std::uint32_t, ConstStripBits>& rows, std::uint32_t flip, int plane_count) noexcept {
  return rows.tile_size == 32 ? load_rows_of<32>(rows, flip, plane_count) : load_rows_of<64>(rows, flip, plane_count);
}

#else

/// Bit b of byte k goes to bit k of byte b.
inline std::uint64_t transpose_8x8(std::uint64_t x) noexcept {
  std::uint64_t t = (x ^ x >> 7) & 0x00aa00aa00aa00aa;
  x ^= t ^ t << 7;
  t = (x ^ x >> 14) & 0x0000cccc0000cccc;
  x ^= t ^ t << 14;
  t = (x ^ x >> 28) & 0x00000000f0f0f0f0;
  return x ^ t ^ t << 28;
}
/// Pixel i of a strip of 8; its byte stands at 7 - i in 64 bits, because bit 7 is the leftmost pixel.
inline int strip_index(int i) noexcept { return i / kBlockSize * kBlockPixels + i % kBlockSize; }
inline int byte_shift(int i) noexcept { return 8 * (7 - i); }

/// The 8 planes from `base` on, of 8 pixels.
inline void store_byte_planes(const std::uint32_t* words, std::uint32_t flip, int inside_px, StripBits to, int base,
                              std::uint32_t mask) noexcept {
  std::uint64_t bytes = 0;
  for (int i = 0; i < inside_px; ++i)
    bytes |= std::uint64_t{(words[strip_index(i)] ^ flip) >> base & 0xff} << byte_shift(i);
  const std::uint64_t planes = transpose_8x8(bytes);
  for (int k = 0; k < 8; ++k)
    if ((mask >> (base + k) & 1) != 0) *to.plane(base + k) = static_cast<std::uint8_t>(planes >> (8 * k));
}

void store_rows(const TileRows<const std::uint32_t, StripBits> rows, std::uint32_t flip, std::uint32_t mask) noexcept {
  StripBits row = rows.bits;
  for (int y = 0; y < rows.height_px; ++y, row.first += rows.stride_bytes)
    for (int x = 0; x < rows.width_px; x += 8)
      for (int base = 0; base < kMaxPlanes; base += 8)
        if ((mask >> base & 0xff) != 0)
          store_byte_planes(rows.words(y) + x * kBlockSize, flip, std::min(8, rows.width_px - x),
                            {row.first + x / 8, row.plane_stride}, base, mask);
}

inline void load_strip(std::uint32_t* words, std::uint32_t flip, ConstStripBits from, int plane_count) noexcept {
  for (int i = 0; i < 8; ++i) words[strip_index(i)] = flip;
  for (int base = 0; base < plane_count; base += 8) {
    std::uint64_t planes = 0;
    for (int k = 0; k < std::min(8, plane_count - base); ++k) planes |= std::uint64_t{*from.plane(base + k)} << (8 * k);
    const std::uint64_t bytes = transpose_8x8(planes);
    for (int i = 0; i < 8; ++i) words[strip_index(i)] ^= static_cast<std::uint32_t>(bytes >> byte_shift(i) & 0xff) << base;
  }
}

void load_rows(const TileRows<std::uint32_t, ConstStripBits> rows, std::uint32_t flip, int plane_count) noexcept {
  ConstStripBits row = rows.bits;
  for (int y = 0; y < rows.height_px; ++y, row.first += rows.stride_bytes)
    for (int x = 0; x < rows.width_px; x += 8)
      load_strip(rows.words(y) + x * kBlockSize, flip, {row.first + x / 8, row.plane_stride}, plane_count);
}

#endif

}  // namespace

void store_planes(const std::uint32_t* tile, const TilePlace& place, BitplaneStack& planes, std::uint32_t plane_store_mask) noexcept {
  assert_tile_fits(place, planes);
  const std::uint32_t mask = plane_store_mask & planes.word_mask();
  if (mask == 0) return;
  store_rows({.tile = tile,
              .tile_size = place.tile_size,
              .width_px = std::min(place.tile_size, planes.width_px() - place.x0_px),
              .height_px = std::min(place.tile_size, planes.height_px() - place.y0_px),
              .bits = {planes.plane(0) + place.y0_px * planes.stride_bytes() + place.x0_px / 8, planes.plane_stride_bytes()},
              .stride_bytes = planes.stride_bytes()},
             place.flip, mask);
}

void load_planes(std::uint32_t* tile, const TilePlace& place, const BitplaneStack& planes) noexcept {
  assert_tile_fits(place, planes);
  load_rows({.tile = tile,
             .tile_size = place.tile_size,
             .width_px = place.tile_size,  // pad bits are 0
             .height_px = std::min(place.tile_size, planes.height_px() - place.y0_px),
             .bits = {planes.plane(0) + place.y0_px * planes.stride_bytes() + place.x0_px / 8, planes.plane_stride_bytes()},
             .stride_bytes = planes.stride_bytes()},
            place.flip, planes.plane_count());
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {
StorePlanesFn* store_planes_for([[maybe_unused]] Isa isa) noexcept { return TESSERA_KERNEL(isa, store_planes); }
LoadPlanesFn* load_planes_for([[maybe_unused]] Isa isa) noexcept { return TESSERA_KERNEL(isa, load_planes); }
}  // namespace tessera
#endif
