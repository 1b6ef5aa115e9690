// FLIP: known answers, an oracle, and the same bits in every configuration.
#include "engine/program/compare/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/program/compare/flip_filters.h"
#include "engine/tessera/tessera.hpp"
#include "tests/engine/program/compare/flip_oracle.h"
#include "tests/engine/program/compare/known_flip_pairs.h"

namespace tessera::program::flip_test {
namespace {

/// std::mt19937 returns the same numbers everywhere; distributions of the standard library do not.
RgbPicture random_picture(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  const auto level = [&random] { return static_cast<int>(random() >> 24); };
  return {width, height, [&](int, int) { return Rgb{level(), level(), level()}; }};
}

TEST(FlipErrors, AgreeWithKnownAnswers) {
  for (const KnownFlipPair& pair : known_flip_pairs()) {
    const FlipErrors at_67 = flip_errors(pair.test.view(), pair.reference.view());
    const FlipErrors at_20 = flip_errors(pair.test.view(), pair.reference.view(), {.pixels_per_degree = 20});
    EXPECT_NEAR(at_67.mean, pair.mean_at_67, 0.0005) << pair.name;
    EXPECT_NEAR(at_67.largest, pair.largest_at_67, 0.0005) << pair.name;
    EXPECT_NEAR(at_20.mean, pair.mean_at_20, 0.0005) << pair.name;
  }
}

TEST(FlipErrors, AgreeWithDirectConvolution) {
  const struct {
    int width, height;
    double pixels_per_degree;
  } kCases[] = {{1, 1, 67},  {3, 2, 67},    {21, 17, kDefaultPixelsPerDegree},
                {30, 9, 20}, {7, 40, 33.3}, {150, 70, 5}};
  unsigned seed = 1;
  for (const auto& [width, height, ppd] : kCases) {
    const RgbPicture a = random_picture(width, height, seed++);
    const RgbPicture b = random_picture(width, height, seed++);
    const std::vector<double> expected = flip_oracle(a, b, ppd);
    const FlipErrors errors = flip_errors(a.view(), b.view(), {.pixels_per_degree = ppd});
    ASSERT_EQ(errors.map.size(), expected.size());
    double worst = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
      worst = std::max(worst, std::abs(static_cast<double>(errors.map[i]) - expected[i]));
    EXPECT_LT(worst, 1e-6) << width << "x" << height << " at " << ppd;
  }
}

// Two pixels differ, within the reach of filters from the tiles on each side. Tiles that are equal around
// have errors of exactly 0.
TEST(FlipErrors, AgreeWithDirectConvolutionNextToEqualTiles) {
  constexpr int kWidth = 200, kHeight = 70;
  constexpr double kPixelsPerDegree = 10;
  ASSERT_EQ(flip_filters(kPixelsPerDegree).radius(), 2);
  const RgbPicture a = random_picture(kWidth, kHeight, 1);
  RgbPicture b = a;
  for (const auto& [x, y] : {std::pair(62, 65), std::pair(193, 62)})  // tile borders are at 64 and 192
    b.rgb[static_cast<std::size_t>(3 * (y * kWidth + x))] ^= 0x80u;
  const std::vector<double> expected = flip_oracle(a, b, kPixelsPerDegree);
  const FlipErrors errors = flip_errors(a.view(), b.view(), {.pixels_per_degree = kPixelsPerDegree});
  int differing = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(errors.map[i], expected[i], 1e-6) << i;
    differing += expected[i] > 1e-6 ? 1 : 0;
  }
  EXPECT_EQ(differing, 42);  // two squares of 5x5 without their corners
  EXPECT_EQ(errors.map[190], 0);
}

TEST(FlipErrors, AreTheSameBitsForAnyNumberOfThreads) {
  const RgbPicture a = random_picture(300, 200, 1);
  const RgbPicture b = random_picture(300, 200, 2);
  const FlipErrors one = flip_errors(a.view(), b.view(), {.threads = 1});
  for (const int threads : {2, 3, 0}) {
    const FlipErrors several = flip_errors(a.view(), b.view(), {.threads = threads});
    EXPECT_EQ(std::memcmp(one.map.data(), several.map.data(), one.map.size() * sizeof(float)), 0);
    EXPECT_EQ(one.mean, several.mean);
    EXPECT_EQ(one.percentile_99, several.percentile_99);
    EXPECT_EQ(one.largest, several.largest);
  }
}

// FNV-1a of the map's bits, for every compiler, instruction set and machine.
TEST(FlipErrors, AreTheSameBitsOnEveryMachine) {
  const RgbPicture a = random_picture(150, 100, 3);
  const RgbPicture b = random_picture(150, 100, 4);
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const float error : flip_errors(a.view(), b.view()).map) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &error, sizeof bits);
    hash = (hash ^ bits) * 0x100000001b3;
  }
  EXPECT_EQ(hash, 13341519145170673126u);
}

