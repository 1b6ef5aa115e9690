// Dither in light: the functions that are applied before the threshold.
#include "framebuffer/color_dither.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tessera::detail::color_dither_test {
namespace {

long double srgb_light(long double c) {
  return c <= 0.04045L ? c / 12.92L : std::pow((c + 0.055L) / 1.055L, 2.4L);
}

/// The place of c between the levels of b bits, in proportion to their light, in levels.
long double place_by_light(long double c, int bits, double gamma) {
  const auto light = [gamma](long double x) {
    return gamma == 0 ? srgb_light(x) : std::pow(x, static_cast<long double>(gamma));
  };
  const long double levels = (1 << bits) - 1;
  const long double below = std::min(std::floor(c * levels), levels - 1);
  const long double low = light(below / levels), high = light((below + 1) / levels);
  return below + (light(c) - low) / (high - low);
}

TEST(ColorDither, DividesTheStepsOfAComponentByTheirLight) {
  for (const double gamma : {0.0, 1.0, 2.4})
    for (const int bits : {3, 8, 12, 15, 16, 24}) {
      const ColorLayout layout = rgb_layout(bits);
      const ColorDither dither(Dither::bayer8, LightCurve{gamma}, layout, {}, 8);
      const int component_bits[3] = {layout.r_bits, layout.g_bits, layout.b_bits};
      for (std::size_t c = 0; c < 3; ++c)
        for (int i = 0; i <= 5000; ++i) {
          const float value = static_cast<float>(i) / 5000;
          const int levels = (1 << component_bits[c]) - 1;
          // Two thousandths of a step, in the first steps of 8 bits; an eighth of the finest ordered dither.
          EXPECT_NEAR(dither.component(c, value) * static_cast<float>(levels),
                      static_cast<double>(place_by_light(value, component_bits[c], gamma)), 2e-3)
              << value << ", " << bits << " bits, gamma " << gamma;
        }
    }
}

TEST(ColorDither, KeepsTheLevels) {
  for (const int bits : {1, 2}) {
    const ColorDither dither(Dither::blue_noise, LightCurve{}, rgb_layout(bits), {}, 64);
    for (int level = 0; level < 1 << bits; ++level) {
      const float c = static_cast<float>(level) / static_cast<float>((1 << bits) - 1);
      EXPECT_NEAR(dither.component(0, c), c, 1e-6);
    }
  }
  const ColorDither in_levels(Dither::blue_noise, std::nullopt, rgb_layout(15), {}, 64);
  EXPECT_EQ(in_levels.component(1, 0.3f), 0.3f);
}

TEST(ColorDither, MixesSmallPalettesInLightAndSearchesLargeOnes) {
  Palette large{.bits = 9, .entries = {}};
  large.entries.resize(300);
  const ColorDither dither(Dither::bayer4, LightCurve{}, index_layout(9), large, 4);
  for (int i = 0; i <= 1000; ++i) {
    const float c = static_cast<float>(i) / 1000;
    EXPECT_NEAR(dither.component(2, c), static_cast<double>(srgb_light(c)), 1e-6);
  }
  EXPECT_EQ(dither.mixes(), nullptr);
  const ColorDither small(Dither::bayer4, LightCurve{}, index_layout(1), default_palette_of(1), 4);
  ASSERT_NE(small.mixes(), nullptr);
  EXPECT_EQ(small.mixes()->nearest({188, 188, 188}).share, 8) << "half of the light of white";
  EXPECT_EQ(small.spread(), 1);
  EXPECT_FLOAT_EQ(palette_spread(216), 1 / 5.0f);
}

}  // namespace
}  // namespace tessera::detail::color_dither_test
