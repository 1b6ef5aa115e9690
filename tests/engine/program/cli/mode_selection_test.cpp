// Names of modes and dithers to compare, and groups of modes that look the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "engine/program/cli/mode_selection.h"

namespace tessera::program::cli::mode_selection_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string error_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ModeSelection, ReadsModesWithParameters) {
  const std::vector<DisplayMode> modes =
      parse_modes("ega,cga:palette=0,intensity=low,640x480x4:color=gray,aspect=2:1,vga");
  ASSERT_EQ(modes.size(), 4u);
  EXPECT_EQ(modes[1].name, "cga:palette=0,intensity=low");
  EXPECT_EQ(modes[2].pixel_aspect.numerator, 2);
  EXPECT_EQ(modes[3].name, "vga");
  EXPECT_THAT(parse_dithers("bayer8,none,bayer8"), ElementsAre(Dither::bayer8, Dither::none));
}

TEST(ModeSelection, RefusesUnknownNames) {
  for (const auto& [text, fragment] : {std::pair{"cga,egaa", "did you mean \"ega\"?"},
                                       {"", "\"\""},
                                       {"cga,", "\"\""},
                                       {"mda", "mode \"mda\" has character cells"},
                                       {"intensity=low", "intensity=low"}})
    EXPECT_THAT(error_of([&] { parse_modes(text); }), HasSubstr(fragment)) << text;
  EXPECT_THAT(error_of([] { parse_dithers("none,bayr8"); }), HasSubstr("did you mean \"bayer8\"?"));
  EXPECT_THAT(error_of([] { parse_dithers(""); }), HasSubstr("found \"\""));
}

TEST(ModeSelection, GroupsModesThatShowTheSamePicture) {
  const std::vector<ModeGroup> all = grouped(modes_with_pixels());
  std::set<std::string> names;
  for (const ModeGroup& group : all) {
    names.insert(group.names.begin(), group.names.end());
    if (group.names.size() > 1) {
      EXPECT_THAT(names_of(group), testing::AnyOf("svga56, svga", "8514a, xga"));
    }
  }
  EXPECT_EQ(names.size() + 1, display_modes().size());  // mda has no pixels
  EXPECT_EQ(all.size() + 2, names.size());
  EXPECT_EQ(grouped(parse_modes("cga,cga")).front().names.size(), 1u);
  // Other colours, bits, shapes, and memory.
  EXPECT_EQ(grouped(parse_modes("cga,cga:background=1,320x200x2,320x200x2:aspect=5:6,320x200x3")).size(), 5u);
}

TEST(OwnPixelsPerDegree, ComesFromAFourteenInchScreenAtHalfAMetre) {
  const auto of = [](const char* name) { return own_pixels_per_degree(display_mode(name)); };
  EXPECT_NEAR(of("vga"), 19.6, 0.05);
  const double degree = 500 * std::tan(std::numbers::pi / 180);
  EXPECT_NEAR(of("vga"), degree * 640 / (0.8 * 14 * 25.4), 1e-12);
  EXPECT_DOUBLE_EQ(of("cga"), of("vga") / 2);
  EXPECT_DOUBLE_EQ(of("ega"), of("vga"));
  EXPECT_DOUBLE_EQ(of("640x320x4"), of("vga"));                           // as wide as the screen
  EXPECT_NEAR(of("480x480x4"), degree * 480 / (0.6 * 14 * 25.4), 1e-12);  // as high as the screen
  EXPECT_EQ(of("8x6x4"), 1);
}

}  // namespace
}  // namespace tessera::program::cli::mode_selection_test
