// Displays over time: phosphors, travelling beams, slow crystals, dithered levels, subfields, ghosts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/framebuffer/screen_support.h"

namespace tessera::screen_time_test {
namespace {

using namespace screen_support;

/// 50 frames per second.
constexpr VideoMode kMode{
    .width = 64,
    .height = 48,
    .timing = ScanTiming{.pixel_clock_hz = 80 * 50 * 50, .total_columns = 80, .total_lines = 50}};
constexpr ScreenView kView{.scale_px_per_mm = 0.4};
constexpr double kFrameMs = 20;

const std::vector<std::uint8_t> kWhite = gray_field(64, 48, 255), kBlack = gray_field(64, 48, 0);

Screen screen_of(const std::string& display, const VideoMode& mode = kMode) {
  return {find_display(display), mode, kView};
}

/// Mean light of each picture over that of the first.
std::vector<double> relative_light(const std::string& display,
                                   const std::vector<const std::vector<std::uint8_t>*>& pictures) {
  Screen screen = screen_of(display);
  std::vector<double> light;
  for (std::size_t frame = 0; frame < pictures.size(); ++frame)
    light.push_back(show(screen, *pictures[frame], static_cast<double>(frame) * kFrameMs).mean(1));
  const double first = light[0];
  for (double& value : light) value /= first;
  return light;
}

TEST(ScreenTime, LongPhosphorsFadeFromFrameToFrame) {
  // Light that is left after a frame: exp(-T ln 10 / t), t the time to a tenth.
  for (const auto& [name, tenth_ms] : {std::pair("p39", 150.0), std::pair("p1", 24.0)}) {
    const double kept = std::pow(10, -kFrameMs / tenth_ms);  // .736 and .147
    const std::vector<double> light = relative_light(std::string("crt:mask=none,black=0,phosphor=") + name,
                                                     {&kWhite, &kBlack, &kBlack, &kBlack});
    // The first black frame still has light of the white one, which was excited line by line.
    EXPECT_NEAR(light[2] / light[1], kept, 1e-4) << name;
    EXPECT_NEAR(light[3] / light[2], kept, 1e-4) << name;
  }
}

TEST(ScreenTime, LightOfAnExcitationAddsUpToThatOfOneFrame) {
  std::vector<const std::vector<std::uint8_t>*> pictures(60, &kBlack);
  pictures[20] = &kWhite;
  for (const char* phosphor : {"p1", "p39"}) {
    Screen screen = screen_of(std::string("crt:mask=none,black=0,phosphor=") + phosphor);
    double sum = 0;
    for (std::size_t frame = 0; frame < pictures.size(); ++frame)
      sum += show(screen, *pictures[frame], static_cast<double>(frame) * kFrameMs).mean(1);
    Screen steady = screen_of(std::string("crt:mask=none,black=0,phosphor=") + phosphor);
    EXPECT_NEAR(sum / show(steady, kWhite, 0).mean(1), 1, 1e-4) << phosphor;
  }
}

TEST(ScreenTime, FramesThatAreNotShownAnewRepeatThePicture) {
  // Three frames of white in one call are as good as three calls.
  Screen each = screen_of("crt:mask=none,phosphor=p39"), skipping = screen_of("crt:mask=none,phosphor=p39");
  show(each, kBlack, 0);
  show(skipping, kBlack, 0);
  for (int frame = 1; frame <= 3; ++frame) show(each, kWhite, frame * kFrameMs);
  show(skipping, kWhite, kFrameMs);
  const LightImage a = show(each, kBlack, 4 * kFrameMs), b = show(skipping, kBlack, 4 * kFrameMs);
  for (std::size_t i = 0; i < a.light.size(); ++i) ASSERT_NEAR(a.light[i], b.light[i], 1e-6f);
}

TEST(ScreenTime, ColourPhosphorsDecayWithinTheFrame) {
  const std::vector<double> light = relative_light("crt:black=0", {&kWhite, &kBlack});
  EXPECT_EQ(light[1], 0);
}

TEST(ScreenTime, ShortExposuresShowTheBeamTravel) {
  // Two milliseconds from 6 ms on: lines 15 to 19 of 50 are scanned.
  const auto lit_rows = [](double time_ms) {
    Screen screen = screen_of("crt:mask=none,black=0,exposure=2,beam=2");
    const LightImage image = show(screen, kWhite, time_ms);
    double sum = 0, weight = 0;
    for (int y = 0; y < image.height; ++y) {
      sum += image.at(image.width / 2, y, 2) * y;  // blue decays fast
      weight += image.at(image.width / 2, y, 2);
    }
    return sum / weight / image.height * 48;  // lines
  };
  EXPECT_NEAR(lit_rows(6), 17, 0.5);
  EXPECT_NEAR(lit_rows(6 + 5 * kFrameMs), 17, 0.5);
  EXPECT_NEAR(lit_rows(12), 32, 0.5);
}

TEST(ScreenTime, ShortExposuresOfAFrameAddUpToIt) {
  for (const char* display : {"crt:mask=none", "plasma"}) {
    Screen whole = screen_of(display);
    const LightImage expected = show(whole, kWhite, 0);
    Screen parts = screen_of(std::string(display) +
                             (display == std::string("crt:mask=none") ? ",exposure=4" : ":exposure=4"));
    std::vector<double> sum(expected.light.size(), 0);
    for (int part = 0; part < 5; ++part) {
      const LightImage image = show(parts, kWhite, 4 * part);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += static_cast<double>(image.light[i]);
    }
    for (std::size_t i = 0; i < sum.size(); ++i) ASSERT_NEAR(sum[i], expected.light[i], 1e-5) << display;
  }
}

TEST(ScreenTime, ExposuresOfOneFrameMayBeginWithinIt) {
  // The rest of the frame and the beginning of the next one, which shows the same picture.
  for (const char* display :
       {"crt:mask=none,exposure=20", "crt:mask=none,phosphor=p39,exposure=20", "plasma:exposure=20"}) {
    Screen from_start = screen_of(display), from_within = screen_of(display);
    const LightImage expected = show(from_start, kWhite, 0), image = show(from_within, kWhite, 7);
    for (std::size_t i = 0; i < image.light.size(); ++i)
      ASSERT_NEAR(image.light[i], expected.light[i], 1e-5f) << display;
  }
}

TEST(ScreenTime, InterlacedFieldsAreScannedInTurn) {
  VideoMode mode = kMode;
  mode.timing->interlaced = true;
  Screen screen({find_display("crt:mask=none,black=0,exposure=10,beam=2")}, mode,
                {.scale_px_per_mm = 4, .x_mm = 100, .y_mm = 50, .width_mm = 2, .height_mm = 100});
  // Light of even and of odd lines in the first half of the frame.
  const LightImage image = show(screen, kWhite, 0);
  double even = 0, odd = 0;
  const double line_mm = screen.height_mm() / 48;
  for (int y = 0; y < image.height; ++y) {
    const double line = (50 + (y + 0.5) / 4) / line_mm - 0.5;
    if (std::abs(line - std::round(line)) > 0.25) continue;
    (static_cast<int>(std::round(line)) % 2 == 0 ? even : odd) += image.at(2, y, 2);
  }
  EXPECT_LT(odd, 0.02 * even);
}

TEST(ScreenTime, CrystalsRespondExponentially) {
  // From black to white: after n frames of T, e^(-n T / tau) is missing; images show the mean over a frame.
  constexpr double kResponse = 50, kTau = kResponse / 2.1972245773362196;  // ln 9
  Screen screen = screen_of("lcd:black=0,response=50");
  Screen fast = screen_of("lcd:black=0");
  const double full = show(fast, kWhite, 0).mean(1);
  show(screen, kBlack, 0);
  for (int frame = 1; frame < 8; ++frame) {
    const double start = (frame - 1) * kFrameMs / kTau, length = kFrameMs / kTau;
    const double expected = 1 - std::exp(-start) * (1 - std::exp(-length)) / length;
    EXPECT_NEAR(show(screen, kWhite, frame * kFrameMs).mean(1) / full, expected, 0.02 * expected) << frame;
  }
}

TEST(ScreenTime, SixBitsDitheredOverFourFramesHaveTheMeanOfEightBits) {
  // With a linear panel, light is the level: 63 steps of 4 levels, 252 at most.
  const auto gray = [](int level) { return gray_field(64, 48, level); };
  Screen screen = screen_of("lcd:bits=6,gamma=1,black=0");
  const double white = show(screen, gray(255), 0).mean(1);
  int time = 1;
  for (int level = 0; level < 256; ++level) {
    double sum = 0;
    std::vector<double> pixel;
    for (int frame = 0; frame < 4; ++frame, ++time)
      sum += show(screen, gray(level), time * kFrameMs).mean(1) / white * 252;
    EXPECT_NEAR(sum / 4, std::min(level, 252), 0.1) << level;
  }
}

TEST(ScreenTime, SubfieldsLightUpInTurn) {
  // The middle of the last subfield, whose weight is half of all, emits; the address period before it does
  // not.
  Screen late = screen_of("plasma:black=0,exposure=1"), early = screen_of("plasma:black=0,exposure=1");
  EXPECT_GT(show(late, kWhite, 18).mean(1), 0.001);
  EXPECT_EQ(show(early, kWhite, 0).mean(1), 0);
}

TEST(ScreenTime, DarkLevelsOfPlasmaShareSteps) {
  // One of 255 steps of light is sRGB's code 13; with a power of 2.2, levels 1 to 15 are nearer to 0.
  Screen screen = screen_of("plasma:black=0");
  const double white = show(screen, kWhite, 0).mean(1);
  const double step = show(screen, gray_field(64, 48, 17), 20).mean(1) / white;
  EXPECT_NEAR(step, 1 / 255.0, 1e-5);
  EXPECT_EQ(show(screen, gray_field(64, 48, 14), 40).mean(1), 0);
  EXPECT_NEAR(show(screen, gray_field(64, 48, 20), 60).mean(1) / white, step, 1e-6);
}

TEST(ScreenTime, FastUpdatesOfPaperLeaveAGhost) {
  const auto light = [](const std::string& display) {
    return relative_light(display, {&kWhite, &kBlack, &kBlack, &kBlack});
  };
  const double black = 0.035 / 0.42;
  EXPECT_NEAR(light("eink")[1], black, 1e-4);
  const std::vector<double> fast = light("eink:update=fast,ghost=0.1");
  EXPECT_NEAR(fast[1], black + 0.1 * (1 - black), 1e-4);
  EXPECT_NEAR(fast[2], black + 0.01 * (1 - black), 1e-4);
}

TEST(ScreenTime, FirstPicturesCountAsShownBefore) {
  for (const char* display : {"crt:mask=none,phosphor=p39", "lcd:response=100", "eink:update=fast"}) {
    Screen screen = screen_of(display);
    const LightImage first = show(screen, kWhite, 0), second = show(screen, kWhite, kFrameMs);
    for (std::size_t i = 0; i < first.light.size(); ++i)
      ASSERT_NEAR(first.light[i], second.light[i], 1e-5f) << display;
  }
}

TEST(ScreenTime, ResetForgetsPictures) {
  for (const char* display : {"crt:mask=none,phosphor=p39", "lcd:response=100", "eink:update=fast"}) {
    Screen screen = screen_of(display), fresh = screen_of(display);
    show(screen, kWhite, 100);
    screen.reset();
    EXPECT_EQ(show(screen, kBlack, 0).light, show(fresh, kBlack, 0).light) << display;
  }
}

}  // namespace
}  // namespace tessera::screen_time_test