TEST(FlipErrors, DoNotDependOnOrderOfPictures) {
  const RgbPicture a = random_picture(40, 30, 5);
  const RgbPicture b = random_picture(40, 30, 6);
  EXPECT_EQ(flip_errors(a.view(), b.view()).map, flip_errors(b.view(), a.view()).map);
}

TEST(FlipErrors, IgnoreFurtherBytesOfPixels) {
  const RgbPicture a = random_picture(20, 10, 7);
  const RgbPicture b = random_picture(20, 10, 8);
  Picture with_alpha(20, 10);
  for (std::size_t i = 0; i < 200; ++i) {
    std::copy_n(&a.rgb[3 * i], 3, &with_alpha.rgba[4 * i]);
    with_alpha.rgba[4 * i + 3] = static_cast<std::uint8_t>(i);
  }
  EXPECT_EQ(flip_errors(pixels_of(with_alpha), b.view()).map, flip_errors(a.view(), b.view()).map);
}

TEST(FlipErrors, StatisticsFollowFromMap) {
  const RgbPicture a = random_picture(37, 11, 9);
  const RgbPicture b = random_picture(37, 11, 10);
  const FlipErrors errors = flip_errors(a.view(), b.view());
  std::vector<float> sorted = errors.map;
  std::sort(sorted.begin(), sorted.end());
  double sum = 0;
  for (const float error : sorted) sum += static_cast<double>(error);
  EXPECT_NEAR(errors.mean, sum / 407, 1e-12);
  EXPECT_EQ(errors.percentile_99, sorted[402]);  // 403 of 407 are 99.02 %, 402 are 98.8 %
  EXPECT_EQ(errors.largest, sorted.back());
}

TEST(FlipErrors, RejectSizesThatDifferAndPixelsPerDegreeOutOfRange) {
  const RgbPicture a = random_picture(4, 3, 1);
  const RgbPicture b = random_picture(3, 4, 1);
  const auto message_of = [](const auto& compare) -> std::string {
    try {
      compare();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message_of([&] { flip_errors(a.view(), b.view()); }),
            "the picture is 4x3, the reference 3x4; both must have the same size");
  for (const double ppd : {0.5, 1001.0, -1.0, std::nan("")})
    EXPECT_TRUE(message_of([&] {
                  flip_errors(a.view(), a.view(), {.pixels_per_degree = ppd});
                }).ends_with("must be 1 to 1000"))
        << ppd;
  EXPECT_EQ(flip_errors(a.view(), a.view(), {.pixels_per_degree = 1}).largest, 0);
  EXPECT_EQ(flip_errors(a.view(), a.view(), {.pixels_per_degree = 1000}).largest, 0);
}

TEST(FlipFilters, HaveTheRadiiOfTheirFormulas) {
  const FlipFilters filters = flip_filters(kDefaultPixelsPerDegree);
  EXPECT_EQ(filters.luminance.radius(), 10);  // 3 sqrt(0.04 / (2 pi^2)) 67.02 = 9.05
  EXPECT_EQ(filters.blue_yellow_wide.radius(), 10);
  EXPECT_EQ(filters.smooth.radius(), 9);  // 3 * 0.5 * 0.082 * 67.02 = 8.24
  EXPECT_EQ(filters.radius(), 10);
}

}  // namespace
}  // namespace tessera::program::flip_test
