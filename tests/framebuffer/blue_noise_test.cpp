// The blue-noise array: a permutation whose binary patterns have no low frequencies and no peak.
#include "framebuffer/blue_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace tessera::detail::blue_noise_test {
namespace {

constexpr int kSize = kBlueNoiseSize;

/// Power |F(u, v)|^2 / N of the pixels with ranks below `limit`, without the mean; row by row.
std::vector<double> power_spectrum(int limit) {
  using Complex = std::complex<double>;
  std::vector<Complex> rows(kBlueNoisePixels);
  const auto turn = [](int k) { return std::polar(1.0, -2 * std::numbers::pi * k / kSize); };
  const double mean = static_cast<double>(limit) / kBlueNoisePixels;
  const auto& ranks = blue_noise_ranks();
  const auto at = [](int x, int y) { return static_cast<std::size_t>(y * kSize + x); };
  for (int y = 0; y < kSize; ++y)
    for (int u = 0; u < kSize; ++u)
      for (int x = 0; x < kSize; ++x)
        rows[at(u, y)] += ((ranks[at(x, y)] < limit ? 1 : 0) - mean) * turn(u * x);
  std::vector<double> power;
  for (int v = 0; v < kSize; ++v)
    for (int u = 0; u < kSize; ++u) {
      Complex sum;
      for (int y = 0; y < kSize; ++y) sum += rows[at(u, y)] * turn(v * y);
      power.push_back(std::norm(sum) / kBlueNoisePixels);
    }
  return power;
}

TEST(BlueNoise, HasEveryRankOnce) {
  std::vector<std::uint16_t> ranks(blue_noise_ranks().begin(), blue_noise_ranks().end());
  std::sort(ranks.begin(), ranks.end());
  for (std::size_t i = 0; i < ranks.size(); ++i) ASSERT_EQ(ranks[i], i);
}

// White noise of two levels with mean m has the power m (1 - m) at every frequency.
TEST(BlueNoise, HalfGreyHasNoLowFrequenciesAndNoPeak) {
  const std::vector<double> power = power_spectrum(kBlueNoisePixels / 2);
  const double white = 0.25;
  double low_sum = 0;
  int low_count = 0;
  for (int v = 0; v < kSize; ++v)
    for (int u = 0; u < kSize; ++u) {
      const double frequency = std::hypot(std::min(u, kSize - u), std::min(v, kSize - v)) / kSize;
      const double here = power[static_cast<std::size_t>(v * kSize + u)];
      // The largest of 4096 exponentially distributed powers exceeds 20 times the mean with probability 1e-5.
      EXPECT_LT(here, 20 * white) << u << ", " << v;
      if (frequency == 0 || frequency >= 0.125) continue;
      low_sum += here;
      ++low_count;
    }
  EXPECT_LT(low_sum / low_count, white / 10);
}

TEST(BlueNoise, SparsePatternsAreSpreadEvenly) {
  // 64 ones on a torus of 64x64: a square grid would have a distance of 8 pixels.
  const auto& ranks = blue_noise_ranks();
  for (std::size_t i = 0; i < ranks.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (ranks[i] >= 64 || ranks[j] >= 64) continue;
      const auto distance = [](std::size_t a, std::size_t b) {
        const int d = std::abs(static_cast<int>(a) - static_cast<int>(b));
        return std::min(d, kSize - d);
      };
      EXPECT_GE(std::hypot(distance(i % 64, j % 64), distance(i / 64, j / 64)), 4.0);
    }
}

}  // namespace
}  // namespace tessera::detail::blue_noise_test
