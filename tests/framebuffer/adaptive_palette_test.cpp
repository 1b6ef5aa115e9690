// Palettes of pictures: entries of the hardware, distinct, the same on every instruction set, and good.
#include "framebuffer/adaptive_palette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "framebuffer/converter_colors.h"
#include "framebuffer/distinct_entries.h"
#include "framebuffer/instruction_set.h"
#include "framebuffer/k_means.h"
#include "framebuffer/median_cut.h"
#include "tests/framebuffer/chosen_palette_support.h"

namespace tessera::detail::adaptive_palette_test {
namespace {

using namespace chosen_palette_support;

TEST(AdaptivePalette, EntriesAreDistinctColorsOfTheConverter) {
  for (const int bits : {1, 2, 3, 4, 6, 8})
    for (const std::size_t count : {1u, 2u, 16u, 32u, 256u, 1000u}) {
      const ColorCounts picture = gradients(static_cast<unsigned>(bits));
      const std::vector<Rgb8> entries = adaptive_palette(picture, {count, bits}, InstructionSet::scalar);
      const ConverterColors converter(bits);
      const std::size_t possible = rounded_colors(converter, picture.all()).size();
      EXPECT_EQ(entries.size(), std::min(count, possible)) << bits << " bits";
      EXPECT_EQ(distinct(entries).size(), entries.size()) << bits << " bits";
      for (const Rgb8& entry : entries) EXPECT_TRUE(is_on_converter(entry, bits)) << packed(entry);
    }
}

TEST(AdaptivePalette, HasTheSameEntriesOnEveryInstructionSet) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const ColorCounts picture = gradients(seed);
    const std::vector<Rgb8> scalar = adaptive_palette(picture, {64, 6}, InstructionSet::scalar);
    for (const InstructionSet isa : available_isas())
      EXPECT_EQ(adaptive_palette(picture, {64, 6}, isa), scalar) << static_cast<int>(isa);
  }
}

TEST(AdaptivePalette, IsNeverWorseThanMedianCutAlone) {
  const InstructionSet isa = available_isas().front();
  double plain_ratios = 0;
  int cases = 0;
  for (unsigned seed = 0; seed < 20; ++seed)
    for (const std::size_t count : {8u, 16u, 64u, 256u})
      for (const int bits : {2, 4, 6, 8}) {
        const ColorCounts picture = gradients(seed);
        const std::vector<WeightedColor> colors = picture.at_most(palette_color_limit(count));
        const ColorPoints points(colors);
        const ConverterColors converter(bits);
        if (rounded_colors(converter, colors).size() <= count) continue;
        const std::vector<Rgb8> cut =
            distinct_entries(converter, median_cut(points, count), colors, points, isa);
        const std::vector<Rgb8> entries = adaptive_palette(picture, {count, bits}, isa);
        EXPECT_LE(clustering_error(points, oklab(entries), isa), clustering_error(points, oklab(cut), isa))
            << "seed " << seed << ", " << count << " entries of " << bits << " bits";
        if (bits == 8) {  // without the weights and the scale of the clustering
          plain_ratios += mean_error(picture, entries) / mean_error(picture, cut);
          ++cases;
        }
      }
  EXPECT_LE(plain_ratios / cases, 1);
}

TEST(AdaptivePalette, FewColorsAreKeptExactly) {
  ColorCounts picture;
  picture.add(std::vector<std::uint32_t>{0x102030, 0xffffff, 0xffffff, 0x102030, 0x800000});
  EXPECT_EQ(adaptive_palette(picture, {16, 8}, InstructionSet::scalar),
            (std::vector<Rgb8>{{0x10, 0x20, 0x30}, {0x80, 0, 0}, {255, 255, 255}}));
  EXPECT_EQ(adaptive_palette(picture, {16, 2}, InstructionSet::scalar),
            (std::vector<Rgb8>{{0, 0, 85}, {170, 0, 0}, {255, 255, 255}}));
}

TEST(AdaptivePalette, KeepsTheDarkestAndTheLightestColors) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const ColorCounts picture = gradients(seed);
    double dark = 1, light = 0;
    for (const WeightedColor& c : picture.all()) {
      dark = std::min(dark, oklab_from_rgb8(c.color).l);
      light = std::max(light, oklab_from_rgb8(c.color).l);
    }
    const std::vector<Rgb8> entries = adaptive_palette(picture, {256, 8}, available_isas().front());
    EXPECT_LE(oklab_from_rgb8(entries.front()).l, dark + 0.01) << seed;
    EXPECT_GE(oklab_from_rgb8(entries.back()).l, light - 0.01) << seed;
  }
}

TEST(ConverterRounding, FindsTheNearestColorOfSixtyFour) {
  const ConverterColors converter(2);
  std::mt19937 random(5);
  for (int i = 0; i < 500; ++i) {
    const auto component = [&] { return static_cast<double>(random() % 1000) / 999; };
    const Oklab target = oklab_from_srgb(component(), component(), component());
    double least = 1e300;
    for (int r = 0; r < 4; ++r)
      for (int g = 0; g < 4; ++g)
        for (int b = 0; b < 4; ++b)
          least = std::min(least, squared_distance(oklab_from_rgb8(converter.shown({r, g, b})), target));
    EXPECT_EQ(squared_distance(oklab_from_rgb8(converter.shown(converter.nearest(target))), target), least);
  }
}

}  // namespace
}  // namespace tessera::detail::adaptive_palette_test
