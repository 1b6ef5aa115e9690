// Palettes of ramps: shares by length, ends, colours of the hardware.
#include "framebuffer/ramp_palette.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "framebuffer/instruction_set.h"
#include "tests/framebuffer/chosen_palette_support.h"

namespace tessera::detail::ramp_palette_test {
namespace {

using namespace chosen_palette_support;

TEST(RampPalette, SharesEntriesByLength) {
  // Greys from black to white, 1 long in OKLab, and from 0.5 to white, about 0.4 long.
  const std::vector<ColorRamp> ramps = {{{0, 0, 0}, {1, 1, 1}}, {{0.5, 0, 0}, {0.5, 0.5, 0.5}}};
  for (const int bits : {4, 6, 8}) {
    const std::vector<Rgb8> entries = ramp_palette(ramps, {12, bits}, InstructionSet::scalar);
    EXPECT_LE(entries.size(), 12u);
    EXPECT_GE(entries.size(), 10u);
    std::size_t greys = 0;
    for (const Rgb8& entry : entries) {
      EXPECT_TRUE(is_on_converter(entry, bits));
      greys += entry.r == entry.g && entry.g == entry.b;
    }
    EXPECT_GT(greys, entries.size() / 2);
    EXPECT_EQ(entries.front(), (Rgb8{0, 0, 0}));
    EXPECT_EQ(entries.back(), (Rgb8{255, 255, 255}));
  }
}

TEST(RampPalette, EvenSpacingHasEqualDistances) {
  const std::vector<Rgb8> entries = ramp_palette({{{0, 0, 0}, {1, 1, 1}}}, {11, 8}, InstructionSet::scalar);
  ASSERT_EQ(entries.size(), 11u);
  for (std::size_t i = 1; i < entries.size(); ++i)
    EXPECT_NEAR(oklab_from_rgb8(entries[i]).l - oklab_from_rgb8(entries[i - 1]).l, 0.1, 0.035) << i;
}

TEST(RampPalette, HasAllColorsOfShortRamps) {
  const std::vector<Rgb8> entries =
      ramp_palette({{{0, 0, 0}, {1.0 / 3, 0, 0}}, {{1, 1, 1}}}, {16, 2}, InstructionSet::scalar);
  EXPECT_EQ(entries, (std::vector<Rgb8>{{0, 0, 0}, {85, 0, 0}, {255, 255, 255}}));
}

TEST(RampPalette, MoreEndsThanEntriesGiveFewerColors) {
  std::vector<ColorRamp> ramps;
  for (int i = 0; i < 30; ++i) ramps.push_back({{0, i / 60.0, i / 30.0}, {1, 1 - i / 30.0, 0.5}});
  const std::vector<Rgb8> entries = ramp_palette(ramps, {16, 6}, available_isas().front());
  EXPECT_EQ(entries.size(), 16u);
  EXPECT_EQ(distinct(entries).size(), 16u);
}

}  // namespace
}  // namespace tessera::detail::ramp_palette_test
