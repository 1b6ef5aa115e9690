// Close-ups of screens.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "engine/program/cli/close_up.h"
#include "engine/tessera/display_mode.hpp"

namespace tessera::program::cli::close_up_test {
namespace {

VideoMode video_mode(std::string_view name) {
  const DisplayMode mode = display_mode(std::string(name));
  return {.width = mode.width,
          .height = mode.height,
          .pixel_aspect = mode.pixel_aspect.value(),
          .timing = mode.timing};
}

ScreenSize size_of(const Display& display, const VideoMode& mode) {
  const Screen screen(display, mode, {.scale_px_per_mm = 0.1});
  return {screen.width_mm(), screen.height_mm()};
}

/// Number of periods of the strongest sine in some values.
int strongest_frequency(const std::vector<double>& values) {
  int strongest = 0;
  double largest = 0;
  const auto count = static_cast<int>(values.size());
  for (int k = 1; k <= count / 2; ++k) {
    double re = 0, im = 0;
    for (int i = 0; i < count; ++i) {
      re += values[static_cast<std::size_t>(i)] * std::cos(2 * std::numbers::pi * k * i / count);
      im += values[static_cast<std::size_t>(i)] * std::sin(2 * std::numbers::pi * k * i / count);
    }
    if (re * re + im * im > 1.0001 * largest) {
      largest = re * re + im * im;
      strongest = k;
    }
  }
  return strongest;
}

/// Periods of the green light of a white picture, along rows and columns of an image.
struct Frequencies {
  int across_columns, across_rows;
};
Frequencies structure_of(Screen& screen, const VideoMode& mode) {
  const auto width = static_cast<std::size_t>(screen.width()),
             height = static_cast<std::size_t>(screen.height());
  const std::vector<std::uint8_t> white(static_cast<std::size_t>(3 * mode.width * mode.height), 255);
  std::vector<float> light(3 * width * height);
  screen.show({.rgb = white}, 0, {.light = light.data()});
  std::vector<double> columns(width), rows(height);
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const double green = static_cast<double>(light[3 * (y * width + x) + 1]);
      columns[x] += green;
      rows[y] += green;
    }
  return {strongest_frequency(columns), strongest_frequency(rows)};
}

TEST(CloseUp, FinestStructureHasEightPixelsPerPeriod) {
  for (const DisplayPreset& preset : display_presets()) {
    const Display display = find_display(preset.name);
    if (display.kind == DisplayKind::eink) continue;  // its pixels touch each other
    const VideoMode mode = video_mode(preset.mode);
    const ScreenView view = close_up_view(display, mode, size_of(display, mode), {0.5, 0.5});
    Screen screen(display, mode, view);
    ASSERT_EQ(screen.width(), 640) << preset.name;
    ASSERT_EQ(screen.height(), 480) << preset.name;
    const Frequencies found = structure_of(screen, mode);
    const bool has_mask = display.kind == DisplayKind::lcd || display.kind == DisplayKind::plasma ||
                          display.crt.mask != ShadowMask::none;
    if (has_mask) EXPECT_NEAR(found.across_columns, 640 / 8, 1) << preset.name;
    else EXPECT_NEAR(found.across_rows, 480 / 8, 1) << preset.name;
    EXPECT_LE(found.across_rows, 480 / 8 + 1) << preset.name;
  }
}

TEST(CloseUp, FinestPeriodIsThatOfMaskLinesOrPixels) {
  const auto period = [](const char* display_text, const char* mode_name) {
    const Display display = find_display(display_text);
    const VideoMode mode = video_mode(mode_name);
    return finest_period_mm(display, mode, size_of(display, mode));
  };
  const double height_mm = 0.6 * 25.4 * 14;
  EXPECT_DOUBLE_EQ(period("crt:pitch=0.4,mask=grille", "vga"), 0.4);
  EXPECT_DOUBLE_EQ(period("crt:pitch=0.4,mask=dots", "vga"), 0.4 * std::sqrt(3) / 2);
  EXPECT_DOUBLE_EQ(period("crt:pitch=4", "vga"), height_mm / 480);
  EXPECT_DOUBLE_EQ(period("crt:mask=none", "cga"), height_mm / 200);
  EXPECT_DOUBLE_EQ(period("crt:mask=none", "vga13h"), height_mm / 400) << "scanned twice";
  EXPECT_DOUBLE_EQ(period("crt:mask=none,scan_lines=3", "vga13h"), height_mm / 600);
  EXPECT_NEAR(period("crt:mask=none,overscan=0.2", "cga"), height_mm / 200 / 0.8, 1e-9);
  EXPECT_NEAR(period("crt:mask=none", "200x100x24"), height_mm * 4 / 3 / 200, 1e-9) << "a wide picture";
  EXPECT_NEAR(period("eink:diagonal=10", "gray4"), 8 * 25.4 / 800, 1e-9);
  EXPECT_NEAR(period("lcd:diagonal=10", "320x200x24:aspect=5:6"), 8 * 25.4 / 320, 1e-9);
}

TEST(CloseUp, StaysOnTheScreen) {
  const Display display = find_display("vga14");
  const VideoMode mode = video_mode("vga");
  const ScreenSize size = size_of(display, mode);
  const ScreenView middle = close_up_view(display, mode, size, {0.5, 0.25});
  EXPECT_NEAR(middle.x_mm + middle.width_mm / 2, size.width_mm / 2, 2e-3);
  EXPECT_NEAR(middle.y_mm + middle.height_mm / 2, size.height_mm / 4, 2e-3);
  const ScreenView corner = close_up_view(display, mode, size, {0, 1});
  EXPECT_EQ(corner.x_mm, 0);
  EXPECT_NEAR(corner.y_mm + corner.height_mm, size.height_mm, 1e-3);
  EXPECT_NO_THROW(Screen(display, mode, corner));
  // Thirty pixels of a panel are 240 of an image.
  const VideoMode small{.width = 40, .height = 30};
  const Display panel = find_display("lcd");
  Screen whole(panel, small, close_up_view(panel, small, size_of(panel, small), {0.9, 0.9}));
  EXPECT_NEAR(whole.width(), 320, 2);
  EXPECT_NEAR(whole.height(), 240, 2);
}

/// `bright` of 10,000 pixels have the level 255 in one component, the others 128.
Picture with_bright_pixels(std::size_t bright) {
  Picture picture(100, 100);
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) picture.rgba[i] = i % 4 == 3 ? 255 : 128;
  for (std::size_t i = 0; i < bright; ++i) picture.rgba[4 * i + i % 3] = 255;
  return picture;
}

TEST(ExposureGain, ClipsAtMostAHundredthOfThePixels) {
  const double light = 0.2158605;  // level 128
  EXPECT_DOUBLE_EQ(exposure_gain(with_bright_pixels(0), 0.1), std::floor(100 / light) / 100);
  EXPECT_DOUBLE_EQ(exposure_gain(with_bright_pixels(100), 0.1), std::floor(100 / light) / 100);
  EXPECT_DOUBLE_EQ(exposure_gain(with_bright_pixels(101), 0.1), 1);
}

TEST(ExposureGain, MakesWhiteAsBrightAsThePicture) {
  EXPECT_DOUBLE_EQ(exposure_gain(with_bright_pixels(0), 0.5), 2);
  EXPECT_DOUBLE_EQ(exposure_gain(with_bright_pixels(0), 1), 1);
  EXPECT_DOUBLE_EQ(exposure_gain(Picture(10, 10), 0.3), 3.33) << "a black picture";
}

}  // namespace
}  // namespace tessera::program::cli::close_up_test
