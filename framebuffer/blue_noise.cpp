#include "framebuffer/blue_noise.h"

#include <algorithm>
#include <cstddef>

#include "framebuffer/exact_functions.h"

namespace tessera::detail {
namespace {

constexpr int kReach = 9;  ///< pixels; the filter is 0 beyond
constexpr int kFilterSize = 2 * kReach + 1;
constexpr int kFirstOnes = kBlueNoisePixels / 10;  ///< pixels of the initial pattern

/// Gaussian of sigma 1.5 pixels, Ulichney's choice. Integers make sums exact.
std::array<std::int32_t, kFilterSize * kFilterSize> gaussian_filter() {
  std::array<std::int32_t, kFilterSize * kFilterSize> filter{};
  for (int y = -kReach; y <= kReach; ++y)
    for (int x = -kReach; x <= kReach; ++x)
      filter[static_cast<std::size_t>((y + kReach) * kFilterSize + x + kReach)] =
          static_cast<std::int32_t>(0x1p20 * exponential(-(x * x + y * y) / (2 * 1.5 * 1.5)) + 0.5);
  return filter;
}

/// A binary pattern on a torus, with the filtered density of its ones at every pixel.
class BinaryPattern {
 public:
  bool is_one(std::size_t pixel) const { return ones_[pixel]; }
  void set(std::size_t pixel, bool one) {
    ones_[pixel] = one;
    const int px = static_cast<int>(pixel) % kBlueNoiseSize, py = static_cast<int>(pixel) / kBlueNoiseSize;
    for (int dy = -kReach; dy <= kReach; ++dy)
      for (int dx = -kReach; dx <= kReach; ++dx) {
        const int x = (px + dx + kBlueNoiseSize) % kBlueNoiseSize;
        const int y = (py + dy + kBlueNoiseSize) % kBlueNoiseSize;
        const std::int32_t weight =
            filter_[static_cast<std::size_t>((dy + kReach) * kFilterSize + dx + kReach)];
        density_[static_cast<std::size_t>(y * kBlueNoiseSize + x)] += one ? weight : -weight;
      }
  }
  /// The one with the most ones around it.
  std::size_t tightest_cluster() const { return densest(true, 1); }
  /// The zero with the fewest ones around it.
  std::size_t largest_void() const { return densest(false, -1); }

 private:
  /// Pixel of the given value with the largest sign * density; the first of several.
  std::size_t densest(bool one, std::int32_t sign) const {
    std::size_t best = kBlueNoisePixels;
    for (std::size_t i = 0; i < kBlueNoisePixels; ++i)
      if (ones_[i] == one && (best == kBlueNoisePixels || sign * density_[i] > sign * density_[best]))
        best = i;
    return best;
  }

  std::array<std::int32_t, kFilterSize* kFilterSize> filter_ = gaussian_filter();
  std::array<bool, kBlueNoisePixels> ones_{};
  std::array<std::int32_t, kBlueNoisePixels> density_{};
};

/// Random ones, spread evenly: the tightest cluster moves to the largest void until it is that void.
BinaryPattern initial_pattern() {
  BinaryPattern pattern;
  std::uint32_t random = 1;
  for (int ones = 0; ones < kFirstOnes;) {
    random = random * 1664525u + 1013904223u;  // linear congruential generator [Numerical Recipes]
    const std::size_t pixel = random >> 20;
    if (pattern.is_one(pixel)) continue;
    pattern.set(pixel, true);
    ++ones;
  }
  for (;;) {
    const std::size_t from = pattern.tightest_cluster();
    pattern.set(from, false);
    const std::size_t to = pattern.largest_void();
    pattern.set(to, true);
    if (from == to) return pattern;
  }
}

std::array<std::uint16_t, kBlueNoisePixels> compute_ranks() {
  std::array<std::uint16_t, kBlueNoisePixels> ranks{};
  const BinaryPattern initial = initial_pattern();
  BinaryPattern pattern = initial;
  for (int rank = kFirstOnes - 1; rank >= 0; --rank) {
    const std::size_t pixel = pattern.tightest_cluster();
    ranks[pixel] = static_cast<std::uint16_t>(rank);
    pattern.set(pixel, false);
  }
  // Beyond half of the pixels Ulichney looks for the tightest cluster of zeros. On a torus that is the
  // largest void: densities of ones and zeros have a constant sum.
  pattern = initial;
  for (int rank = kFirstOnes; rank < kBlueNoisePixels; ++rank) {
    const std::size_t pixel = pattern.largest_void();
    ranks[pixel] = static_cast<std::uint16_t>(rank);
    pattern.set(pixel, true);
  }
  return ranks;
}

}  // namespace

const std::array<std::uint16_t, kBlueNoisePixels>& blue_noise_ranks() {
  static const std::array<std::uint16_t, kBlueNoisePixels> ranks = compute_ranks();
  return ranks;
}

}  // namespace tessera::detail
