// Signals and receivers on every instruction set, for rows alone and together, and against double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "framebuffer/instruction_set.h"
#include "tests/framebuffer/television_support.h"

namespace tessera::television_kernels_test {
namespace {

using namespace television_support;
using enum DisplayKind;

Picture random_picture(const VideoMode& mode) {
  std::mt19937 random(static_cast<unsigned>(mode.width));
  return make_picture(mode, [&](int, int) {
    return Level{static_cast<std::uint8_t>(random() % 256), static_cast<std::uint8_t>(random() % 256),
                 static_cast<std::uint8_t>(random() % 256)};
  });
}

struct Case {
  std::string name;
  DisplayKind kind;
  Television television;
  VideoMode mode;
};
std::vector<Case> cases() {
  const VideoMode broadcast{.width = 321, .height = 9}, wide{.width = 1601, .height = 2},
      tiny{.width = 1, .height = 1};
  VideoMode cga{.width = 640, .height = 5, .timing = kCgaTiming};
  VideoMode interlaced = cga, repeated = cga;
  interlaced.timing = ScanTiming{
      .pixel_clock_hz = 7.09379e6 * 2, .total_columns = 908, .total_lines = 625, .interlaced = true};
  repeated.timing->lines_per_row = 2;
  return {
      {"notch", ntsc, {}, broadcast},
      {"comb", ntsc, {.decoder = VideoDecoder::comb}, broadcast},
      {"svideo", ntsc, {.cable = VideoCable::svideo}, broadcast},
      {"wide", ntsc, {.luma_mhz = 8, .receiver_mhz = .1, .phase_deg = 33, .gain = 1.5}, wide},
      {"tiny", ntsc, {}, tiny},
      {"cga", ntsc, {}, cga},
      {"delay line", pal, {}, broadcast},
      {"simple", pal, {.decoder = VideoDecoder::simple, .receiver_mhz = 3}, broadcast},
      {"pal comb", pal, {.decoder = VideoDecoder::comb}, broadcast},
      {"pal svideo", pal, {.cable = VideoCable::svideo, .chroma_mhz = .1}, broadcast},
      {"interlaced", pal, {}, interlaced},
      {"repeated", pal, {}, repeated},
  };
}

std::vector<float> encode(const Case& c, const Picture& picture, InstructionSet isa) {
  const detail::TelevisionSignal signal(c.kind, c.television, c.mode, isa);
  return signal.encode_frame(picture.rgb.data(), picture.stride_bytes(), 3, 5).samples;
}

TEST(TelevisionKernels, EveryInstructionSetGivesTheSameBits) {
  for (const Case& c : cases()) {
    const Picture picture = random_picture(c.mode);
    const Decoded expected = decode(c.kind, c.television, picture, 5, InstructionSet::scalar);
    for (const InstructionSet isa : detail::available_isas()) {
      EXPECT_EQ(decode(c.kind, c.television, picture, 5, isa).values, expected.values)
          << c.name << ", " << static_cast<int>(isa);
      EXPECT_EQ(encode(c, picture, isa), encode(c, picture, InstructionSet::scalar)) << c.name;
    }
  }
}

TEST(TelevisionKernels, RowsAloneEqualRowsTogether) {
  for (const Case& c : cases()) {
    const Picture picture = random_picture(c.mode);
    const Decoded together = decode(c.kind, c.television, picture, 2);
    const detail::TelevisionSignal signal(c.kind, c.television, c.mode);
    const int row_size = 3 * signal.samples();
    for (int row = 0; row < c.mode.height; ++row) {
      std::vector<float> alone(static_cast<std::size_t>(row_size));
      signal.decode_rows(picture.rgb.data(), picture.stride_bytes(), 3, 2, row, row + 1, alone.data());
      EXPECT_TRUE(std::equal(alone.begin(), alone.end(), together.values.begin() + row * row_size))
          << c.name << ", row " << row;
    }
  }
}

TEST(TelevisionKernels, PixelsMayHaveFourBytes) {
  const Picture picture = random_picture({.width = 50, .height = 3});
  std::vector<std::uint8_t> padded;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    padded.insert(padded.end(), &picture.rgb[i], &picture.rgb[i] + 3);
    padded.push_back(77);
  }
  const detail::TelevisionSignal signal(ntsc, {}, picture.mode);
  std::vector<float> values(static_cast<std::size_t>(9 * signal.samples()));
  signal.decode_rows(padded.data(), 200, 4, 0, 0, 3, values.data());
  EXPECT_EQ(values, decode(ntsc, {}, picture).values);
}

/// exp(-2 pi^2 sigma^2 f^2) is sqrt(1/2) at this frequency.
auto gaussian(double mhz) {
  return [mhz](int j) {
    const double sigma = std::sqrt(std::log(2)) / (2 * std::numbers::pi * mhz * 1e6 / (4 * kSubcarrierHz));
    return std::exp(-j * j / (2 * sigma * sigma));
  };
}

/// The same model for NTSC with a notch, in double precision, with sines and filters of the mathematics
/// library, and each demodulated sample filtered by itself.
class DoubleReference {
 public:
  DoubleReference(const Picture& picture, int row, double first_angle) : first_angle_(first_angle) {
    const double samples_per_pixel = 52.7e-6 * 4 * kSubcarrierHz / picture.mode.width;
    for (int k = -kMargin; k < kSize - kMargin; ++k)
      for (std::size_t i = 0; i < 3; ++i)
        pixels_[i].push_back(mean(picture, row, k / samples_per_pixel, (k + 1) / samples_per_pixel)[i]);
    const auto sinc = [](int j) {
      const double x = std::numbers::pi * 2 * 4.2e6 / (4 * kSubcarrierHz) * j;
      return (j == 0 ? 1 : std::sin(x) / x) * (.54 + .46 * std::cos(std::numbers::pi * j / 25));
    };
    const std::vector<double> y = filtered(pixels_[0], 24, sinc);
    const std::vector<double> u = filtered(pixels_[1], 20, gaussian(1.3)),
                              v = filtered(pixels_[2], 20, gaussian(1.3));
    for (int k = 0; k < kSize; ++k) {
      const auto i = static_cast<std::size_t>(k);
      signal_.push_back(y[i] + u[i] * std::sin(angle(k)) + v[i] * std::cos(angle(k)));
      with_sine_.push_back(2 * signal_[i] * std::sin(angle(k)));
      with_cosine_.push_back(2 * signal_[i] * std::cos(angle(k)));
    }
    u_ = filtered(with_sine_, 40, gaussian(.5));
    v_ = filtered(with_cosine_, 40, gaussian(.5));
  }

