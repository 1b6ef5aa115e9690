// Palettes that follow pictures: bounds of their moves, and errors near those of palettes of each picture.
#include "framebuffer/smooth_palette.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "framebuffer/instruction_set.h"
#include "tests/framebuffer/chosen_palette_support.h"

namespace tessera::detail::smooth_palette_test {
namespace {

using namespace chosen_palette_support;

TEST(SmoothEntries, MoveLittleAndKeepTheirIndices) {
  const InstructionSet isa = available_isas().front();
  for (const int bits : {2, 4, 6, 8}) {
    SmoothEntries smooth({32, bits}, isa);
    std::vector<Rgb8> before;
    bool any_moved = false;
    for (int frame = 0; frame < 30; ++frame) {
      const std::vector<Rgb8> entries = smooth.follow(gradients(3, frame / 29.0));
      ASSERT_EQ(entries.size(), 32u);
      for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_TRUE(is_on_converter(entries[i], bits));
        any_moved |= !(entries[i] == before[i]);
        if (bits >= 6) {
          EXPECT_LE(squared_distance(oklab_from_rgb8(entries[i]), oklab_from_rgb8(before[i])), 0.02 * 0.02);
        } else {
          const ConverterColors converter(bits);
          const ConverterLevels a = converter.levels_of(before[i]), b = converter.levels_of(entries[i]);
          EXPECT_LE(std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]), 1);
        }
      }
      before = entries;
    }
    EXPECT_TRUE(any_moved) << bits;
  }
}

TEST(SmoothEntries, StayNearThePaletteOfEachPicture) {
  const InstructionSet isa = available_isas().front();
  SmoothEntries smooth({64, 8}, isa);
  double followed = 0, chosen = 0;
  for (int frame = 0; frame < 40; ++frame) {
    const ColorCounts picture = gradients(4, frame / 160.0);
    followed += mean_error(picture, smooth.follow(picture));
    chosen += mean_error(picture, adaptive_palette(picture, {64, 8}, isa));
  }
  EXPECT_LE(followed, 1.1 * chosen);
}

TEST(SmoothEntries, ConvergeToAStillPicture) {
  const InstructionSet isa = available_isas().front();
  SmoothEntries smooth({64, 8}, isa);
  smooth.follow(gradients(6));
  const ColorCounts picture = gradients(7);
  double error = 0;
  for (int frame = 0; frame < 60; ++frame) error = mean_error(picture, smooth.follow(picture));
  EXPECT_LE(error, 2 * mean_error(picture, adaptive_palette(picture, {64, 8}, isa)));
}

TEST(SmoothEntries, RepeatTheColorsOfAPoorPicture) {
  ColorCounts picture;
  picture.add(std::vector<std::uint32_t>{0, 0xffffff});
  SmoothEntries smooth({4, 8}, InstructionSet::scalar);
  EXPECT_EQ(smooth.follow(picture),
            (std::vector<Rgb8>{{0, 0, 0}, {255, 255, 255}, {0, 0, 0}, {255, 255, 255}}));
}

}  // namespace
}  // namespace tessera::detail::smooth_palette_test
