// Pictures and measures for tests of chosen palettes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "framebuffer/color_counts.h"
#include "framebuffer/mode_table.h"
#include "framebuffer/oklab.h"

namespace tessera::detail::chosen_palette_support {

inline std::uint32_t packed(Rgb8 c) { return std::uint32_t{c.r} << 16 | std::uint32_t{c.g} << 8 | c.b; }

/// A picture of some gradients between random colours, with a flat background; `phase` 0 .. 1 moves the
/// colours.
inline ColorCounts gradients(unsigned seed, double phase = 0) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> words(3000, 0x203040);
  for (int gradient = 0; gradient < 6; ++gradient) {
    std::array<double, 12> ends{};  // from and to, in phase 0 and in phase 1
    for (double& end : ends) end = random() % 256;
    for (int i = 0; i < 1500; ++i) {
      const double t = i / 1499.0;
      std::uint32_t word = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double first = ends[c] + (ends[3 + c] - ends[c]) * t;
        const double last = ends[6 + c] + (ends[9 + c] - ends[6 + c]) * t;
        word = word << 8 | static_cast<std::uint32_t>(first + (last - first) * phase + 0.5);
      }
      words.push_back(word);
    }
  }
  ColorCounts picture;
  picture.add(words);
  return picture;
}

inline bool is_on_converter(Rgb8 c, int bits) {
  return is_converter_level(c.r, bits) && is_converter_level(c.g, bits) && is_converter_level(c.b, bits);
}
inline std::set<std::uint32_t> distinct(const std::vector<Rgb8>& entries) {
  std::set<std::uint32_t> set;
  for (const Rgb8& entry : entries) set.insert(packed(entry));
  return set;
}
inline std::vector<Oklab> oklab(const std::vector<Rgb8>& entries) {
  std::vector<Oklab> colors;
  for (const Rgb8& entry : entries) colors.push_back(oklab_from_rgb8(entry));
  return colors;
}

/// Mean squared distance in OKLab of the pixels to their nearest entries.
inline double mean_error(const ColorCounts& picture, const std::vector<Rgb8>& entries) {
  double sum = 0, pixels = 0;
  for (const WeightedColor& c : picture.all()) {
    double least = 1e300;
    for (const Oklab& entry : oklab(entries))
      least = std::min(least, squared_distance(oklab_from_rgb8(c.color), entry));
    sum += static_cast<double>(c.pixels) * least;
    pixels += static_cast<double>(c.pixels);
  }
  return sum / pixels;
}

}  // namespace tessera::detail::chosen_palette_support
