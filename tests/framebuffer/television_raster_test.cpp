// Lines, samples and subcarrier phases of modes on NTSC and PAL.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "tests/framebuffer/television_support.h"

namespace tessera::television_raster_test {
namespace {

using namespace television_support;
using detail::ScanLine;
using detail::TelevisionRaster;

TelevisionRaster raster(DisplayKind kind, const VideoMode& mode) {
  return {detail::television_system(kind), mode};
}
double turn(double degrees, double from) { return std::remainder(degrees - from, 360.0); }

TEST(TelevisionRaster, CgaHasWholeCyclesAndASamplePerPixel) {
  VideoMode rounded = kCga;
  rounded.timing->pixel_clock_hz = 14.31818e6;  // six digits
  for (const VideoMode& mode : {kCga, rounded}) {
    const TelevisionRaster cga = raster(DisplayKind::ntsc, mode);
    EXPECT_EQ(cga.cycles_per_line(), 228);
    EXPECT_EQ(cga.samples(), 640);
    EXPECT_EQ(cga.samples_per_pixel(), 1);
    for (const std::int64_t frame : {0, 1, 12345})
      for (const int line : {0, 1, 77}) EXPECT_EQ(cga.subcarrier_degrees(frame, line), -90);
  }
}

TEST(TelevisionRaster, OtherTimingsNearTheLineRateAreKept) {
  const VideoMode amiga{
      .width = 320,
      .height = 256,
      .timing = ScanTiming{.pixel_clock_hz = 7.09379e6, .total_columns = 454, .total_lines = 313}};
  const TelevisionRaster pal = raster(DisplayKind::pal, amiga);
  EXPECT_EQ(pal.cycles_per_line(), 283.75);
  EXPECT_EQ(pal.samples_per_pixel(), 2.5);
  EXPECT_EQ(pal.lines(), 313);
  EXPECT_FALSE(pal.interlaced());
  const TelevisionRaster cga_on_pal = raster(DisplayKind::pal, kCga);
  EXPECT_NEAR(cga_on_pal.cycles_per_line(), 4433618.75 * 912 / (4 * kSubcarrierHz), 1e-9);
}

TEST(TelevisionRaster, OtherLineRatesAreBroadcast) {
  const VideoMode vga{
      .width = 640,
      .height = 480,
      .timing = ScanTiming{.pixel_clock_hz = 25.175e6, .total_columns = 800, .total_lines = 525}};
  for (const VideoMode& mode : {vga, VideoMode{.width = 640, .height = 480}}) {
    const TelevisionRaster ntsc = raster(DisplayKind::ntsc, mode), pal = raster(DisplayKind::pal, mode);
    EXPECT_EQ(ntsc.cycles_per_line(), 227.5);
    EXPECT_EQ(ntsc.lines(), 525);
    EXPECT_TRUE(ntsc.interlaced());
    EXPECT_NEAR(ntsc.samples_per_pixel() * 640, 52.7e-6 * 4 * kSubcarrierHz, 1e-9);
    EXPECT_NEAR(pal.cycles_per_line(), 283.7516, 1e-12);
    EXPECT_EQ(pal.lines(), 625);
  }
}

TEST(TelevisionRaster, SubcarrierTurnsWithLinesAndFrames) {
  const VideoMode mode{.width = 640, .height = 480};
  const TelevisionRaster ntsc = raster(DisplayKind::ntsc, mode), pal = raster(DisplayKind::pal, mode);
  for (const std::int64_t frame : {0, 1, 1'000'000}) {
    EXPECT_NEAR(std::abs(turn(ntsc.subcarrier_degrees(frame, 8), ntsc.subcarrier_degrees(frame, 7))), 180,
                1e-6);
    EXPECT_NEAR(std::abs(turn(ntsc.subcarrier_degrees(frame + 1, 7), ntsc.subcarrier_degrees(frame, 7))), 180,
                1e-6);
    EXPECT_NEAR(turn(pal.subcarrier_degrees(frame, 8), pal.subcarrier_degrees(frame, 7)), 360 * .7516 - 360,
                1e-6);
    EXPECT_NEAR(turn(pal.subcarrier_degrees(frame + 1, 7), pal.subcarrier_degrees(frame, 7)), -90, 1e-6);
    EXPECT_EQ(pal.v_sign(frame, 8), -pal.v_sign(frame, 7));
    EXPECT_EQ(pal.v_sign(frame + 1, 7), -pal.v_sign(frame, 7));
    EXPECT_EQ(ntsc.v_sign(frame, 7), 1);
  }
}

TEST(TelevisionRaster, LinesBeforeARowAreOfItsField) {
  const TelevisionRaster interlaced = raster(DisplayKind::ntsc, {.width = 640, .height = 480});
  EXPECT_EQ(interlaced.line_before_row(7, 1), interlaced.line_of_row(5));
  EXPECT_EQ(interlaced.line_before_row(7, 2), interlaced.line_of_row(3));
  EXPECT_EQ(interlaced.line_before_row(1, 1), (ScanLine{interlaced.line_of_row(1).number - 1, 1}));
  EXPECT_EQ(interlaced.line_before_row(2, 2), (ScanLine{interlaced.line_of_row(0).number - 1, 0}));
  const TelevisionRaster progressive = raster(DisplayKind::ntsc, kCga);
  EXPECT_EQ(progressive.line_before_row(7, 1), progressive.line_of_row(6));
  VideoMode doubled = kCga;
  doubled.height = 100;
  doubled.timing->lines_per_row = 2;
  const TelevisionRaster repeated = raster(DisplayKind::ntsc, doubled);
  EXPECT_EQ(repeated.line_before_row(7, 1), repeated.line_of_row(6, 1));
  EXPECT_EQ(repeated.line_before_row(7, 2), repeated.line_of_row(6));
}

}  // namespace
}  // namespace tessera::television_raster_test
