// Shadow masks by their spectrum: where the peaks of a white field lie, and that nothing else is there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "tests/framebuffer/screen_support.h"

namespace tessera::mask_spectrum_test {
namespace {

using namespace screen_support;

constexpr int kSize = 256;  ///< pixels of the image, a power of two
constexpr double kPitch = 0.6;
constexpr double kSlotHeight = 1.3;

/// In place, radix 2 [Cooley and Tukey 1965].
void transform(std::vector<std::complex<double>>& values) {
  const std::size_t n = values.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n / 2;
    for (; (j & bit) != 0; bit /= 2) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(values[i], values[j]);
  }
  for (std::size_t length = 2; length <= n; length *= 2)
    for (std::size_t block = 0; block < n; block += length)
      for (std::size_t k = 0; k < length / 2; ++k) {
        const auto turn =
            std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(length));
        const auto even = values[block + k], odd = turn * values[block + k + length / 2];
        values[block + k] = even + odd;
        values[block + k + length / 2] = even - odd;
      }
}

/// Amplitudes relative to the mean, at frequencies (u, v) / kSize, from a Hann window.
struct Spectrum {
  std::vector<double> amplitude;  ///< [v][u], each 0 to kSize - 1
  double at(int u, int v) const {
    return amplitude[static_cast<std::size_t>((v + kSize) % kSize * kSize + (u + kSize) % kSize)];
  }
};

Spectrum spectrum(const LightImage& image, std::size_t component) {
  const auto window = [](int i) { return 1 - std::cos(2 * std::numbers::pi * i / kSize); };
  std::vector<std::complex<double>> values(std::size_t{kSize} * kSize);
  for (int y = 0; y < kSize; ++y) {
    std::vector<std::complex<double>> row;
    for (int x = 0; x < kSize; ++x) row.emplace_back(image.at(x, y, component) * window(x) * window(y));
    transform(row);
    std::ranges::copy(row, values.begin() + std::ptrdiff_t{y} * kSize);
  }
  for (std::size_t x = 0; x < kSize; ++x) {
    std::vector<std::complex<double>> column;
    for (std::size_t y = 0; y < kSize; ++y) column.push_back(values[y * kSize + x]);
    transform(column);
    for (std::size_t y = 0; y < kSize; ++y) values[y * kSize + x] = column[y];
  }
  Spectrum result;
  for (const auto& value : values) result.amplitude.push_back(2 * std::abs(value) / std::abs(values[0]));
  result.amplitude[0] = 1;
  return result;
}

struct Frequency {
  double x, y;  ///< per pixel of the image
};

/// The strongest peaks of half of the plane, the mean left out; places between bins by parabolas.
std::vector<Frequency> strongest_peaks(const Spectrum& s, std::size_t count) {
  struct Peak {
    double amplitude;
    Frequency frequency;
  };
  std::vector<Peak> peaks;
  for (int v = 0; v <= kSize / 2; ++v)
    for (int u = -kSize / 2 + 1; u < kSize / 2; ++u) {
      if (std::hypot(u, v) < 8 || (v == 0 && u < 0)) continue;
      const double here = s.at(u, v);
      bool is_peak = here > 1e-3;
      for (int dv = -1; dv <= 1; ++dv)
        for (int du = -1; du <= 1; ++du) is_peak = is_peak && s.at(u + du, v + dv) <= here;
      if (!is_peak) continue;
      const auto between = [&](double left, double right) {
        const double l = std::log(left), m = std::log(here), r = std::log(right);
        return (l - r) / (2 * (l - 2 * m + r));
      };
      peaks.push_back({here,
                       {(u + between(s.at(u - 1, v), s.at(u + 1, v))) / kSize,
                        (v + between(s.at(u, v - 1), s.at(u, v + 1))) / kSize}});
    }
  std::ranges::sort(peaks, std::greater(), &Peak::amplitude);
  std::vector<Frequency> found;
  for (std::size_t i = 0; i < std::min(count, peaks.size()); ++i) found.push_back(peaks[i].frequency);
  return found;
}

/// Largest amplitude that is no integer combination of two frequencies. Windows spread peaks over two bins.
double largest_other(const Spectrum& s, Frequency a, Frequency b) {
  std::vector<bool> is_expected(s.amplitude.size(), false);
  for (int i = -40; i <= 40; ++i)
    for (int j = -40; j <= 40; ++j) {
      const double u = kSize * (i * a.x + j * b.x), v = kSize * (i * a.y + j * b.y);
      if (std::abs(u) > kSize / 2 + 2 || std::abs(v) > kSize / 2 + 2) continue;
      for (int dv = -2; dv <= 3; ++dv)
        for (int du = -2; du <= 3; ++du) {
          const int x = static_cast<int>(std::floor(u)) + du + 2 * kSize,
                    y = static_cast<int>(std::floor(v)) + dv + 2 * kSize;
          is_expected[static_cast<std::size_t>(y % kSize * kSize + x % kSize)] = true;
        }
    }
  double largest = 0;
  for (std::size_t i = 0; i < s.amplitude.size(); ++i)
    if (!is_expected[i]) largest = std::max(largest, s.amplitude[i]);
  return largest;
}

/// A white field on a mask, without visible scan lines: the beam is 3 lines wide.
LightImage white_field(const std::string& mask, double pixels_per_mm) {
  const std::string display = "crt:diagonal=30,beam=3,primaries=bt709,mask=" + mask +
                              ",pitch=" + std::to_string(kPitch) +
                              ",slot_height=" + std::to_string(kSlotHeight);
  const double size = kSize / pixels_per_mm;
  return show_once(
      display, {.width = 640, .height = 480},
      {.scale_px_per_mm = pixels_per_mm, .x_mm = 50, .y_mm = 50, .width_mm = size, .height_mm = size},
      gray_field(640, 480, 255));
}

