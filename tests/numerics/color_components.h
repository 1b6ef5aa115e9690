// Layout of stored color words, written from the specification alone.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tests/engine/frame/api_support.h"

namespace tessera::test {

/// Position of red, green, blue and alpha in a word of an RGB or luminance buffer. For luminance the first
/// three share the same bits. A component without bits reads as 1.
struct ComponentBits {
  std::array<int, 4> bits{};
  std::array<int, 4> shift{};

  ComponentBits(int color_bits, int alpha_bits) {
    if (color_bits <= 2) {
      bits = {color_bits, color_bits, color_bits, alpha_bits};
    } else {
      const int each = color_bits / 3;
      const int odd = color_bits % 3;
      bits = {each + (odd == 2 ? 1 : 0), each + (odd >= 1 ? 1 : 0), each, alpha_bits};
      shift = {bits[1] + bits[2], bits[2], 0, 0};
    }
    shift[3] = color_bits;
  }
  explicit ComponentBits(const FrameBufferFormat& format)
      : ComponentBits(format.color_bits, format.alpha_bits) {}
  bool is_luminance() const { return shift[0] == 0 && bits[0] <= 2; }
  int levels(std::size_t c) const { return (1 << bits[c]) - 1; }  ///< level that represents 1.0
  std::int64_t level(std::uint32_t word, std::size_t c) const {
    return bits[c] == 0 ? 0 : word >> shift[c] & static_cast<std::uint32_t>(levels(c));
  }
};

/// Levels of the accumulation buffer, read from its planes: red, green, blue, alpha per pixel, rows from the
/// top.
inline std::vector<std::array<std::int64_t, 4>> accumulation_levels(const FrameBuffer& buffer) {
  const int bits = buffer.format().accumulation_bits;
  std::vector<std::array<std::int64_t, 4>> levels(pixel_count(buffer));
  for (int k = 0; k < 4 * bits; ++k) {
    const PlaneView plane = buffer.plane(Buffer::accumulation, k);
    std::size_t at = 0;
    for (int y = 0; y < plane.height; ++y)
      for (int x = 0; x < plane.width; ++x, ++at) {
        const std::int64_t bit = plane.bits[y * plane.stride_bytes + x / 8] >> (7 - x % 8) & 1;
        const std::int64_t place = std::int64_t{1} << k % bits;
        levels[at][static_cast<std::size_t>(k / bits)] += k % bits == bits - 1 ? -bit * place : bit * place;
      }
  }
  return levels;
}

}  // namespace tessera::test
