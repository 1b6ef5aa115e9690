// Stores tiles in planes, one run of pixels of a row at a time.
// - AVX2: 32 pixels, by sign masks of bytes (MOVMSK).
// - AVX-512: 64 pixels, by tests of bytes (VPTESTMB); whole cache lines with GFNI, see plane_lines-inl.h.
// - Scalar: 8 pixels, as a square of bits.
//
// bit_transpose_load.cpp has the loads.
#include "framebuffer/bit_transpose.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "framebuffer/bit_transpose.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "framebuffer/bit_square.h"
#include "framebuffer/check.h"
#include "framebuffer/plane_lines-inl.h"
#include "framebuffer/strip_rows.h"
#include "framebuffer/tile_grid.h"

#ifndef TESSERA_BIT_TRANSPOSE_ONCE
#define TESSERA_BIT_TRANSPOSE_ONCE
namespace tessera::detail {
namespace {

static_assert(std::endian::native == std::endian::little);  // the bits of a strip are stored as one integer

StripRows strip_rows(std::span<const std::uint32_t* const> tiles, const TilePlace& first,
                     BitplaneStack& planes) noexcept {
  assert_tile_fits(first, planes);
  const int width_px = static_cast<int>(tiles.size()) * first.tile_size;
  TESSERA_ASSERT(!tiles.empty() && first.x0_px / kLinePixels == (first.x0_px + width_px - 1) / kLinePixels);
  return {.tiles = tiles,
          .tile_size = first.tile_size,
          .width_px = std::min(width_px, planes.width_px() - first.x0_px),
          .height_px = std::min(first.tile_size, planes.height_px() - first.y0_px),
          .bits = {planes.plane(0) + first.y0_px * planes.stride_bytes() + first.x0_px / 8,
                   planes.plane_stride_bytes()},
          .stride_bytes = planes.stride_bytes()};
}

}  // namespace
}  // namespace tessera::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3

// Loads two groups of 4 pixels that are 16 pixels apart, one into each 128-bit half. The shuffles below move
// bytes within halves only.
HWY_INLINE __m256i load_groups(const std::uint32_t* pixels, int group) noexcept {
  const std::uint32_t* const low = pixels + group * kBlockPixels;
  const __m128i* const high = reinterpret_cast<const __m128i*>(low + 4 * kBlockPixels);
  return _mm256_inserti128_si256(
      _mm256_castsi128_si256(_mm_load_si128(reinterpret_cast<const __m128i*>(low))), _mm_load_si128(high), 1);
}
/// Stores 32 pixels of 8 planes; planes whose bit in `mask` is 0 are left out. Each byte of `bytes` is a
/// pixel, its bit k belongs to plane k. The sign mask extracts bit 7 of all bytes; adding a byte to itself
/// shifts the next bit up.
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

