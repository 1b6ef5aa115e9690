// Receivers: what they make of flat areas, phase errors, gratings and the edges of colours.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "tests/framebuffer/television_support.h"

namespace tessera::television_decoder_test {
namespace {

using namespace television_support;
using enum DisplayKind;

const VideoMode kBroadcast{.width = 640, .height = 12};
constexpr Level kRed{191, 0, 0};

struct Receiver {
  std::string name;
  DisplayKind kind;
  Television television;
  VideoMode mode = kBroadcast;
};
std::vector<Receiver> receivers() {
  std::vector<Receiver> list;
  for (const VideoCable cable : {VideoCable::composite, VideoCable::svideo}) {
    const std::string suffix = cable == VideoCable::svideo ? ", S-Video" : "";
    const auto add = [&](const std::string& name, DisplayKind kind, VideoDecoder decoder) {
      list.push_back({name + suffix, kind, {.cable = cable, .decoder = decoder}});
    };
    add("ntsc notch", ntsc, VideoDecoder::notch);
    add("ntsc comb", ntsc, VideoDecoder::comb);
    add("pal notch", pal, VideoDecoder::notch);
    add("pal simple", pal, VideoDecoder::simple);
    add("pal comb", pal, VideoDecoder::comb);
    add("pal delay line", pal, VideoDecoder::delay_line);
  }
  list.push_back({"cga", ntsc, {}, {.width = 640, .height = 12, .timing = kCgaTiming}});
  list.push_back({"cga comb",
                  ntsc,
                  {.decoder = VideoDecoder::comb},
                  {.width = 640, .height = 12, .timing = kCgaTiming}});
  list.push_back({"cga pal", pal, {}, {.width = 640, .height = 12, .timing = kCgaTiming}});
  return list;
}

Picture flat(const Level& level) {
  return make_picture(kBroadcast, [&](int, int) { return level; });
}

TEST(TelevisionDecoder, FlatAreasKeepLumaSaturationAndHue) {
  for (const Receiver& receiver : receivers())
    for (const std::int64_t frame : {0, 1, 3, 1'000'003}) {
      const Decoded decoded = decode(receiver.kind, receiver.television, bars(receiver.mode), frame);
      for (int row = 0; row < receiver.mode.height; ++row)
        for (int bar = 0; bar < 8; ++bar) {
          const ColorValues expected = yuv_of(kBars[static_cast<std::size_t>(bar)]);
          // Single samples, so that neither dots nor ripple average out.
          for (int offset = -4; offset <= 4; ++offset) {
            const double position = (bar + .5) / 8 + static_cast<double>(offset) / decoded.samples;
            const ColorValues found = decoded.yuv(row, position, 1);
            const std::string where =
                receiver.name + ", row " + std::to_string(row) + ", bar " + std::to_string(bar);
            ASSERT_NEAR(found[0], expected[0], .005) << where;
            ASSERT_NEAR(saturation(found), saturation(expected), .001) << where;
            if (saturation(expected) > .01) {
              ASSERT_NEAR(turned(hue(found), hue(expected)), 0, .1) << where;
            }
          }
        }
    }
}

TEST(TelevisionDecoder, PhaseErrorsTurnNtscHues) {
  for (const VideoDecoder decoder : {VideoDecoder::notch, VideoDecoder::comb})
    for (const double degrees : {-30.0, 10.0, 40.0}) {
      const Decoded decoded = decode(ntsc, {.decoder = decoder, .phase_deg = degrees}, flat(kRed));
      for (int row = 0; row < kBroadcast.height; ++row) {
        const ColorValues found = decoded.yuv(row, .5);
        EXPECT_NEAR(turned(hue(found), hue(yuv_of(kRed))), degrees, 1);
        EXPECT_NEAR(saturation(found) / saturation(yuv_of(kRed)), 1, .02);
      }
    }
}

TEST(TelevisionDecoder, PhaseErrorsCostPalWithDelayLineSaturationOnly) {
  for (const double degrees : {-30.0, 10.0, 40.0}) {
    const Decoded decoded = decode(pal, {.phase_deg = degrees}, flat(kRed));
    for (int row = 0; row < kBroadcast.height; ++row) {
      const ColorValues found = decoded.yuv(row, .5);
      EXPECT_NEAR(turned(hue(found), hue(yuv_of(kRed))), 0, 1);
      EXPECT_NEAR(saturation(found) / saturation(yuv_of(kRed)), std::cos(degrees * std::numbers::pi / 180),
                  .02);
    }
  }
}

// Rows of one field are lines in the order of time: rows 0, 2, 4 ...
TEST(TelevisionDecoder, PhaseErrorsTurnLinesOfSimplePalAlternately) {
  for (const VideoDecoder decoder : {VideoDecoder::simple, VideoDecoder::notch, VideoDecoder::comb}) {
    const Decoded decoded = decode(pal, {.decoder = decoder, .phase_deg = 20}, flat(kRed));
    const auto turn = [&](int row) { return turned(hue(decoded.yuv(row, .5)), hue(yuv_of(kRed))); };
    for (int row = 0; row + 2 < kBroadcast.height; ++row) {
      EXPECT_NEAR(std::abs(turn(row)), 20, 1);
      EXPECT_NEAR(turn(row + 2), -turn(row), 1);
    }
  }
}

/// Largest saturation in the middle half of a row.
double most_color(const Decoded& decoded, int row) {
  double most = 0;
  for (int k = decoded.samples / 4; k < decoded.samples * 3 / 4; ++k)
    most = std::max(most, saturation(decoded.yuv(row, (k + .5) / decoded.samples, 1)));
  return most;
}
/// Half of the difference between the largest and the smallest luma in the middle half of a row.
double luma_swing(const Decoded& decoded, int row) {
  double least = 10, most = -10;
  for (int k = decoded.samples / 4; k < decoded.samples * 3 / 4; ++k) {
    const double luma = decoded.yuv(row, (k + .5) / decoded.samples, 1)[0];
    least = std::min(least, luma);
    most = std::max(most, luma);
  }
  return (most - least) / 2;
}

// Two pixels white, two black: 3.58 MHz on CGA, with an amplitude of 0.707.
TEST(TelevisionDecoder, FineGratingTurnsColouredOnComposite) {
  const Picture grating = pattern(kCga, "1100");
  const Decoded composite = decode(ntsc, {}, grating);
  EXPECT_GT(most_color(composite, 9), .6);
  EXPECT_LT(luma_swing(composite, 9), .02);
  const Decoded svideo = decode(ntsc, {.cable = VideoCable::svideo}, grating);
  EXPECT_LT(most_color(svideo, 9), 1e-5);
  EXPECT_NEAR(luma_swing(svideo, 9), .5, .02);
}

// A grating that is upright has the same phase on all lines; the comb tells it from chroma.
TEST(TelevisionDecoder, CombKeepsUprightGratings) {
  // 754.6 samples of 640 pixels: 3.39 pixels per cycle of the subcarrier.
  const auto wave = [](int x, int) {
    const double sine = std::sin(2 * std::numbers::pi * x * 754.557 / 640 / 4);
    const auto level = static_cast<std::uint8_t>(std::lround(127.5 + 100 * sine));
    return Level{level, level, level};
  };
  const Picture grating = make_picture(kBroadcast, wave);
  const Decoded notch = decode(ntsc, {.decoder = VideoDecoder::notch}, grating);
  EXPECT_GT(most_color(notch, 6), .2);
  EXPECT_LT(luma_swing(notch, 6), .03);
  const Decoded comb = decode(ntsc, {.decoder = VideoDecoder::comb}, grating);
  EXPECT_LT(most_color(comb, 6), .01);
  EXPECT_GT(luma_swing(comb, 6), .25);
}

/// Luma of all samples of a row.
std::vector<double> luma_of(const Decoded& decoded, int row) {
  std::vector<double> luma;
  for (int k = 0; k < decoded.samples; ++k)
    luma.push_back(yuv_from_rgb({decoded.at(row, 0, k), decoded.at(row, 1, k), decoded.at(row, 2, k)})[0]);
  return luma;
}

struct Dots {
  double amplitude = 0;  ///< largest in one frame
  double mean = 0;       ///< largest in the mean of two frames
};
/// Dots: luma of the frame less that of a signal without chroma.
Dots dots_of(DisplayKind kind, const VideoMode& mode, std::int64_t first, std::int64_t second) {
  const int row = 6;
  const Picture picture = bars(mode);
  const std::vector<double> without = luma_of(decode(kind, {.gain = 0}, picture), row);
  const std::vector<double> a = luma_of(decode(kind, {}, picture, first), row);
  const std::vector<double> b = luma_of(decode(kind, {}, picture, second), row);
  Dots dots;
  for (std::size_t k = 0; k < without.size(); ++k) {
    dots.amplitude = std::max(dots.amplitude, std::abs(a[k] - without[k]));
    dots.mean = std::max(dots.mean, std::abs((a[k] + b[k]) / 2 - without[k]));
  }
  return dots;
}

TEST(TelevisionDecoder, DotsAtEdgesChangeTheirSignWithTheFrame) {
  const Dots frames = dots_of(ntsc, kBroadcast, 0, 1);
  EXPECT_GT(frames.amplitude, .05);
  EXPECT_LT(frames.mean, .1 * frames.amplitude);
  // PAL turns by a quarter of a cycle per frame.
  const Dots pal_frames = dots_of(pal, kBroadcast, 0, 2);
  EXPECT_GT(pal_frames.amplitude, .05);
  EXPECT_LT(pal_frames.mean, .1 * pal_frames.amplitude);
  EXPECT_GT(dots_of(pal, kBroadcast, 0, 1).mean, .4 * pal_frames.amplitude);
}

TEST(TelevisionDecoder, DotsOfCgaStandStill) {
  const Picture picture = bars(kCga);
  const Decoded first = decode(ntsc, {}, picture, 0), second = decode(ntsc, {}, picture, 1);
  EXPECT_EQ(first.values, second.values);
  for (int component = 0; component < 3; ++component)
    for (int k = 0; k < first.samples; ++k)
      ASSERT_EQ(first.at(0, component, k), first.at(1, component, k)) << "rows differ";
}

}  // namespace
}  // namespace tessera::television_decoder_test
