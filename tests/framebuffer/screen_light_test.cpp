// Displays keep light: the mean of an image is that of the display's own curve.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "framebuffer/tessera/rgb_primaries.hpp"
#include "tests/framebuffer/screen_support.h"

namespace tessera::screen_light_test {
namespace {

using namespace screen_support;

constexpr VideoMode kMode{.width = 160, .height = 120};

/// Light over that of white, from the formulas of the displays.
using Curve = double (*)(double signal);

double tube_curve(double signal) {  // BT.1886, exponent 2.4, black 0.001
  const double root = std::pow(0.001, 1 / 2.4), b = root / (1 - root);
  return std::pow(1 - root, 2.4) * std::pow(signal + b, 2.4);
}
double lcd_curve(double signal) { return 0.0025 + 0.9975 * std::pow(signal, 2.2); }
/// Nearest multiple of 1/255: the sums of eight binary subfields.
double plasma_curve(double signal) { return 0.001 + 0.999 * std::round(255 * std::pow(signal, 2.2)) / 255; }
double paper_curve(double luma) {  // 16 greys, reflectances .035 to .42
  const double gray = std::floor(15 * luma + 0.5) / 15;
  const double light = gray <= 0.04045 ? gray / 12.92 : std::pow((gray + 0.055) / 1.055, 2.4);
  return (0.035 + (0.42 - 0.035) * light) / 0.42;
}

struct Case {
  const char* display;
  Curve curve;
  double diagonal_mm;
};
const Case kColorDisplays[] = {
    {"crt:primaries=bt709,bandwidth=1000", tube_curve, 14 * 25.4},
    {"crt:primaries=bt709,bandwidth=1000,mask=none", tube_curve, 14 * 25.4},
    {"crt:primaries=bt709,bandwidth=1000,mask=slots,pitch=0.42", tube_curve, 14 * 25.4},
    {"crt:primaries=bt709,bandwidth=1000,mask=grille,beam_growth=1,halation=0.1,convergence=0.1", tube_curve,
     14 * 25.4},
    {"lcd", lcd_curve, 15 * 25.4},
    {"lcd:stripes=bgr,fill=0.5", lcd_curve, 15 * 25.4},
    {"plasma", plasma_curve, 42 * 25.4},
};

/// Five scales: rows of the image from a quarter of the mode's to 9 per row.
std::vector<double> scales(const Case& display) {
  std::vector<double> list;
  for (const double rows : {30.0, 137.0, 301.0, 560.0, 1080.0})
    list.push_back(rows / (0.6 * display.diagonal_mm));
  return list;
}

double mean_light(const std::string& display, double scale, const std::vector<std::uint8_t>& rgb,
                  std::size_t component) {
  return show_once(display, kMode, {.scale_px_per_mm = scale}, rgb).mean(component);
}

TEST(ScreenLight, FieldsHaveTheLightOfTheCurve) {
  for (const Case& display : kColorDisplays)
    for (const double scale : scales(display))
      for (std::size_t color = 0; color < 3; ++color) {
        const double white = mean_light(display.display, scale, gray_field(160, 120, 255), color);
        for (const int level : {0, 64, 128, 192, 255}) {
          Level primary{};
          primary[color] = static_cast<std::uint8_t>(level);
          EXPECT_NEAR(mean_light(display.display, scale, field(160, 120, primary), color) / white,
                      display.curve(level / 255.0), 0.01 * std::max(display.curve(level / 255.0), 1e-3))
              << display.display << ", scale " << scale << ", colour " << color << ", level " << level;
        }
      }
}

TEST(ScreenLight, PaperHasTheReflectanceOfItsGrays) {
  for (const double scale : {0.3, 1.0, 4.0, 9.0, 15.0}) {
    const double white = mean_light("eink", scale, gray_field(160, 120, 255), 1);
    for (const int level : {0, 64, 128, 192, 255})
      EXPECT_NEAR(mean_light("eink", scale, gray_field(160, 120, level), 1) / white,
                  paper_curve(level / 255.0), 0.005 * paper_curve(level / 255.0))
          << scale << " " << level;
  }
}

/// A picture with the spectrum of photographs: smooth areas, edges and fine detail.
std::vector<std::uint8_t> photograph() {
  std::mt19937 random(7);
  std::vector<double> values(160 * 120, 0.4);
  for (int size = 64; size >= 1; size /= 2)
    for (int patch = 0; patch < 40000 / (size * size) + 4; ++patch) {
      const int left = static_cast<int>(random() % 160), top = static_cast<int>(random() % 120);
      const double step = (static_cast<double>(random() % 201) - 100) / 100 * 0.25;
      for (int y = top; y < std::min(120, top + size); ++y)
        for (int x = left; x < std::min(160, left + size); ++x)
          values[static_cast<std::size_t>(160 * y + x)] += step;
    }
  return picture(160, 120, [&](int x, int y) {
    const double value = std::min(std::max(values[static_cast<std::size_t>(160 * y + x)], 0.0), 1.0);
    const auto level = static_cast<std::uint8_t>(255 * value);
    return Level{level, static_cast<std::uint8_t>(255 - level), static_cast<std::uint8_t>(level / 2)};
  });
}

TEST(ScreenLight, PhotographsKeepTheirLight) {
  const std::vector<std::uint8_t> photo = photograph();
  for (const Case& display : kColorDisplays)
    for (const double scale : scales(display))
      for (std::size_t color = 0; color < 3; ++color) {
        double expected = 0;
        for (std::size_t i = color; i < photo.size(); i += 3) expected += display.curve(photo[i] / 255.0);
        expected /= 160 * 120;
        const double white = mean_light(display.display, scale, gray_field(160, 120, 255), color);
        EXPECT_NEAR(mean_light(display.display, scale, photo, color) / white, expected, 0.01 * expected)
            << display.display << ", scale " << scale << ", colour " << color;
      }
}

TEST(ScreenLight, WhiteIsThatOfTheDisplay) {
  // xy of the mean of a white image, from linear sRGB [IEC 61966-2-1].
  const auto chromaticity = [](const std::string& display) {
    const LightImage image = show_once(display, kMode, {.scale_px_per_mm = 3}, gray_field(160, 120, 255));
    const double r = image.mean(0), g = image.mean(1), b = image.mean(2);
    const double x = .412391 * r + .357584 * g + .180481 * b, y = .212639 * r + .715169 * g + .072192 * b,
                 z = .019331 * r + .119195 * g + .950532 * b;
    return Chromaticity{x / (x + y + z), y / (x + y + z)};
  };
  // Primaries of sRGB and the coefficients above have few digits.
  const auto expect_near = [](Chromaticity found, Chromaticity expected) {
    EXPECT_NEAR(found.x, expected.x, 2e-4);
    EXPECT_NEAR(found.y, expected.y, 2e-4);
  };
  expect_near(chromaticity("crt"), {.3127, .3290});
  expect_near(chromaticity("crt:white=9300,mask=none"), {.2831, .2971});
  expect_near(chromaticity("lcd"), {.3127, .3290});
  expect_near(chromaticity("crt:mask=none,phosphor=p39"), {.223, .698});
}

TEST(ScreenLight, BrightestPixelOfWhiteIsTheGain) {
  for (const char* display :
       {"crt", "crt:mask=none", "crt:mask=slots,halation=0.2", "crt:mask=grille,pitch=0.9",
        "crt:mask=none,phosphor=p1", "lcd", "plasma", "eink"})
    for (const double gain : {0.5, 1.0, 3.0}) {
      const LightImage image = show_once(
          display, kMode,
          {.scale_px_per_mm = 12, .x_mm = 20, .y_mm = 20, .width_mm = 20, .height_mm = 20, .gain = gain},
          gray_field(160, 120, 255));
      const double brightest = *std::ranges::max_element(image.light);
      EXPECT_LE(brightest, 1.001 * gain) << display;
      EXPECT_GE(brightest, 0.97 * gain) << display;
    }
}

TEST(ScreenLight, WhiteLevelIsTheMeanOfWhite) {
  for (const char* display :
       {"crt:primaries=bt709,diagonal=3", "crt:primaries=bt709,diagonal=3,mask=slots,halation=0.2",
        "lcd:diagonal=3", "plasma:diagonal=3", "eink:diagonal=3"}) {
    Screen screen(
        find_display(display), kMode,
        {.scale_px_per_mm = 12, .x_mm = 20, .y_mm = 15, .width_mm = 24, .height_mm = 18, .gain = 0.7});
    const LightImage image = show(screen, gray_field(160, 120, 255), 0);
    for (std::size_t color = 0; color < 3; ++color)
      EXPECT_NEAR(image.mean(color), screen.white_level(), 0.01 * screen.white_level()) << display;
  }
}

TEST(ScreenLight, CodesAreThoseOfTheLight) {
  const auto srgb = [](double light) {
    const double l = std::min(std::max(light, 0.0), 1.0);
    return 255 * (l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055);
  };
  Screen screen(find_display("crt"), kMode, {.scale_px_per_mm = 5});
  const auto pixels = static_cast<std::size_t>(screen.width()) * static_cast<std::size_t>(screen.height());
  std::vector<std::uint8_t> rgb(3 * pixels);
  std::vector<float> light(3 * pixels);
  const std::vector<std::uint8_t> photo = photograph();
  screen.show({.rgb = photo}, 0, {.rgb = rgb.data(), .light = light.data()});
  for (std::size_t i = 0; i < rgb.size(); ++i)
    ASSERT_NEAR(rgb[i], srgb(static_cast<double>(light[i])), 0.503);
}

}  // namespace
}  // namespace tessera::screen_light_test
