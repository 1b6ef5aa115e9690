// Kernels of displays against their formulas, one value at a time, bit for bit on every instruction set.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "framebuffer/display/image_rows.h"
#include "framebuffer/display/resample_rows.h"
#include "framebuffer/display/signal_to_light.h"
#include "framebuffer/instruction_set.h"

namespace tessera::display_kernels_test {
namespace {

using namespace detail;

constexpr std::size_t kRows = kBlockRows;

std::vector<float> random_values(std::size_t count, float low, float high) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> value(low, high);
  std::vector<float> values(count);
  for (float& v : values) v = value(random);
  return values;
}

TEST(DisplayKernels, SignalsPassThePoleAndBecomeLight) {
  constexpr std::size_t kSamples = 50, kSubsamples = 5;
  const LightTable table = tube_light(2.4, 0.001);
  const SignalResponse response = signal_response(kSubsamples, 0.4, table);
  std::vector<float> signal = random_values(kSamples * kRows, -0.5f, 2);  // also beyond the table
  signal[7] = 0;
  signal[8] = -0.0f;
  std::vector<float> expected(kSamples * kSubsamples * kRows);
  for (std::size_t row = 0; row < kRows; ++row) {
    float amplifier = 0;
    for (std::size_t sample = 0; sample < kSamples; ++sample) {
      const float target = signal[sample * kRows + row], step = amplifier - target;
      for (std::size_t k = 0; k < kSubsamples; ++k)
        expected[(sample * kSubsamples + k) * kRows + row] =
            table.at(std::fma(step, response.missing[k], target));
      amplifier = std::fma(step, response.missing_at_end, target);
    }
  }
  for (const InstructionSet isa : available_isas()) {
    std::vector<float> light(expected.size());
    signal_to_light_for(isa)(signal.data(), kSamples, response, light.data());
    EXPECT_EQ(light, expected) << static_cast<int>(isa);
  }
}

TEST(DisplayKernels, TubesHaveTheLightOfBt1886) {
  const LightTable table = tube_light(2.4, 0.001);
  const double root = std::pow(0.001, 1 / 2.4), b = root / (1 - root);
  for (int level = -20; level <= 300; ++level) {
    const double signal = level / 255.0;
    const double light = std::pow(1 - root, 2.4) * std::pow(std::max(signal + b, 0.0), 2.4);
    EXPECT_NEAR(table.at(static_cast<float>(signal)), light, 1e-6) << level;
  }
}

TEST(DisplayKernels, RowsAreWeightedSumsOfSamples) {
  constexpr std::size_t kSamples = 40, kPixels = 37;  // no whole block of columns
  const ResampleTable table =
      make_resample_table({kSamples, 0.5, 1}, {kPixels, 0.3, 1.04}, gaussian_spread(0.9, 1, 1.04, 0));
  const std::vector<float> light = random_values(kSamples * kRows, 0, 1);
  for (const InstructionSet isa : available_isas()) {
    std::vector<float> rows(kRows * kPixels);
    resample_rows_for(isa)(light.data(), table, kBlockRows, rows.data(), kPixels);
    for (std::size_t row = 0; row < kRows; ++row)
      for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
        float sum = 0;
        for (std::size_t tap = 0; tap < static_cast<std::size_t>(table.taps); ++tap)
          sum = std::fma(light[(static_cast<std::size_t>(table.first[pixel]) + tap) * kRows + row],
                         table.weights_of(static_cast<int>(pixel))[tap], sum);
        ASSERT_EQ(rows[row * kPixels + pixel], sum) << static_cast<int>(isa);
      }
  }
}

TEST(DisplayKernels, CodesAreThoseOfTheTable) {
  // Light of one colour that goes to red alone: every part of the curve, and what lies beyond it.
  std::vector<float> light{0, -0.0f, -1, 0x1p-13f, 0x1p-14f, 1, 2, std::numeric_limits<float>::denorm_min()};
  for (int i = 0; i < 4000; ++i) light.push_back(static_cast<float>(i) / 3990);
  const int columns = static_cast<int>(light.size());
  light.resize(light.size() + 16);
  ImageRow row{.columns = columns, .colors = 1};
  row.light[0] = {{light.data(), 1.0f}};
  row.srgb_from_light = {{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  for (const InstructionSet isa : available_isas()) {
    std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(columns), 99);
    row.rgb = rgb.data();
    image_row_for(isa)(row);
    for (std::size_t x = 0; x < static_cast<std::size_t>(columns); ++x) {
      ASSERT_EQ(rgb[3 * x], srgb_code(light[x])) << light[x] << " " << static_cast<int>(isa);
      ASSERT_EQ(rgb[3 * x + 1], 0);
    }
  }
}

}  // namespace
}  // namespace tessera::display_kernels_test
