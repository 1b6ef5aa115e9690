// Loads tiles from planes, one strip of a row at a time: 32 or 64 pixels as 8x8 squares of bits with AVX2, 8
// pixels in the scalar build. AVX-512 uses the AVX2 code.
//
// Based on: H. S. Warren, Hacker's Delight, 2nd edition 2012, 7-3 (8x8 bits by three rounds of exchanges).
#include "framebuffer/bit_transpose.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "framebuffer/bit_transpose_load.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "framebuffer/bit_square.h"
#include "framebuffer/strip_rows.h"
#include "framebuffer/tile_grid.h"

#ifndef TESSERA_BIT_TRANSPOSE_LOAD_ONCE
#define TESSERA_BIT_TRANSPOSE_LOAD_ONCE
namespace tessera::detail {
namespace {

/// Rows of a tile, and their bits in the planes.
struct LoadedRows {
  std::uint32_t* tile;
  int tile_size;
  int height_px;                       ///< rows inside the picture
  PlaneBits<const std::uint8_t> bits;  ///< bits of the top left pixel
  std::ptrdiff_t stride_bytes;         ///< row stride of the planes
  /// Address of pixel 0 of row y; pixel x, a multiple of 4, is x * kBlockSize further on.
  std::uint32_t* pixels(int y) const noexcept { return tile + tile_index(0, y, tile_size); }
};

}  // namespace
}  // namespace tessera::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3

/// Stores two groups of 4 pixels that are 16 pixels apart, one from each 128-bit half.
HWY_INLINE void store_groups(__m256i groups, std::uint32_t* pixels, int group) noexcept {
  std::uint32_t* const low = pixels + group * kBlockPixels;
  _mm_store_si128(reinterpret_cast<__m128i*>(low), _mm256_castsi256_si128(groups));
  _mm_store_si128(reinterpret_cast<__m128i*>(low + 4 * kBlockPixels), _mm256_extracti128_si256(groups, 1));
}

/// In each 64 bits, moves bit b of byte k to bit 7 - k of byte 7 - b: a transposition about the other
/// diagonal, which is its own inverse.
/// - Input: byte k is plane 7 - k, its bit 7 the first pixel.
/// - Output: byte 0 is the first pixel, its bit k belongs to plane k.
HWY_INLINE __m256i anti_transpose_8x8(__m256i x) noexcept {
  const auto pattern = [](std::uint64_t bits)
                           HWY_ATTR { return _mm256_set1_epi64x(static_cast<long long>(bits)); };
  __m256i t = _mm256_and_si256(_mm256_xor_si256(x, _mm256_slli_epi64(x, 9)), pattern(0xaa00aa00aa00aa00));
  x = _mm256_xor_si256(_mm256_xor_si256(x, t), _mm256_srli_epi64(t, 9));
  t = _mm256_and_si256(_mm256_xor_si256(x, _mm256_slli_epi64(x, 18)), pattern(0xcccc0000cccc0000));
  x = _mm256_xor_si256(_mm256_xor_si256(x, t), _mm256_srli_epi64(t, 18));
  t = _mm256_and_si256(_mm256_xor_si256(x, _mm256_slli_epi64(x, 36)), pattern(0xf0f0f0f000000000));
  return _mm256_xor_si256(_mm256_xor_si256(x, t), _mm256_srli_epi64(t, 36));
}

/// Loads the bits of 32 or 64 pixels of two planes.
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

/// Loads 8 planes: one byte per pixel, left to right, pixels 0 to 31 in `left`, 32 to 63 (kPixels = 64) in
/// `right`. Plane k is at first + offset[k].
template <int kPixels>
HWY_INLINE void load_byte_planes(const std::uint8_t* first, const std::size_t* offset, __m256i& left,
                                 __m256i& right) noexcept {
  // Transposition of 8x8 bytes: each 64 bits then hold 8 planes of 8 pixels, plane 7 in the lowest byte.
  const __m256i pairs = _mm256_setr_epi8(0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15,  //
                                         0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15);
  const __m256i planes76_32 = _mm256_set_m128i(load_pair<kPixels>(first + offset[3], first + offset[2]),
                                               load_pair<kPixels>(first + offset[7], first + offset[6]));
  const __m256i planes54_10 = _mm256_set_m128i(load_pair<kPixels>(first + offset[1], first + offset[0]),
                                               load_pair<kPixels>(first + offset[5], first + offset[4]));
  const __m256i a = _mm256_shuffle_epi8(planes76_32, pairs);
  const __m256i b = _mm256_shuffle_epi8(planes54_10, pairs);
  const __m256i zip = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7);
  left = anti_transpose_8x8(_mm256_permutevar8x32_epi32(_mm256_unpacklo_epi16(a, b), zip));
  if (kPixels == 64)
    right = anti_transpose_8x8(_mm256_permutevar8x32_epi32(_mm256_unpackhi_epi16(a, b), zip));
}

