// Sharpness of tubes, by formula: beam, video amplifier, pixels, scan lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "tests/framebuffer/screen_support.h"

namespace tessera::screen_resolution_test {
namespace {

using namespace screen_support;

constexpr double kPi = std::numbers::pi;
constexpr double kScreenMm = 12 * 25.4 * 0.8;
constexpr VideoMode kMode{
    .width = 320,
    .height = 240,
    .timing = ScanTiming{.pixel_clock_hz = 6e6, .total_columns = 400, .total_lines = 250}};
constexpr double kPixelMm = kScreenMm / 320;

/// A tube without a mask, and linear.
std::string linear_tube(double beam_mm, double bandwidth_mhz) {
  return "crt:diagonal=12,mask=none,gamma=1,black=0,beam=" + std::to_string(beam_mm) +
         ",bandwidth=" + std::to_string(bandwidth_mhz);
}

/// sin(pi f) / (pi f)
double aperture(double f) { return f == 0 ? 1 : std::sin(kPi * f) / (kPi * f); }

/// Amplitude of a frequency over the mean, from a row of an image that has a whole number of periods.
double modulation(const std::vector<double>& row, double periods) {
  std::complex<double> sum = 0;
  double mean = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    mean += row[i];
    sum += row[i] * std::polar(1.0, -2 * kPi * periods * (static_cast<double>(i) + 0.5) /
                                        static_cast<double>(row.size()));
  }
  return 2 * std::abs(sum) / mean;
}

TEST(ScreenResolution, GratingsLoseTheProductOfBeamPoleAndAperture) {
  constexpr double kScale = 10 / kPixelMm;  // 10 columns of the image per pixel
  for (const double beam_mm : {0.4, 0.76, 1.2})
    for (const double bandwidth_mhz : {1.5, 3.0, 6.0})
      for (const int period : {1, 2, 3, 4, 5, 6, 7, 8}) {
        // Twelve periods in the middle of the screen. A period of 2 has its peaks on pixels.
        const double phase = period == 2 ? 0 : 0.3;
        const auto grating = picture(320, 240, [&](int x, int) {
          const double wave = std::cos(2 * kPi * (static_cast<double>(x) / period + phase));
          const auto level = static_cast<std::uint8_t>(std::lround(128 + 100 * wave));
          return Level{level, level, level};
        });
        const LightImage image = show_once(linear_tube(beam_mm, bandwidth_mhz), kMode,
                                           {.scale_px_per_mm = kScale,
                                            .x_mm = 100 * kPixelMm,
                                            .y_mm = 60,
                                            .width_mm = 12 * period * kPixelMm,
                                            .height_mm = 4 * kPixelMm},
                                           grating);
        ASSERT_EQ(image.width, 120 * period);
        std::vector<double> row;
        for (int x = 0; x < image.width; ++x) row.push_back(image.at(x, 20, 1));
        if (period == 1) {  // all pixels are equal
          EXPECT_LT(modulation(row, 12), 0.005);
          continue;
        }
        const double f_px = 1.0 / period, f_mm = f_px / kPixelMm;
        const double sigma_mm = beam_mm / (2 * std::sqrt(2 * std::log(2.0)));
        const double beam = std::exp(-2 * kPi * kPi * sigma_mm * sigma_mm * f_mm * f_mm);
        const double pole = 1 / std::sqrt(1 + std::pow(f_px * 6 / bandwidth_mhz, 2));
        // At a period of 2, the frequency coincides with its mirror image at 1 - 1/2.
        const double held = aperture(f_px) * (period == 2 ? 2 : 1);
        const double expected = 100 / 128.0 * held * pole * beam * aperture(f_px / 10);
        EXPECT_NEAR(modulation(row, 12) / expected, 1, 0.03)
            << "beam " << beam_mm << " mm, bandwidth " << bandwidth_mhz << " MHz, period " << period;
      }
}

TEST(ScreenResolution, BandwidthIsHalfThePixelClockIfNotGiven) {
  const auto stripes = picture(320, 240, [](int x, int) {
    const auto level = static_cast<std::uint8_t>(x % 3 == 0 ? 255 : 0);
    return Level{level, level, level};
  });
  const ScreenView view{.scale_px_per_mm = 4, .x_mm = 60, .y_mm = 60, .width_mm = 40, .height_mm = 10};
  EXPECT_EQ(show_once("crt:diagonal=12", kMode, view, stripes).light,
            show_once("crt:diagonal=12,bandwidth=3", kMode, view, stripes).light);
}

TEST(ScreenResolution, SubpixelsHaveTheContrastOfTheirFill) {
  // First harmonic of stripes that fill a share of a third of the pixel, with the weight of the band limit.
  constexpr double kPixels = 12, kFill = 0.6;
  const LightImage image = show_once("lcd:diagonal=12,black=0,fill=0.6", kMode,
                                     {.scale_px_per_mm = kPixels / kPixelMm,
                                      .x_mm = 20 * kPixelMm,
                                      .y_mm = 60,
                                      .width_mm = 10 * kPixelMm,
                                      .height_mm = 2},
                                     gray_field(320, 240, 255));
  for (std::size_t color = 0; color < 3; ++color) {
    std::vector<double> row;
    for (int x = 0; x < image.width; ++x) row.push_back(image.at(x, 5, color));
    EXPECT_NEAR(modulation(row, 10), 2 * aperture(kFill / 3) * (1 - 2 / kPixels), 1e-3) << color;
  }
}

TEST(ScreenResolution, LinesRippleByFormula) {
  constexpr double kLineMm = kPixelMm;                     // 240 lines on 3/4 of the width
  for (const double sigma : {0.2, 0.25, 0.3, 0.4, 0.5}) {  // over the distance of lines
    const double beam_mm = sigma * kLineMm * 2 * std::sqrt(2 * std::log(2.0));
    const LightImage image = show_once(linear_tube(beam_mm, 1000), kMode,
                                       {.scale_px_per_mm = 20 / kLineMm,
                                        .x_mm = 80,
                                        .y_mm = 100 * kLineMm,
                                        .width_mm = 2,
                                        .height_mm = 8 * kLineMm},
                                       gray_field(320, 240, 200));
    ASSERT_EQ(image.height, 160);
    std::vector<double> column;
    for (int y = 0; y < image.height; ++y) column.push_back(image.at(4, y, 1));
    const double expected = 2 * std::exp(-2 * kPi * kPi * sigma * sigma) * aperture(1 / 20.0);
    EXPECT_NEAR(modulation(column, 8) / expected, 1, 0.03) << sigma;
  }
}

TEST(ScreenResolution, LinesThatAreTooFineForTheImageAreEven) {
  for (const double rows_per_line : {0.6, 1.1, 1.37, 1.9}) {
    const LightImage image = show_once(linear_tube(0.2, 1000), kMode,
                                       {.scale_px_per_mm = rows_per_line / kPixelMm,
                                        .x_mm = 50,
                                        .y_mm = 50,
                                        .width_mm = 100,
                                        .height_mm = 80},
                                       gray_field(320, 240, 200));
    const auto [least, most] = std::ranges::minmax(image.light);
    EXPECT_LT((most - least) / most, 0.005f) << rows_per_line;
  }
}

TEST(ScreenResolution, PanelsShowNoMoire) {
  // Structure that is finer than the image's pixels would alias to long waves. Means over three periods of
  // subpixels are even.
  for (double pixels = 2.2; pixels < 5; pixels += 0.37)
    for (const char* display : {"lcd:diagonal=12", "plasma:diagonal=12"}) {
      const double pixel_mm = kScreenMm / 320;
      const LightImage image = show_once(
          display, kMode,
          {.scale_px_per_mm = pixels / pixel_mm, .x_mm = 60, .y_mm = 60, .width_mm = 60, .height_mm = 40},
          gray_field(320, 240, 255));
      // Light of each column: its harmonics up to half of the sampling rate, without what lies at multiples
      // of the panel's pixels.
      std::vector<double> row;
      double mean = 0;
      for (int x = 0; x < image.width; ++x) row.push_back(image.at(x, image.height / 2, 1));
      for (const double value : row) mean += value / static_cast<double>(row.size());
      for (double f = 0.02; f < 0.5; f += 0.005) {
        const double nearest = std::round(f * pixels) / pixels;
        if (std::abs(f - nearest) < 0.03) continue;
        std::complex<double> sum = 0;
        double windows = 0;
        for (std::size_t x = 0; x < row.size(); ++x) {
          const double window =
              1 - std::cos(2 * kPi * (static_cast<double>(x) + 0.5) / static_cast<double>(row.size()));
          windows += window;
          sum += (row[x] - mean) * window * std::polar(1.0, 2 * kPi * f * static_cast<double>(x));
        }
        EXPECT_LT(2 * std::abs(sum) / windows / mean, 0.02) << display << " " << pixels << " " << f;
      }
    }
}

TEST(ScreenResolution, ConvergenceErrorMovesRedAndBlueApart) {
  const auto centre = [](const LightImage& image, std::size_t color) {
    double sum = 0, weight = 0;
    for (int x = 0; x < image.width; ++x) {
      sum += image.at(x, image.height / 2, color) * x;
      weight += image.at(x, image.height / 2, color);
    }
    return sum / weight;
  };
  const auto line = picture(320, 240, [](int x, int) {
    const auto level = static_cast<std::uint8_t>(x == 160 ? 255 : 0);
    return Level{level, level, level};
  });
  const ScreenView view{.scale_px_per_mm = 20, .x_mm = 110, .y_mm = 60, .width_mm = 24, .height_mm = 2};
  const LightImage image =
      show_once(linear_tube(0.5, 6) + ",primaries=bt709,convergence=0.4", kMode, view, line);
  EXPECT_NEAR(centre(image, 0) - centre(image, 1), -0.4 * 20, 0.1);
  EXPECT_NEAR(centre(image, 2) - centre(image, 1), 0.4 * 20, 0.1);
}

TEST(ScreenResolution, DelayOfTheAmplifierIsCentred) {
  const auto line = picture(320, 240, [](int x, int) {
    const auto level = static_cast<std::uint8_t>(x == 160 ? 255 : 0);
    return Level{level, level, level};
  });
  const ScreenView view{.scale_px_per_mm = 20, .x_mm = 110, .y_mm = 60, .width_mm = 24, .height_mm = 2};
  for (const double bandwidth : {0.8, 3.0, 100.0}) {
    const LightImage image = show_once(linear_tube(0.5, bandwidth), kMode, view, line);
    double sum = 0, weight = 0;
    for (int x = 0; x < image.width; ++x) {
      sum += image.at(x, 20, 1) * (110 + (x + 0.5) / 20);
      weight += image.at(x, 20, 1);
    }
    EXPECT_NEAR(sum / weight, 160.5 * kPixelMm, 0.02 * kPixelMm) << bandwidth;
  }
}

TEST(ScreenResolution, BeamsGrowWithTheirCurrent) {
  // Width of one bright and of one dark row, from the second moment.
  const auto sigma_of = [](int level) {
    const auto row = picture(320, 240, [&](int, int y) {
      const auto value = static_cast<std::uint8_t>(y == 120 ? level : 0);
      return Level{value, value, value};
    });
    const LightImage image =
        show_once(linear_tube(0.5, 1000) + ",beam_growth=1", kMode,
                  {.scale_px_per_mm = 30, .x_mm = 100, .y_mm = 87, .width_mm = 1, .height_mm = 9}, row);
    double sum = 0, mean = 0, square = 0;
    for (int y = 0; y < image.height; ++y) {
      const double light = image.at(15, y, 1), position = y / 30.0;
      sum += light;
      mean += light * position;
      square += light * position * position;
    }
    return std::sqrt(square / sum - mean * mean / sum / sum);
  };
  const double narrow = 0.5 / (2 * std::sqrt(2 * std::log(2.0)));
  EXPECT_NEAR(sigma_of(255), 2 * narrow, 0.02 * narrow);
  // At a tenth of the light, a tenth of it has the widest profile.
  EXPECT_NEAR(sigma_of(26), narrow * std::sqrt(0.898 + 0.102 * 4), 0.02 * narrow);
}

}  // namespace
}  // namespace tessera::screen_resolution_test