/// Stores 32 pixels of a row.
///
/// @param kWholeBytes  the mask selects exactly the lowest 8 kWholeBytes planes; 0: any mask
/// @param inside_px    number of pixels inside the picture, from the left; 32 or more: all
template <int kWholeBytes>
HWY_INLINE void store_strip(const std::uint32_t* pixels, __m256i flips, int inside_px, StripBits to,
                            std::uint32_t mask) noexcept {
  // Collects byte 0 of each group's 4 pixels, then byte 1, and so on. Pixels are reversed: bit 7 of a plane's
  // byte is the leftmost pixel, but byte 0 yields bit 0 of a sign mask.
  const __m256i split = _mm256_setr_epi8(12, 8, 4, 0, 13, 9, 5, 1, 14, 10, 6, 2, 15, 11, 7, 3,  //
                                         12, 8, 4, 0, 13, 9, 5, 1, 14, 10, 6, 2, 15, 11, 7, 3);
  const __m256i a = _mm256_shuffle_epi8(_mm256_xor_si256(load_groups(pixels, 0), flips), split);
  const __m256i b = _mm256_shuffle_epi8(_mm256_xor_si256(load_groups(pixels, 1), flips), split);
  const __m256i c = _mm256_shuffle_epi8(_mm256_xor_si256(load_groups(pixels, 2), flips), split);
  const __m256i d = _mm256_shuffle_epi8(_mm256_xor_si256(load_groups(pixels, 3), flips), split);
  // Transposition of 4x4 words, from groups to bytes: ba01 has bytes 0 and 1 of the groups b and a. The left
  // group of a pair comes second: it becomes the upper nibble of a plane's byte.
  const __m256i ba01 = _mm256_unpacklo_epi32(b, a);
  const __m256i ba23 = _mm256_unpackhi_epi32(b, a);
  const __m256i dc01 = _mm256_unpacklo_epi32(d, c);
  const __m256i dc23 = _mm256_unpackhi_epi32(d, c);
  __m256i bytes[4] = {_mm256_unpacklo_epi64(ba01, dc01), _mm256_unpackhi_epi64(ba01, dc01),
                      _mm256_unpacklo_epi64(ba23, dc23), _mm256_unpackhi_epi64(ba23, dc23)};
  if (inside_px < 32) {
    const __m256i pixel_of_byte =
        _mm256_setr_epi8(7, 6, 5, 4, 3, 2, 1, 0, 15, 14, 13, 12, 11, 10, 9, 8,  //
                         23, 22, 21, 20, 19, 18, 17, 16, 31, 30, 29, 28, 27, 26, 25, 24);
    const __m256i inside = _mm256_cmpgt_epi8(_mm256_set1_epi8(static_cast<char>(inside_px)), pixel_of_byte);
    for (__m256i& byte : bytes) byte = _mm256_and_si256(byte, inside);
  }
  constexpr int kBytes = kWholeBytes == 0 ? 4 : kWholeBytes;
#pragma GCC unroll 4
  for (int i = 0; i < kBytes; ++i)
    store_byte_planes(bytes[i], {to.plane(8 * i), to.plane_stride},
                      kWholeBytes != 0 ? 0xff : mask >> (8 * i) & 0xff);
}

#if HWY_TARGET == HWY_AVX3
/// Stores 64 pixels of a row, all inside the picture: store_strip() with four groups per vector.
HWY_INLINE void store_wide_strip(const std::uint32_t* pixels, std::uint32_t flip, StripBits to,
                                 std::uint32_t mask) noexcept {
  const __m512i flips = _mm512_set1_epi32(static_cast<int>(flip));
  const __m512i split =
      _mm512_broadcast_i32x4(_mm_setr_epi8(12, 8, 4, 0, 13, 9, 5, 1, 14, 10, 6, 2, 15, 11, 7, 3));
  const auto split_groups = [&](int group) HWY_ATTR {
    const __m512i groups = _mm512_inserti64x4(_mm512_castsi256_si512(load_groups(pixels, group)),
                                              load_groups(pixels + 8 * kBlockPixels, group), 1);
    return _mm512_shuffle_epi8(_mm512_xor_si512(groups, flips), split);
  };
  const __m512i a = split_groups(0);
  const __m512i b = split_groups(1);
  const __m512i c = split_groups(2);
  const __m512i d = split_groups(3);
  const __m512i ba01 = _mm512_unpacklo_epi32(b, a);
  const __m512i ba23 = _mm512_unpackhi_epi32(b, a);
  const __m512i dc01 = _mm512_unpacklo_epi32(d, c);
  const __m512i dc23 = _mm512_unpackhi_epi32(d, c);
  const __m512i bytes[4] = {_mm512_unpacklo_epi64(ba01, dc01), _mm512_unpackhi_epi64(ba01, dc01),
                            _mm512_unpacklo_epi64(ba23, dc23), _mm512_unpackhi_epi64(ba23, dc23)};
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i) {
    if ((mask >> (8 * i) & 0xff) == 0) continue;
    for (int k = 8 * i; k < 8 * i + 8; ++k)
      if ((mask >> k & 1) != 0) {
        const __mmask64 bits =
            _mm512_test_epi8_mask(bytes[i], _mm512_set1_epi8(static_cast<char>(1 << k % 8)));
        std::memcpy(to.plane(k), &bits, sizeof bits);
      }
  }
}
#endif

template <int kWholeBytes>
void store_rows_of(const StripRows& tile, std::uint32_t flip, std::uint32_t mask) noexcept {
  const __m256i flips = _mm256_set1_epi32(static_cast<int>(flip));
  StripBits row = tile.bits;
  for (int y = 0; y < tile.height_px; ++y, row.first += tile.stride_bytes) {
    const std::uint32_t* const pixels = tile.pixels(0, y);
    int x = 0;
#if HWY_TARGET == HWY_AVX3
    for (; x + 64 <= tile.width_px; x += 64)
      store_wide_strip(pixels + x * kBlockSize, flip, {row.first + x / 8, row.plane_stride}, mask);
#endif
    for (; x < tile.width_px; x += 32)
      store_strip<kWholeBytes>(pixels + x * kBlockSize, flips, tile.width_px - x,
                               {row.first + x / 8, row.plane_stride}, mask);
  }
}

