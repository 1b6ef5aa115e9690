#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "perf/accuracy/enlarge.h"
#include "perf/accuracy/png_bytes.h"
#include "perf/accuracy/result_files.h"
#include "tests/reference/image_file.h"

namespace tessera::accuracy::accuracy_pictures_test {
namespace {

program::Picture noise(int width, int height) {
  program::Picture picture(width, height);
  std::uint32_t state = 12345;
  for (std::uint8_t& value : picture.rgba)
    value = static_cast<std::uint8_t>((state = state * 1664525u + 1013904223u) >> 24);
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) picture.rgba[i] = 255;
  return picture;
}

/// The picture at a position in pixels, where pixel centres are at halves; the border continues.
double bilinear(const program::Picture& picture, double x, double y, std::size_t channel) {
  const auto at = [&](double column, double row) {
    const auto i = static_cast<std::size_t>(std::clamp(column, 0.0, picture.width - 1.0));
    const auto j = static_cast<std::size_t>(std::clamp(row, 0.0, picture.height - 1.0));
    return static_cast<double>(picture.rgba[4 * (j * static_cast<std::size_t>(picture.width) + i) + channel]);
  };
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  const double fx = x - 0.5 - left, fy = y - 0.5 - top;
  return (1 - fy) * ((1 - fx) * at(left, top) + fx * at(left + 1, top)) +
         fy * ((1 - fx) * at(left, top + 1) + fx * at(left + 1, top + 1));
}

TEST(AccuracyPictures, EnlargedPixelsAreTheNearestLevelsOfBilinearInterpolation) {
  const program::Picture small = noise(7, 5);
  for (const int factor : {2, 4}) {
    program::Picture large(7 * factor, 5 * factor);
    enlarge(small, factor, large);
    for (int y = 0; y < large.height; ++y)
      for (int x = 0; x < large.width; ++x)
        for (std::size_t c = 0; c < 4; ++c) {
          const double exact = bilinear(small, (x + 0.5) / factor, (y + 0.5) / factor, c);
          const auto pixel = static_cast<std::size_t>(y * large.width + x);
          ASSERT_EQ(large.rgba[4 * pixel + c], std::floor(exact + 0.5)) << factor << ": " << x << ", " << y;
        }
  }
}

TEST(AccuracyPictures, PngFilesHoldThePixels) {
  const program::Picture picture = noise(33, 17);
  for (const PngEffort effort : {PngEffort::fast, PngEffort::small}) {
    const std::string bytes = png_bytes(picture, effort);
    const reference::Image image = reference::read_png({bytes.begin(), bytes.end()});
    ASSERT_EQ(image.channels, 3);
    ASSERT_EQ(image.width, 33);
    ASSERT_EQ(image.height, 17);
    for (std::size_t pixel = 0; pixel < 33 * 17; ++pixel)
      for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(image.levels[3 * pixel + c], picture.rgba[4 * pixel + c]);
  }
}

TEST(AccuracyPictures, Base64TextsAreThoseOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(AccuracyPictures, DifferencesAreAmplifiedByTheLargestPowerOfTwoThatFits) {
  program::Picture a(2, 1), b(2, 1);
  a.rgba = {10, 20, 30, 255, 100, 100, 100, 255};
  b.rgba = {12, 20, 23, 255, 100, 85, 100, 255};
  const AmplifiedDifference difference = amplified_difference(a, b);
  EXPECT_EQ(difference.gain, 16);  // 15 * 16 = 240
  EXPECT_EQ(difference.picture.rgba, (std::vector<std::uint8_t>{32, 0, 112, 255, 0, 240, 0, 255}));
  EXPECT_EQ(amplified_difference(a, a).gain, 64);
}

}  // namespace
}  // namespace tessera::accuracy::accuracy_pictures_test
