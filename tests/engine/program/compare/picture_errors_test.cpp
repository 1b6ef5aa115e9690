// Errors in levels, compared with a plain computation.
#include "engine/program/compare/picture_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "engine/tessera/tessera.hpp"
#include "tests/engine/program/compare/known_flip_pairs.h"

namespace tessera::program::picture_errors_test {
namespace {

RgbPicture noise(int width, int height, unsigned seed, int levels) {
  std::mt19937 random(seed);
  const auto level = [&] { return static_cast<int>(random() % static_cast<unsigned>(levels)); };
  return {width, height, [&](int, int) { return Rgb{level(), level(), level()}; }};
}

TEST(PictureErrors, AgreeWithPlainComputation) {
  for (const int levels : {256, 5, 2}) {
    const RgbPicture a = noise(31, 17, 1, levels);
    const RgbPicture b = noise(31, 17, 2, levels);
    const PictureErrors errors = picture_errors(a.view(), b.view());
    long double squares = 0;
    int largest = 0;
    std::vector<int> worst(31 * 17);
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
      const int difference = std::abs(a.rgb[i] - b.rgb[i]);
      squares += difference * difference;
      largest = std::max(largest, difference);
      worst[i / 3] = std::max(worst[i / 3], difference);
    }
    const double rms = static_cast<double>(std::sqrt(squares / static_cast<long double>(a.rgb.size())));
    EXPECT_EQ(errors.pixels, 31u * 17);
    EXPECT_EQ(errors.largest, largest);
    EXPECT_DOUBLE_EQ(errors.rms, rms);
    EXPECT_DOUBLE_EQ(errors.psnr_db, 20 * std::log10(255 / rms));
    for (const int threshold : {0, 1, 2, 100, 254, 255}) {
      const auto over =
          std::count_if(worst.begin(), worst.end(), [=](int difference) { return difference > threshold; });
      EXPECT_EQ(errors.pixels_over(threshold), static_cast<std::uint64_t>(over)) << threshold;
      EXPECT_DOUBLE_EQ(errors.share_over(threshold), static_cast<double>(over) / (31 * 17)) << threshold;
    }
  }
}

TEST(PictureErrors, AreExactForSimplePictures) {
  const RgbPicture black(4, 4, [](int, int) { return Rgb{0, 0, 0}; });
  const RgbPicture white(4, 4, [](int, int) { return Rgb{255, 255, 255}; });
  const RgbPicture one_component(4, 4, [](int x, int y) { return Rgb{0, 0, x == 1 && y == 2 ? 4 : 0}; });
  const PictureErrors equal = picture_errors(white.view(), white.view());
  EXPECT_EQ(equal.largest, 0);
  EXPECT_EQ(equal.rms, 0);
  EXPECT_EQ(equal.psnr_db, std::numeric_limits<double>::infinity());
  EXPECT_EQ(equal.pixels_by_error[0], 16u);
  const PictureErrors opposite = picture_errors(white.view(), black.view());
  EXPECT_EQ(opposite.largest, 255);
  EXPECT_EQ(opposite.rms, 255);
  EXPECT_EQ(opposite.psnr_db, 0);
  EXPECT_EQ(opposite.share_over(254), 1);
  const PictureErrors small = picture_errors(black.view(), one_component.view());
  EXPECT_EQ(small.largest, 4);
  EXPECT_EQ(small.rms, std::sqrt(16.0 / 48));
  EXPECT_EQ(small.pixels_over(3), 1u);
  EXPECT_EQ(small.pixels_over(4), 0u);
}

TEST(PictureErrors, RejectSizesThatDiffer) {
  const RgbPicture a = noise(4, 3, 1, 2);
  EXPECT_THROW(picture_errors(a.view(), noise(5, 3, 1, 2).view()), Error);
  EXPECT_THROW(picture_errors(a.view(), noise(4, 4, 1, 2).view()), Error);
  EXPECT_THROW(unrounded_errors(a.view(), std::vector<float>(35)), Error);
}

TEST(UnroundedErrors, AgreeWithPlainComputation) {
  const RgbPicture a = noise(31, 17, 3, 256);
  std::mt19937 random(4);
  std::vector<float> reference;
  long double squares = 0, largest = 0;
  for (const int level : a.rgb) {
    reference.push_back(static_cast<float>(random() >> 8) / 0xffffff);
    const long double difference = std::abs(level - 255 * static_cast<long double>(reference.back()));
    squares += difference * difference;
    largest = std::max(largest, difference);
  }
  const UnroundedErrors errors = unrounded_errors(a.view(), reference);
  EXPECT_NEAR(errors.rms, static_cast<double>(std::sqrt(squares / 1581)), 1e-10);
  EXPECT_NEAR(errors.largest, static_cast<double>(largest), 1e-10);
}

// Rounding errors of a smooth ramp are distributed evenly over -0.5 .. 0.5 levels.
TEST(UnroundedErrors, AreThoseOfRoundingForASmoothRamp) {
  constexpr int kSide = 256;
  const auto value = [](int x, int y) { return static_cast<float>(y * kSide + x) / (kSide * kSide - 1); };
  std::vector<float> reference;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) reference.insert(reference.end(), 3, value(x, y));
  const RgbPicture rounded(kSide, kSide, [&](int x, int y) {
    const int level = static_cast<int>(value(x, y) * 255 + 0.5f);
    return Rgb{level, level, level};
  });
  const UnroundedErrors errors = unrounded_errors(rounded.view(), reference);
  EXPECT_NEAR(errors.rms, std::sqrt(1.0 / 12), 0.0005);
  EXPECT_NEAR(errors.largest, 0.5, 0.002);
}

}  // namespace
}  // namespace tessera::program::picture_errors_test
