#include "engine/record/mipmaps.h"

#include <cstddef>

namespace tessera::detail {
namespace {

int tap_count(std::int32_t row_texels) {
  if (row_texels == 1) return 1;
  return row_texels % 2 == 0 ? 2 : 3;
}

/// Texels in a row of n texels that texel i of the next level covers, with weights.
/// - n = 1: the only texel. Even n: two whole texels.
/// - n = 2m + 1: the texel is (2m + 1) / m wide; weights are in units of 1/m.
struct Taps {
  std::size_t first;
  int count;
  std::uint64_t weight[3];

  Taps(std::int32_t i, std::int32_t n)
      : first(2 * static_cast<std::size_t>(i)), count(tap_count(n)), weight{1, 1, 0} {
    if (count < 3) return;
    const auto m = static_cast<std::uint64_t>(n / 2);
    const auto at = static_cast<std::uint64_t>(i);
    weight[0] = m - at;
    weight[1] = m;
    weight[2] = at + 1;
  }
  std::uint64_t sum() const { return count == 1 ? 1 : weight[0] + weight[1] + weight[2]; }
};

std::uint32_t mean(const std::uint32_t* texels, std::size_t stride, const Taps& columns, const Taps& rows) {
  std::uint64_t sums[4] = {};
  for (int y = 0; y < rows.count; ++y)
    for (int x = 0; x < columns.count; ++x) {
      const std::uint32_t texel = texels[(rows.first + static_cast<std::size_t>(y)) * stride + columns.first +
                                         static_cast<std::size_t>(x)];
      const std::uint64_t weight = rows.weight[y] * columns.weight[x];
      for (int c = 0; c < 4; ++c) sums[c] += weight * (texel >> (8 * c) & 0xff);
    }
  const std::uint64_t area = columns.sum() * rows.sum();
  std::uint32_t word = 0;
  for (int c = 0; c < 4; ++c)
    word |= static_cast<std::uint32_t>((2 * sums[c] + area) / (2 * area)) << (8 * c);
  return word;
}

/// Mean of four whole texels, two components at a time.
std::uint32_t mean_of_four(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  constexpr std::uint32_t kLow = 0x00ff00ff;
  constexpr std::uint32_t kHalf = 0x00020002;
  const auto two = [](std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t s) {
    return ((p & kLow) + (q & kLow) + (r & kLow) + (s & kLow) + kHalf) >> 2 & kLow;
  };
  return two(a, b, c, d) | two(a >> 8, b >> 8, c >> 8, d >> 8) << 8;
}

}  // namespace

void fill_next_level(std::uint32_t* words, const TextureLevel& from, const TextureLevel& to) {
  const std::uint32_t* const texels = words + from.first;
  std::uint32_t* out = words + to.first;
  const auto stride = static_cast<std::size_t>(from.stride);
  const bool is_even = from.width % 2 == 0 && from.height % 2 == 0;
  for (std::int32_t j = 0; j < to.height; ++j, out += to.stride) {
    const Taps rows(j, from.height);
    const std::uint32_t* const upper = texels + rows.first * stride;
    const std::uint32_t* const lower = upper + stride;
    for (std::int32_t i = 0; i < to.width; ++i) {
      if (is_even) out[i] = mean_of_four(upper[2 * i], upper[2 * i + 1], lower[2 * i], lower[2 * i + 1]);
      else out[i] = mean(texels, stride, Taps(i, from.width), rows);
    }
  }
}

}  // namespace tessera::detail
