// Pictures and measurements for the tests of television signals.
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "framebuffer/display/television_signal.h"
#include "framebuffer/tessera/color.hpp"
#include "framebuffer/tessera/screen.hpp"

namespace tessera::television_support {

using Level = std::array<std::uint8_t, 3>;

inline constexpr double kSubcarrierHz = 315e6 / 88;
inline constexpr ScanTiming kCgaTiming{
    .pixel_clock_hz = 4 * kSubcarrierHz, .total_columns = 912, .total_lines = 262};
inline const VideoMode kCga{.width = 640, .height = 200, .pixel_aspect = 5.0 / 12, .timing = kCgaTiming};

/// Bars of 75 % in the usual order.
inline const std::array<Level, 8> kBars{{{191, 191, 191},
                                         {191, 191, 0},
                                         {0, 191, 191},
                                         {0, 191, 0},
                                         {191, 0, 191},
                                         {191, 0, 0},
                                         {0, 0, 191},
                                         {0, 0, 0}}};

struct Picture {
  VideoMode mode;
  std::vector<std::uint8_t> rgb;
  std::ptrdiff_t stride_bytes() const { return std::ptrdiff_t{3} * mode.width; }
};

/// A picture whose pixel (x, y) is pixel(x, y).
template <class Pixel>
Picture make_picture(const VideoMode& mode, const Pixel& pixel) {
  Picture picture{mode, {}};
  for (int y = 0; y < mode.height; ++y)
    for (int x = 0; x < mode.width; ++x)
      for (const std::uint8_t level : pixel(x, y)) picture.rgb.push_back(level);
  return picture;
}

/// Upright bars of equal widths.
inline Picture bars(const VideoMode& mode) {
  return make_picture(mode, [&](int x, int) { return kBars[static_cast<std::size_t>(8 * x / mode.width)]; });
}

/// White where the pattern, which repeats, has '1'.
inline Picture pattern(const VideoMode& mode, const std::string& bits) {
  return make_picture(mode, [&](int x, int) {
    const auto level =
        static_cast<std::uint8_t>(bits[static_cast<std::size_t>(x) % bits.size()] == '1' ? 255 : 0);
    return Level{level, level, level};
  });
}

/// Amplitude and phase of a part of a signal at the subcarrier, which has four samples per cycle.
/// - x[i] = amplitude * sin(90 i + phase degrees), with i counted from sample 0 of the line.
/// @param count  a multiple of four
inline std::complex<double> subcarrier_at(const float* line, int first, int count) {
  std::complex<double> sum = 0;
  for (int i = first; i < first + count; ++i)
    sum += static_cast<double>(line[i]) * std::polar(2.0 / count, -std::numbers::pi / 2 * i);
  return sum * std::complex<double>(0, 1);
}

inline double mean_at(const float* line, int first, int count) {
  double sum = 0;
  for (int i = first; i < first + count; ++i) sum += static_cast<double>(line[i]);
  return sum / count;
}

inline double degrees_of(std::complex<double> z) { return std::arg(z) * 180 / std::numbers::pi; }

/// The difference of two angles, -180 to 180.
inline double turned(double degrees, double from) { return std::remainder(degrees - from, 360.0); }

/// Decoded rows: [row][component][sample].
struct Decoded {
  int samples;
  std::vector<float> values;

  double at(int row, int component, int sample) const {
    return static_cast<double>(values[static_cast<std::size_t>((row * 3 + component) * samples + sample)]);
  }
  /// Y, U, V, averaged over `count` samples around a share of the line's length.
  ColorValues yuv(int row, double position, int count = 8) const {
    ColorValues mean{};
    for (int k = 0; k < count; ++k) {
      const int sample = static_cast<int>(position * samples) - count / 2 + k;
      const ColorValues yuv = yuv_from_rgb({at(row, 0, sample), at(row, 1, sample), at(row, 2, sample)});
      for (std::size_t i = 0; i < 3; ++i) mean[i] += yuv[i] / count;
    }
    return mean;
  }
};

inline Decoded decode(DisplayKind kind, const Television& television, const Picture& picture,
                      std::int64_t frame = 0, InstructionSet isa = InstructionSet::automatic) {
  const detail::TelevisionSignal signal(kind, television, picture.mode, isa);
  Decoded decoded{signal.samples(), {}};
  decoded.values.resize(static_cast<std::size_t>(3 * signal.samples() * picture.mode.height));
  signal.decode_rows(picture.rgb.data(), picture.stride_bytes(), 3, frame, 0, picture.mode.height,
                     decoded.values.data());
  return decoded;
}

inline double saturation(const ColorValues& yuv) { return std::hypot(yuv[1], yuv[2]); }
inline double hue(const ColorValues& yuv) { return std::atan2(yuv[2], yuv[1]) * 180 / std::numbers::pi; }
/// Y, U, V of 8-bit levels.
inline ColorValues yuv_of(const Level& level) {
  return yuv_from_rgb({level[0] / 255.0, level[1] / 255.0, level[2] / 255.0});
}

}  // namespace tessera::television_support