/// Assembles and stores 32 packed pixels. bytes[i] holds byte i of each pixel.
HWY_INLINE void store_pixels(const __m256i (&bytes)[4], __m256i flips, std::uint32_t* pixels) noexcept {
  const __m256i left01 = _mm256_unpacklo_epi8(bytes[0], bytes[1]);
  const __m256i right01 = _mm256_unpackhi_epi8(bytes[0], bytes[1]);
  const __m256i left23 = _mm256_unpacklo_epi8(bytes[2], bytes[3]);
  const __m256i right23 = _mm256_unpackhi_epi8(bytes[2], bytes[3]);
  store_groups(_mm256_xor_si256(_mm256_unpacklo_epi16(left01, left23), flips), pixels, 0);
  store_groups(_mm256_xor_si256(_mm256_unpackhi_epi16(left01, left23), flips), pixels, 1);
  store_groups(_mm256_xor_si256(_mm256_unpacklo_epi16(right01, right23), flips), pixels, 2);
  store_groups(_mm256_xor_si256(_mm256_unpackhi_epi16(right01, right23), flips), pixels, 3);
}

/// Loads kPixels pixels of kBytes bytes at a time.
template <int kPixels, int kBytes>
void load_strips(const LoadedRows rows, std::uint32_t flip, int plane_count) noexcept {
  // Absent planes of the last byte are read from the last plane and masked out, which avoids a branch per
  // plane.
  std::size_t offset[kMaxPlanes];
  for (int k = 0; k < kMaxPlanes; ++k)
    offset[k] = static_cast<std::size_t>(std::min(k, plane_count - 1)) * rows.bits.plane_stride;
  const __m256i present = _mm256_set1_epi8(static_cast<char>(0xff >> (8 * kBytes - plane_count)));
  const __m256i flips = _mm256_set1_epi32(static_cast<int>(flip));
  const std::uint8_t* row = rows.bits.first;
  for (int y = 0; y < rows.height_px; ++y, row += rows.stride_bytes)
    for (int x = 0; x < rows.tile_size; x += kPixels) {  // pad bits are 0
      __m256i left[4] = {}, right[4] = {};
#pragma GCC unroll 4
      for (int i = 0; i < kBytes; ++i)
        load_byte_planes<kPixels>(row + x / 8, offset + 8 * i, left[i], right[i]);
      left[kBytes - 1] = _mm256_and_si256(left[kBytes - 1], present);
      right[kBytes - 1] = _mm256_and_si256(right[kBytes - 1], present);
      std::uint32_t* const pixels = rows.pixels(y) + x * kBlockSize;
      store_pixels(left, flips, pixels);
      if (kPixels == 64) store_pixels(right, flips, pixels + 32 * kBlockSize);
    }
}

template <int kPixels>
void load_strips_of(const LoadedRows& rows, std::uint32_t flip, int plane_count) noexcept {
  switch ((plane_count + 7) / 8) {
    case 1: return load_strips<kPixels, 1>(rows, flip, plane_count);
    case 2: return load_strips<kPixels, 2>(rows, flip, plane_count);
    case 3: return load_strips<kPixels, 3>(rows, flip, plane_count);
    default: return load_strips<kPixels, 4>(rows, flip, plane_count);
  }
}

void load_rows(const LoadedRows& rows, std::uint32_t flip, int plane_count) noexcept {
  if (rows.tile_size == 32) load_strips_of<32>(rows, flip, plane_count);
  else load_strips_of<64>(rows, flip, plane_count);
}

#else

inline void load_strip(std::uint32_t* pixels, std::uint32_t flip, PlaneBits<const std::uint8_t> from,
                       int plane_count) noexcept {
  for (int i = 0; i < 8; ++i) pixels[strip_index(i)] = flip;
  for (int base = 0; base < plane_count; base += 8) {
    std::uint64_t planes = 0;
    for (int k = 0; k < std::min(8, plane_count - base); ++k)
      planes |= std::uint64_t{*from.plane(base + k)} << (8 * k);
    const std::uint64_t bytes = transpose_8x8(planes);
    for (int i = 0; i < 8; ++i)
      pixels[strip_index(i)] ^= static_cast<std::uint32_t>(bytes >> byte_shift(i) & 0xff) << base;
  }
}

void load_rows(const LoadedRows rows, std::uint32_t flip, int plane_count) noexcept {
  PlaneBits<const std::uint8_t> row = rows.bits;
  for (int y = 0; y < rows.height_px; ++y, row.first += rows.stride_bytes)
    for (int x = 0; x < rows.tile_size; x += 8)  // pad bits are 0
      load_strip(rows.pixels(y) + x * kBlockSize, flip, {row.first + x / 8, row.plane_stride}, plane_count);
}

#endif

}  // namespace

void load_planes(std::uint32_t* tile, const TilePlace& place, const BitplaneStack& planes) noexcept {
  assert_tile_fits(place, planes);
  load_rows({.tile = tile,
             .tile_size = place.tile_size,
             .height_px = std::min(place.tile_size, planes.height_px() - place.y0_px),
             .bits = {planes.plane(0) + place.y0_px * planes.stride_bytes() + place.x0_px / 8,
                      planes.plane_stride_bytes()},
             .stride_bytes = planes.stride_bytes()},
            place.flip, planes.plane_count());
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::detail {
LoadPlanesFn* load_planes_for([[maybe_unused]] InstructionSet isa) noexcept {
  return TESSERA_KERNEL(isa, load_planes);
}
}  // namespace tessera::detail
#endif
