// Scalar transposition of 8x8 bits (8 pixels by 8 planes) in a 64-bit integer, for builds without vectors.
//
// Based on: H. S. Warren, Hacker's Delight, 2nd edition 2012, 7-3 (three rounds of exchanges).
#pragma once

#include <cstdint>

#include "framebuffer/tile_grid.h"

namespace tessera::detail {

/// Moves bit b of byte k to bit k of byte b.
inline std::uint64_t transpose_8x8(std::uint64_t x) noexcept {
  std::uint64_t t = (x ^ x >> 7) & 0x00aa00aa00aa00aa;
  x ^= t ^ t << 7;
  t = (x ^ x >> 14) & 0x0000cccc0000cccc;
  x ^= t ^ t << 14;
  t = (x ^ x >> 28) & 0x00000000f0f0f0f0;
  return x ^ t ^ t << 28;
}
/// Offset of pixel i of an 8-pixel strip in tile memory.
inline int strip_index(int i) noexcept { return i / kBlockSize * kBlockPixels + i % kBlockSize; }
/// Shift of pixel i's byte in the 64 bits: byte 7 - i, because bit 7 of a plane's byte is the leftmost pixel.
inline int byte_shift(int i) noexcept { return 8 * (7 - i); }

}  // namespace tessera::detail