/// Calls check(pixels per mm, image) for 2.2 to 8 pixels per triad.
template <class Check>
void at_each_scale(const std::string& mask, double triad_mm, const Check& check) {
  for (double pixels = 2.2; pixels <= 8; pixels += 0.37) {
    SCOPED_TRACE(mask + ", pixels per triad: " + std::to_string(pixels));
    const LightImage image = white_field(mask, pixels / triad_mm);
    ASSERT_EQ(image.width, kSize);
    ASSERT_EQ(image.height, kSize);
    check(pixels / triad_mm, image);
  }
}

TEST(MaskSpectrum, DotsHaveSixPeaksAtEqualAnglesAndNothingElse) {
  const double frequency = 2 / (std::numbers::sqrt3 * kPitch);  // per mm
  at_each_scale("dots", std::numbers::sqrt3 / 2 * kPitch, [&](double scale, const LightImage& image) {
    for (std::size_t color = 0; color < 3; ++color) {
      const Spectrum s = spectrum(image, color);
      const std::vector<Frequency> peaks = strongest_peaks(s, 3);  // the other three are their mirror images
      ASSERT_EQ(peaks.size(), 3u);
      std::vector<double> angles;
      for (const Frequency& peak : peaks) {
        EXPECT_NEAR(std::hypot(peak.x, peak.y) * scale / frequency, 1, 0.01);
        angles.push_back(std::atan2(peak.y, peak.x) * 180 / std::numbers::pi);
      }
      std::ranges::sort(angles);
      EXPECT_NEAR(angles[0], 0, 0.6);
      EXPECT_NEAR(angles[1], 60, 0.6);
      EXPECT_NEAR(angles[2], 120, 0.6);
      const double first = frequency / scale;
      EXPECT_LT(largest_other(s, {first, 0}, {first / 2, first * std::numbers::sqrt3 / 2}), 0.02);
    }
  });
}

TEST(MaskSpectrum, GrillesHaveOnePeakAndItsMultiples) {
  at_each_scale("grille", kPitch, [&](double scale, const LightImage& image) {
    for (std::size_t color = 0; color < 3; ++color) {
      const Spectrum s = spectrum(image, color);
      const std::vector<Frequency> peaks = strongest_peaks(s, 1);
      ASSERT_EQ(peaks.size(), 1u);
      EXPECT_NEAR(peaks[0].x * scale * kPitch, 1, 0.01);
      EXPECT_NEAR(peaks[0].y, 0, 0.001);
      // Stripes fill 0.8 of a third of the pitch; the band limit weighs frequencies down to 0 at half the
      // rate.
      const double pixels = scale * kPitch, stripe = std::numbers::pi * 0.8 / 3;
      const double amplitude = 2 * std::sin(stripe) / stripe * (1 - 2 / pixels);
      EXPECT_NEAR(s.at(static_cast<int>(std::lround(kSize / pixels)), 0) / amplitude, 0.92, 0.09);
      EXPECT_LT(largest_other(s, {1 / kPitch / scale, 0}, {0, 1}), 0.02);
    }
  });
}

TEST(MaskSpectrum, SlotsHavePeaksOfPitchAndOfHalfShiftedSlots) {
  at_each_scale("slots", kPitch, [&](double scale, const LightImage& image) {
    for (std::size_t color = 0; color < 3; ++color) {
      const Spectrum s = spectrum(image, color);
      bool has_pitch = false, has_shifted = false;
      for (const Frequency& peak : strongest_peaks(s, 3)) {
        const double x = peak.x * scale * kPitch, y = peak.y * scale * kSlotHeight;  // in units of the cell
        has_pitch = has_pitch || (std::abs(x - 1) < 0.01 && std::abs(y) < 0.01);
        has_shifted = has_shifted || (std::abs(std::abs(x) - 0.5) < 0.01 && std::abs(y - 1) < 0.01);
      }
      EXPECT_TRUE(has_pitch);
      EXPECT_TRUE(has_shifted);
      EXPECT_LT(largest_other(s, {1 / (2 * kPitch) / scale, 1 / kSlotHeight / scale},
                              {1 / (2 * kPitch) / scale, -1 / kSlotHeight / scale}),
                0.02);
    }
  });
}

TEST(MaskSpectrum, ColoursStandSideBySide) {
  // Phases of the first harmonic of red, green and blue differ by a third of the pitch.
  const LightImage image = white_field("grille", 20);
  std::array<double, 3> phase{};
  for (std::size_t color = 0; color < 3; ++color) {
    std::complex<double> sum = 0;
    for (int x = 0; x < kSize; ++x)
      sum += image.at(x, 100, color) * std::polar(1.0, 2 * std::numbers::pi * x / (20 * kPitch));
    phase[color] = std::arg(sum) / (2 * std::numbers::pi);
  }
  const auto turns = [](double difference) { return difference - std::floor(difference); };
  EXPECT_NEAR(turns(phase[1] - phase[0]), 1 / 3.0, 0.02);
  EXPECT_NEAR(turns(phase[2] - phase[1]), 1 / 3.0, 0.02);
}

TEST(MaskSpectrum, MasksAreNeverNegative) {
  for (const char* mask : {"dots", "slots", "grille"})
    for (const double scale : {4.5, 7.0, 30.0}) {
      const LightImage image = white_field(mask, scale);
      EXPECT_GE(*std::ranges::min_element(image.light), -1e-6f) << mask << " " << scale;
    }
}

}  // namespace
}  // namespace tessera::mask_spectrum_test
