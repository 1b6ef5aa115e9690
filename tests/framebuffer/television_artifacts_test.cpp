// Artifact colours: the 16 patterns of four pixels of CGA's 640x200 mode on a composite monitor.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tests/framebuffer/television_support.h"

namespace tessera::television_artifacts_test {
namespace {

using namespace television_support;

std::string bits_of(unsigned value) {
  std::string bits;
  for (unsigned bit = 8; bit > 0; bit /= 2) bits += (value & bit) != 0 ? '1' : '0';
  return bits;
}

/// Y, U, V of a pattern, and whether it is the same colour in the middle of the row.
ColorValues color_of(unsigned value) {
  const VideoMode mode{.width = 640, .height = 4, .timing = kCgaTiming};
  const Decoded decoded =
      decode(DisplayKind::ntsc, {.decoder = VideoDecoder::notch}, pattern(mode, bits_of(value)));
  const ColorValues mean = decoded.yuv(1, .5, 8);
  for (int k = 0; k < 100; ++k) {
    const ColorValues one = decoded.yuv(2, .4 + .2 * k / 100, 1);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(one[i], mean[i], .01) << bits_of(value);
  }
  return mean;
}

TEST(TelevisionArtifacts, LumaIsTheShareOfWhitePixels) {
  for (unsigned value = 0; value < 16; ++value)
    EXPECT_NEAR(color_of(value)[0], std::popcount(value) / 4.0, .01) << bits_of(value);
}

TEST(TelevisionArtifacts, AlternatePixelsAreTheSameGrey) {
  const ColorValues odd = color_of(0b0101), even = color_of(0b1010);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(odd[i], even[i], 1e-5);
  EXPECT_NEAR(odd[0], .5, 1e-3);
  EXPECT_NEAR(saturation(odd), 0, 1e-5);
  EXPECT_NEAR(saturation(color_of(0)), 0, 1e-5);
  EXPECT_NEAR(saturation(color_of(15)), 0, 1e-5);
}

// sum of p_k exp(-i pi k / 2) / 2: one or three pixels 1/2, two neighbours sqrt(1/2).
TEST(TelevisionArtifacts, TwelvePatternsAreColoured) {
  int coloured = 0;
  std::map<int, std::vector<double>>
      hues;  // by the number of white pixels, as the pattern moves to the right
  for (const unsigned start : {0b1000u, 0b1100u, 0b1110u})
    for (int turn = 0; turn < 4; ++turn) {
      const unsigned value = (start >> turn | start << (4 - turn)) & 15;
      const ColorValues color = color_of(value);
      const int pixels = std::popcount(value);
      EXPECT_NEAR(saturation(color), pixels == 2 ? std::sqrt(.5) : .5, .01) << bits_of(value);
      hues[pixels].push_back(hue(color));
      ++coloured;
    }
  EXPECT_EQ(coloured, 12);
  for (const auto& [pixels, list] : hues)
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(turned(list[(i + 1) % 4], list[i]), -90, 2) << pixels;
  // Two neighbours are between single ones, three opposite to the missing one.
  EXPECT_NEAR(turned(hues[2][0], hues[1][0]), -45, 2);
  EXPECT_NEAR(turned(hues[3][0], hues[1][1]), 0, 2);
}

// IBM's adapter: 1000 is olive, 0100 red, 0010 blue, 0001 green.
TEST(TelevisionArtifacts, HuesAreThoseOfTheAdapter) {
  EXPECT_NEAR(turned(hue(color_of(0b1000)), 180), 0, 2);
  EXPECT_NEAR(turned(hue(color_of(0b0100)), 90), 0, 2);
  EXPECT_NEAR(turned(hue(color_of(0b0010)), 0), 0, 2);
  EXPECT_NEAR(turned(hue(color_of(0b0001)), 270), 0, 2);
}

}  // namespace
}  // namespace tessera::television_artifacts_test