#if HWY_TARGET == HWY_AVX3  // kernels for fixed masks gain little: with GFNI most stores take whole lines
void store_rows(const StripRows& tile, std::uint32_t flip, std::uint32_t mask) noexcept {
  store_rows_of<0>(tile, flip, mask);
}
#else
void store_rows(const StripRows& tile, std::uint32_t flip, std::uint32_t mask) noexcept {
  switch (mask) {
    case 0xff: return store_rows_of<1>(tile, flip, mask);
    case 0xffff: return store_rows_of<2>(tile, flip, mask);
    case 0xffffff: return store_rows_of<3>(tile, flip, mask);
    case 0xffffffff: return store_rows_of<4>(tile, flip, mask);
    default: return store_rows_of<0>(tile, flip, mask);
  }
}
#endif

#else

/// Stores 8 pixels in the planes base .. base + 7.
inline void store_byte_planes(const std::uint32_t* pixels, std::uint32_t flip, int inside_px, StripBits to,
                              int base, std::uint32_t mask) noexcept {
  std::uint64_t bytes = 0;
  for (int i = 0; i < inside_px; ++i)
    bytes |= std::uint64_t{(pixels[strip_index(i)] ^ flip) >> base & 0xff} << byte_shift(i);
  const std::uint64_t planes = transpose_8x8(bytes);
  for (int k = 0; k < 8; ++k)
    if ((mask >> (base + k) & 1) != 0) *to.plane(base + k) = static_cast<std::uint8_t>(planes >> (8 * k));
}

void store_rows(const StripRows& tile, std::uint32_t flip, std::uint32_t mask) noexcept {
  StripBits row = tile.bits;
  for (int y = 0; y < tile.height_px; ++y, row.first += tile.stride_bytes)
    for (int x = 0; x < tile.width_px; x += 8)
      for (int base = 0; base < kMaxPlanes; base += 8)
        if ((mask >> base & 0xff) != 0)
          store_byte_planes(tile.pixels(0, y) + x * kBlockSize, flip, std::min(8, tile.width_px - x),
                            {row.first + x / 8, row.plane_stride}, base, mask);
}

#endif

}  // namespace

void store_planes(std::span<const std::uint32_t* const> tiles, const TilePlace& first, BitplaneStack& planes,
                  std::uint32_t plane_store_mask) noexcept {
  const std::uint32_t mask = plane_store_mask & planes.value_mask();
  if (mask == 0) return;
  const StripRows strip = strip_rows(tiles, first, planes);
  for (std::size_t t = 0; t < tiles.size(); ++t) store_rows(strip.only(t), first.flip, mask);
}

#if HWY_TARGET == HWY_AVX3
void store_planes_per_line(std::span<const std::uint32_t* const> tiles, const TilePlace& first,
                           BitplaneStack& planes, std::uint32_t plane_store_mask) noexcept {
  const StripRows strip = strip_rows(tiles, first, planes);
  const bool covers_line = first.x0_px % kLinePixels == 0 &&
                           strip.width_px == std::min(kLinePixels, planes.width_px() - first.x0_px);
  if (!covers_line) return store_planes(tiles, first, planes, plane_store_mask);
  const std::uint32_t mask = plane_store_mask & planes.value_mask();
  if (mask != 0) store_lines(strip, first.flip, mask);
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::detail {
static bool stores_lines(InstructionSet isa) { return isa == InstructionSet::avx512 && machine_has_gfni(); }

int tiles_per_store(InstructionSet isa, int tile_size) noexcept {
  return stores_lines(isa) ? kLinePixels / tile_size : 1;
}
StorePlanesFn* store_planes_for(InstructionSet isa) noexcept {
#if HWY_TARGETS & HWY_AVX3
  if (stores_lines(isa)) return &N_AVX3::store_planes_per_line;
#endif
  return store_planes_per_tile(isa);
}
StorePlanesFn* store_planes_per_tile([[maybe_unused]] InstructionSet isa) noexcept {
  return TESSERA_KERNEL(isa, store_planes);
}
}  // namespace tessera::detail
#endif
