// Resizing of pictures by areas, in linear light.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "engine/program/imageio/area_resample.h"

namespace tessera::program::area_resample_test {
namespace {

Picture noise(int width, int height) {
  std::mt19937 random(5);
  Picture picture(width, height);
  for (std::uint8_t& component : picture.rgba) component = static_cast<std::uint8_t>(random());
  return picture;
}

std::size_t at(const Picture& picture, int x, int y) {
  return 4 * static_cast<std::size_t>(y * picture.width + x);
}

double light_of(std::uint8_t level) {
  const double c = level / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

TEST(AreaResampled, AveragesLightNotLevels) {
  Picture checkerboard(2, 2);
  checkerboard.rgba = {0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 255, 255, 0, 0, 0, 255};
  const Picture mean = area_resampled(checkerboard, 1, 1);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(mean.rgba[c], 188);
  EXPECT_EQ(mean.rgba[3], 255);
}

TEST(AreaResampled, KeepsEveryLevel) {
  Picture levels(256, 1);
  for (std::size_t i = 0; i < levels.rgba.size(); ++i)
    levels.rgba[i] = static_cast<std::uint8_t>(i % 4 == 3 ? 255 : i / 4);
  EXPECT_EQ(area_resampled(levels, 256, 1).rgba, levels.rgba);
}

TEST(AreaResampled, ReplicatesPixelsByWholeFactors) {
  const Picture small = noise(5, 4);
  const Picture large = area_resampled(small, 15, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 15; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_EQ(large.rgba[at(large, x, y) + c], small.rgba[at(small, x / 3, y / 2) + c]) << x << " " << y;
}

/// Each pixel of the result is sampled at the centres of a fine grid that both sizes divide.
TEST(AreaResampled, AgreesWithSamplingOnAFineGrid) {
  const Picture source = noise(12, 10);
  for (const auto& [width, height] : {std::pair{8, 15}, {9, 4}, {25, 3}, {12, 10}}) {
    const Picture result = area_resampled(source, width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          double light = 0;
          for (int v = 0; v < 10; ++v)
            for (int u = 0; u < 12; ++u) {
              const int from_x = (2 * (12 * x + u) + 1) * 12 / (2 * 12 * width);
              const int from_y = (2 * (10 * y + v) + 1) * 10 / (2 * 10 * height);
              light += light_of(source.rgba[at(source, from_x, from_y) + c]) / 120;
            }
          ASSERT_NEAR(light_of(result.rgba[at(result, x, y) + c]), light, 0.005)
              << width << "x" << height << ": " << x << " " << y;
        }
  }
}

}  // namespace
}  // namespace tessera::program::area_resample_test