  ColorValues yuv(int sample) const {
    const int k = sample + kMargin;
    const auto i = static_cast<std::size_t>(k);
    return {signal_[i] - u_[i] * std::sin(angle(k)) - v_[i] * std::cos(angle(k)), u_[i], v_[i]};
  }

 private:
  static constexpr int kMargin = 100, kSize = 1000;

  double angle(int k) const { return first_angle_ + std::numbers::pi / 2 * (k - kMargin); }

  static ColorValues mean(const Picture& picture, int row, double left, double right) {
    ColorValues sum{};
    for (int x = 0; x < picture.mode.width; ++x) {
      const double covered = std::min(right, x + 1.0) - std::max<double>(left, x);
      if (covered <= 0) continue;
      const std::uint8_t* p = &picture.rgb[static_cast<std::size_t>(3 * (row * picture.mode.width + x))];
      const ColorValues yuv = yuv_of({p[0], p[1], p[2]});
      for (std::size_t i = 0; i < 3; ++i) sum[i] += yuv[i] * covered / (right - left);
    }
    return sum;
  }

  template <class Tap>
  static std::vector<double> filtered(const std::vector<double>& in, int radius, const Tap& tap) {
    double gain = 0;
    for (int j = -radius; j <= radius; ++j) gain += tap(j);
    std::vector<double> out(in.size());
    for (int k = radius; k + radius < static_cast<int>(in.size()); ++k)
      for (int j = -radius; j <= radius; ++j)
        out[static_cast<std::size_t>(k)] += in[static_cast<std::size_t>(k + j)] * tap(j) / gain;
    return out;
  }

  double first_angle_;
  std::vector<double> pixels_[3], signal_, with_sine_, with_cosine_, u_, v_;
};

TEST(TelevisionKernels, AgreeWithDoublePrecision) {
  const Picture picture = random_picture({.width = 640, .height = 4});
  const Decoded decoded = decode(ntsc, {}, picture, 1);
  // Row 3 is the second of field 2. Four rows are in the middle of 240 lines that begin with the 23rd.
  const int line = 22 + (240 - 2) / 2 + 263 + 1;
  const double cycles = 119437.5 + line * 227.5;
  const DoubleReference reference(picture, 3, 2 * std::numbers::pi * (cycles - std::floor(cycles) - .25));
  for (int k = 0; k < decoded.samples; ++k) {
    const ColorValues found = yuv_from_rgb({decoded.at(3, 0, k), decoded.at(3, 1, k), decoded.at(3, 2, k)});
    const ColorValues expected = reference.yuv(k);
    // The Gaussians end at four standard deviations.
    for (std::size_t i = 0; i < 3; ++i) ASSERT_NEAR(found[i], expected[i], 3e-4) << k << ", " << i;
  }
}

}  // namespace
}  // namespace tessera::television_kernels_test
