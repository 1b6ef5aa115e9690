// Resolution from diagonal and dot pitch, against the table of the specification.
#include "engine/tessera/screen_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/tessera/display_mode.hpp"

namespace tessera::screen_geometry_test {
namespace {

TEST(ScreenGeometry, ChoosesTheStandardModesOfTheTable) {
  const struct {
    double diagonal, width, height;
    int columns[3];  // theoretical, at 0.39, 0.28, 0.22 mm
    int mode_width[3];
  } kTable[] = {
      {14, 11.2, 8.4, {729, 1016, 1293}, {800, 1024, 1280}},
      {15, 12.0, 9.0, {782, 1089, 1385}, {800, 1024, 1280}},
      {17, 13.6, 10.2, {886, 1234, 1570}, {800, 1280, 1600}},
      {19, 15.2, 11.4, {990, 1379, 1755}, {1024, 1280, 1920}},
      {21, 16.8, 12.6, {1094, 1524, 1940}, {1024, 1600, 1920}},
  };
  constexpr double kPitches[3] = {0.39, 0.28, 0.22};
  for (const auto& row : kTable)
    for (int i = 0; i < 3; ++i) {
      const ScreenResolution screen = screen_resolution(row.diagonal, kPitches[i]);
      EXPECT_NEAR(screen.width_in, row.width, 1e-12);
      EXPECT_NEAR(screen.height_in, row.height, 1e-12);
      EXPECT_EQ(std::lround(screen.columns), row.columns[i]) << row.diagonal << " " << kPitches[i];
      EXPECT_NEAR(screen.rows, screen.columns * 3 / 4, 1e-9);
      EXPECT_EQ(screen.mode_width, row.mode_width[i]) << row.diagonal << " " << kPitches[i];
      EXPECT_EQ(screen.mode_height, screen.mode_width == 1280 ? 1024 : screen.mode_width * 3 / 4);
    }
  EXPECT_EQ(screen_resolution(1, 1).mode_width, 640);
  EXPECT_EQ(screen_resolution(100, 0.1).mode_width, 1920);
}

TEST(ScreenGeometry, ModesAreSharpWhereTheyHaveADotPerPixel) {
  for (const char* const name : {"vga", "xga", "sxga", "hercules", "cga-hi"}) {
    const DisplayMode mode = display_mode(name);
    const double diagonal = sharp_diagonal_in(mode, 0.28);
    const ScreenResolution just = screen_resolution(diagonal * (1 + 1e-9), 0.28);
    const ScreenResolution smaller = screen_resolution(diagonal * (1 - 1e-9), 0.28);
    EXPECT_TRUE(just.columns >= mode.width && just.rows >= mode.height) << name;
    EXPECT_TRUE(smaller.columns < mode.width || smaller.rows < mode.height) << name;
  }
}

TEST(ScreenGeometry, RefusesLengthsOfZero) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double wrong : {0.0, -1.0, infinity, std::nan("")}) {
    EXPECT_THROW(screen_resolution(wrong, 0.28), Error) << wrong;
    EXPECT_THROW(screen_resolution(17, wrong), Error) << wrong;
    EXPECT_THROW(sharp_diagonal_in(display_mode("vga"), wrong), Error) << wrong;
  }
  EXPECT_THROW(screen_resolution(1e300, 1e-300), Error);
  EXPECT_THROW(sharp_diagonal_in(DisplayMode{.width = 0}, 0.28), Error);
}

}  // namespace
}  // namespace tessera::screen_geometry_test
