// Levels, phases and sync of encoded frames, against the figures of SMPTE 170M and BT.470.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "tests/framebuffer/television_support.h"

namespace tessera::television_signal_test {
namespace {

using namespace television_support;

struct BarRow {
  const char* name;
  double ntsc_luma_ire, ntsc_chroma_ire, pal_luma_mv, pal_chroma_mv, phase_degrees;
};
/// Published levels of 75 % bars; chroma peak to peak.
constexpr BarRow kBarTable[] = {
    {"white", 76.88, 0, 525.0, 0, 0},
    {"yellow", 68.97, 62.07, 465.1, 469.7, 167.08},
    {"cyan", 56.13, 87.74, 368.0, 663.9, 283.46},
    {"green", 48.22, 81.93, 308.2, 620.0, 240.71},
    {"magenta", 36.15, 81.93, 216.8, 620.0, 60.71},
    {"red", 28.24, 87.74, 157.0, 663.9, 103.46},
    {"blue", 15.41, 62.07, 59.9, 469.7, 347.08},
    {"black", 7.5, 0, 0, 0, 0},
};

VideoSignal signal_of(DisplayKind kind, const Television& television, const Picture& picture,
                      double time_ms = 0) {
  Display display{.kind = kind};
  display.television = television;
  return video_signal(display, picture.mode, {.rgb = picture.rgb}, time_ms);
}

const float* line_of(const VideoSignal& signal, int line) {
  return signal.samples.data() + std::ptrdiff_t{line} * signal.samples_per_line;
}

/// Eight cycles of burst.
std::complex<double> burst_of(const VideoSignal& signal, const float* line) {
  const double start_us = signal.unit == "IRE" ? 5.31 : 5.6;
  return subcarrier_at(line, static_cast<int>(std::lround(start_us * 1e-6 * signal.sample_rate_hz)), 32);
}

/// V has its sign on even lines of frame 0.
int v_sign(DisplayKind kind, int line) { return kind == DisplayKind::pal && line % 2 != 0 ? -1 : 1; }

/// The middle of a bar: 24 samples.
int bar_sample(const VideoSignal& signal, int bar) {
  const double left = (bar + .5) / 8 * 640 * signal.samples_per_pixel;
  return signal.first_sample + static_cast<int>(left) - 12;
}

void expect_bars(DisplayKind kind, const VideoSignal& signal, int row) {
  const bool is_pal = kind == DisplayKind::pal;
  const int line = signal.row_lines[static_cast<std::size_t>(row)];
  const float* samples = line_of(signal, line);
  const double burst_degrees = is_pal ? 180 - 45 * v_sign(kind, line) : 180;
  const std::complex<double> burst = burst_of(signal, samples);
  EXPECT_NEAR(2 * std::abs(burst), is_pal ? 300 : 40, is_pal ? .3 : .04);
  for (int bar = 0; bar < 8; ++bar) {
    const BarRow& expected = kBarTable[bar];
    const double luma = mean_at(samples, bar_sample(signal, bar), 24);
    const std::complex<double> chroma = subcarrier_at(samples, bar_sample(signal, bar), 24);
    const double tolerance = is_pal ? 4 : .5;
    EXPECT_NEAR(luma, is_pal ? expected.pal_luma_mv : expected.ntsc_luma_ire, tolerance) << expected.name;
    const double chroma_expected = is_pal ? expected.pal_chroma_mv : expected.ntsc_chroma_ire;
    EXPECT_NEAR(2 * std::abs(chroma), chroma_expected, tolerance) << expected.name;
    if (chroma_expected == 0) continue;
    const double phase = degrees_of(chroma) - degrees_of(burst) + burst_degrees;
    EXPECT_NEAR(turned(phase, v_sign(kind, line) * expected.phase_degrees), 0, .5)
        << expected.name << ", line " << line;
  }
}

TEST(TelevisionSignal, NtscBarsHaveThePublishedLevelsAndPhases) {
  const VideoSignal signal = signal_of(DisplayKind::ntsc, {}, bars({.width = 640, .height = 480}));
  EXPECT_EQ(signal.samples_per_line, 910);
  EXPECT_EQ(signal.lines, 525);
  EXPECT_EQ(signal.unit, "IRE");
  for (const int row : {0, 1, 2, 3, 240, 479}) expect_bars(DisplayKind::ntsc, signal, row);
}

TEST(TelevisionSignal, PalBarsHaveThePublishedLevelsAndPhases) {
  const VideoSignal signal = signal_of(DisplayKind::pal, {}, bars({.width = 640, .height = 576}));
  EXPECT_EQ(signal.samples_per_line, 1135);
  EXPECT_EQ(signal.lines, 625);
  EXPECT_EQ(signal.unit, "mV");
  for (const int row : {0, 1, 2, 3, 240, 575}) expect_bars(DisplayKind::pal, signal, row);
}

// NTSC's pictures begin in lines 23 and 286, counted from 1; PAL's in 22 and 335, so that 288 lines end
// before the half line 623.
TEST(TelevisionSignal, RowsAreLinesOfTwoFields) {
  const VideoSignal ntsc = signal_of(DisplayKind::ntsc, {}, bars({.width = 64, .height = 480}));
  EXPECT_EQ(std::vector(ntsc.row_lines.begin(), ntsc.row_lines.begin() + 4), (std::vector{22, 285, 23, 286}));
  const VideoSignal pal = signal_of(DisplayKind::pal, {}, bars({.width = 64, .height = 576}));
  EXPECT_EQ(std::vector(pal.row_lines.begin(), pal.row_lines.begin() + 4), (std::vector{21, 334, 22, 335}));
  const VideoSignal tall = signal_of(DisplayKind::ntsc, {}, bars({.width = 64, .height = 768}));
  EXPECT_EQ(tall.lines, 813);
  EXPECT_LT(tall.row_lines.back(), tall.lines);
}

TEST(TelevisionSignal, SetupMovesBlackAndKeepsWhite) {
  const Picture picture = bars({.width = 640, .height = 8});
  for (const double setup : {0.0, 7.5, 10.0}) {
    const VideoSignal signal = signal_of(DisplayKind::ntsc, {.setup_ire = setup}, picture);
    const float* line = line_of(signal, signal.row_lines[0]);
    const double white = 191.0 / 255;
    EXPECT_NEAR(mean_at(line, bar_sample(signal, 7), 24), setup, .05);
    EXPECT_NEAR(mean_at(line, bar_sample(signal, 0), 24), setup + (100 - setup) * white, .05);
  }
}

TEST(TelevisionSignal, LinesBeginWithSyncAndFieldsWithBroadPulses) {
  for (const DisplayKind kind : {DisplayKind::ntsc, DisplayKind::pal}) {
    const bool is_pal = kind == DisplayKind::pal;
    const VideoSignal signal = signal_of(kind, {}, bars({.width = 640, .height = is_pal ? 576 : 480}));
    const double sync = is_pal ? -300 : -40;
    std::vector<double> low_us;  // time at the level of sync in each line
    for (int line = 0; line < signal.lines; ++line) {
      EXPECT_NEAR(line_of(signal, line)[4], sync, 1e-4) << line;
      double low = 0;
      // Chroma does not reach nine tenths of sync.
      for (int i = 0; i < signal.samples_per_line; ++i)
        low += std::clamp(static_cast<double>(line_of(signal, line)[i]) / sync, 0.0, 1.0) > .9 ? 1 : 0;
      low_us.push_back(low / signal.sample_rate_hz * 1e6);
    }
    EXPECT_NEAR(low_us[100], 4.7, .1);
    // Six broad pulses of 27.1 us are three lines; five of 27.3 us two and a half.
    const int first = is_pal ? 0 : 3;
    EXPECT_NEAR(low_us[static_cast<std::size_t>(first)], is_pal ? 54.6 : 54.2, .2);
    EXPECT_NEAR(low_us[static_cast<std::size_t>(first + 2)], is_pal ? 27.3 + 2.35 : 54.2, .2);
    // The second field is half a line later.
    EXPECT_NEAR(low_us[is_pal ? 312 : 265], is_pal ? 2.35 + 27.3 : 2.3 + 27.1, .2);
  }
}

TEST(TelevisionSignal, SVideoHasChromaAndBurstOnTheSecondWire) {
  const Picture picture = bars({.width = 640, .height = 8});
  const VideoSignal composite = signal_of(DisplayKind::ntsc, {}, picture);
  const VideoSignal svideo = signal_of(DisplayKind::ntsc, {.cable = VideoCable::svideo}, picture);
  EXPECT_TRUE(composite.chroma.empty());
  ASSERT_EQ(svideo.chroma.size(), composite.samples.size());
  for (std::size_t i = 0; i < composite.samples.size(); ++i)
    ASSERT_NEAR(svideo.samples[i] + svideo.chroma[i], composite.samples[i], 1e-4) << i;
  const float* luma = line_of(svideo, svideo.row_lines[0]);
  EXPECT_NEAR(std::abs(burst_of(svideo, luma)), 0, 1e-4);
  EXPECT_NEAR(std::abs(subcarrier_at(luma, bar_sample(svideo, 5), 24)), 0, .02);
}

// 262 lines of 228 cycles.
TEST(TelevisionSignal, CgaKeepsItsTiming) {
  const VideoSignal signal = signal_of(DisplayKind::ntsc, {}, bars(kCga));
  EXPECT_EQ(signal.samples_per_line, 912);
  EXPECT_EQ(signal.lines, 262);
  EXPECT_EQ(signal.samples_per_pixel, 1);
  for (const int row : {0, 1, 100}) expect_bars(DisplayKind::ntsc, signal, row);
  EXPECT_EQ(signal.samples, signal_of(DisplayKind::ntsc, {}, bars(kCga), 1.5 * 1000 / 59.923).samples);
}

TEST(TelevisionSignal, PhaseErrorAndGainActOnChromaAlone) {
  const Picture picture = bars({.width = 640, .height = 8});
  const VideoSignal signal = signal_of(DisplayKind::ntsc, {.phase_deg = 25, .gain = .5}, picture);
  const float* line = line_of(signal, signal.row_lines[0]);
  const std::complex<double> red = subcarrier_at(line, bar_sample(signal, 5), 24);
  EXPECT_NEAR(2 * std::abs(red), 87.74 / 2, .3);
  EXPECT_NEAR(turned(degrees_of(red) - degrees_of(burst_of(signal, line)) + 180, 103.46 + 25), 0, .5);
  EXPECT_NEAR(2 * std::abs(burst_of(signal, line)), 40, .04);
}

// The mode has 60 frames per second; the subcarrier's sign changes from frame to frame.
TEST(TelevisionSignal, TimeSelectsTheFrame) {
  const Picture picture = bars({.width = 640, .height = 8});
  const VideoSignal first = signal_of(DisplayKind::ntsc, {}, picture);
  EXPECT_EQ(signal_of(DisplayKind::ntsc, {}, picture, 16.6).samples, first.samples);
  EXPECT_EQ(signal_of(DisplayKind::ntsc, {}, picture, 2000 / 60.0).samples, first.samples);
  const VideoSignal second = signal_of(DisplayKind::ntsc, {}, picture, 1000 / 60.0);
  const int line = first.row_lines[0];
  const std::complex<double> red = subcarrier_at(line_of(first, line), bar_sample(first, 5), 24);
  EXPECT_NEAR(std::abs(red + subcarrier_at(line_of(second, line), bar_sample(first, 5), 24)), 0, 1e-3);
}

TEST(TelevisionSignal, RefusesDisplaysWithoutSignalAndWrongInput) {
  const Picture picture = bars({.width = 64, .height = 8});
  EXPECT_THROW(signal_of(DisplayKind::crt, {}, picture), DisplayError);
  EXPECT_THROW(signal_of(DisplayKind::ntsc, {.gain = 5}, picture), DisplayError);
  for (const double time_ms : {-1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THROW(signal_of(DisplayKind::ntsc, {}, picture, time_ms), DisplayError);
  EXPECT_THROW(signal_of(DisplayKind::ntsc, {}, {{.width = 0, .height = 8}, {}}), DisplayError);
  const VideoMode without_clock{.width = 64, .height = 8, .timing = ScanTiming{}};
  EXPECT_THROW(signal_of(DisplayKind::ntsc, {}, {without_clock, picture.rgb}), DisplayError);
  const Display display{.kind = DisplayKind::pal};
  EXPECT_THROW(video_signal(display, {.width = 65, .height = 8}, {.rgb = picture.rgb}), DisplayError);
}

}  // namespace
}  // namespace tessera::television_signal_test
