// Pairs of pictures whose FLIP errors are known: computed by NVIDIA's implementation, version 1.7.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/program/compare/pixel_view.h"

namespace tessera::program {

using Rgb = std::array<int, 3>;

/// A picture of 3 bytes per pixel.
struct RgbPicture {
  RgbPicture(int width_px, int height_px, const std::function<Rgb(int x, int y)>& color_at)
      : width(width_px), height(height_px) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (const int component : color_at(x, y)) rgb.push_back(static_cast<std::uint8_t>(component));
  }
  PixelView view() const {
    return {.pixels = rgb.data(), .width = width, .height = height, .pixel_bytes = 3};
  }

  int width, height;
  std::vector<std::uint8_t> rgb;
};

struct KnownFlipPair {
  std::string name;
  RgbPicture reference;
  RgbPicture test;
  double mean_at_67, largest_at_67;  ///< 67.0206 pixels per degree
  double mean_at_20;                 ///< 20 pixels per degree
};

inline std::vector<KnownFlipPair> known_flip_pairs() {
  using ColorAt = std::function<Rgb(int, int)>;
  constexpr int kSide = 64;
  const auto gray = [](int level) { return Rgb{level, level, level}; };
  const auto uniform = [](Rgb color) -> ColorAt { return [color](int, int) { return color; }; };
  const auto white_if = [gray](auto condition) -> ColorAt {
    return [=](int x, int y) { return gray(condition(x, y) ? 255 : 0); };
  };
  const ColorAt checkerboard = white_if([](int x, int y) { return (x + y) % 2 == 1; });
  // Ordered dither of grey 128: its light is 0.215861.
  const ColorAt bayer = white_if([](int x, int y) {
    constexpr int kCell[2][2] = {{0, 2}, {3, 1}};
    const int threshold = 4 * kCell[y & 1][x & 1] + kCell[y >> 1 & 1][x >> 1 & 1];
    return 0.215861 + (threshold + 0.5) / 16 >= 1;
  });
  const auto ramps = [](int x, int y) { return Rgb{4 * x, 4 * y, 128}; };
  const auto red_squares = [](int x, int y) {
    const int change = (x / 8 + y / 8) % 2 == 1 ? 16 : -16;
    return Rgb{std::clamp(4 * x + change, 0, 255), 4 * y, 128};
  };
  std::vector<KnownFlipPair> pairs;
  const auto add = [&](const char* name, int side, const ColorAt& reference, const ColorAt& test,
                       double mean_at_67, double largest_at_67, double mean_at_20) {
    pairs.push_back({name, RgbPicture(side, side, reference), RgbPicture(side, side, test), mean_at_67,
                     largest_at_67, mean_at_20});
  };
  add("black, white", kSide, uniform(gray(0)), uniform(gray(255)), .967388, .967388, .967391);
  add("green, blue", kSide, uniform({0, 255, 0}), uniform({0, 0, 255}), 1, 1, 1);
  add("red, cyan", kSide, uniform({255, 0, 0}), uniform({0, 255, 255}), .979911, .979911, .979911);
  add("128, 140", kSide, uniform(gray(128)), uniform(gray(140)), .169142, .169142, .169141);
  add("128, 129", kSide, uniform(gray(128)), uniform(gray(129)), .029863, .029863, .029867);
  add("188, checkerboard", kSide, uniform(gray(188)), checkerboard, .019631, .519358, .776739);
  add("128, checkerboard", kSide, uniform(gray(128)), checkerboard, .515112, .789678, .823852);
  add("edge moved by a pixel", kSide, white_if([](int x, int) { return x >= 32; }),
      white_if([](int x, int) { return x >= 33; }), .051732, .772917, .031332);
  add(
      "ramp in 16 steps", kSide, [=](int x, int) { return gray(4 * x); },
      [=](int x, int) { return gray(16 * (x / 4)); }, .120800, .211069, .125033);
  add("ramps, red squares", kSide, ramps, red_squares, .134504, .295136, .173680);
  add("128, ordered dither", kSide, uniform(gray(128)), bayer, .195752, .838094, .939134);
  add("a white pixel", 65, uniform(gray(0)), white_if([](int x, int y) { return x == 32 && y == 32; }),
      .003387, .864906, .000688);
  add("equal", kSide, ramps, ramps, 0, 0, 0);
  return pairs;
}

}  // namespace tessera::program
