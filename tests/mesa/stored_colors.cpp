#include "stored_colors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tessera::mesa {
namespace {

using Shown = std::array<std::uint8_t, 3>;

std::uint8_t shown_level(double c, int bits) {
  const double top = static_cast<double>((1 << bits) - 1);
  return static_cast<std::uint8_t>(std::lround(255 * std::floor(c * top + 0.5) / top));
}

// Blue has a third of the bits; a first remaining bit goes to green, a second one to red.
Shown split_levels(const std::array<double, 3>& c, int bits) {
  const int blue = bits / 3;
  const int green = (bits + 2) / 3;
  const int red = bits - green - blue;
  return {shown_level(c[0], red), shown_level(c[1], green), shown_level(c[2], blue)};
}

Shown luminance_level(const std::array<double, 3>& c, int bits) {
  const std::uint8_t level = shown_level(0.30 * c[0] + 0.59 * c[1] + 0.11 * c[2], bits);
  return {level, level, level};
}

Shown nearest_entry(const std::array<double, 3>& c, const std::vector<reference::Rgb8>& palette) {
  Shown best{};
  double least = 4;
  for (const reference::Rgb8& entry : palette) {
    double distance = 0;
    for (std::size_t i = 0; i < 3; ++i) distance += (entry[i] / 255.0 - c[i]) * (entry[i] / 255.0 - c[i]);
    if (distance < least) {
      least = distance;
      best = entry;
    }
  }
  return best;
}

Shown shown_color(const std::array<double, 3>& c, const reference::FrameBufferFormat& format) {
  if (format.color_mode == reference::ColorMode::kIndex) return nearest_entry(c, format.palette);
  return format.color_bits < 3 ? luminance_level(c, format.color_bits) : split_levels(c, format.color_bits);
}

}  // namespace

std::vector<std::uint8_t> shown_colors(const std::vector<float>& colors,
                                       const reference::FrameBufferFormat& format) {
  const auto row_floats = static_cast<std::size_t>(format.width_px) * 3;
  std::vector<std::uint8_t> shown;
  for (std::size_t row = static_cast<std::size_t>(format.height_px); row-- > 0;)
    for (std::size_t at = row * row_floats; at < (row + 1) * row_floats; at += 3) {
      std::array<double, 3> c;
      for (std::size_t i = 0; i < 3; ++i) c[i] = std::clamp<double>(colors[at + i], 0, 1);
      const Shown pixel = shown_color(c, format);
      shown.insert(shown.end(), pixel.begin(), pixel.end());
    }
  return shown;
}

}  // namespace tessera::mesa
