// Random triangles of any shape and depth gradient in windows of any size; identical in each call.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tests/numerics/case_renderer.h"
#include "tests/numerics/depth_formats.h"
#include "tests/numerics/window_triangle.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test {

// Depths are multiples of 2^-24: floats, and exact in clip space as well.
inline constexpr int kFraction = 24;

/// Ends of the depth range, in eighths.
struct DepthRange {
  int near = 0, far = 8;
};

struct Tilted {
  WindowTriangle triangle;
  std::array<std::int64_t, 3> z;
};

inline std::array<std::int64_t, 3> random_depths(Rng& rng) {
  constexpr std::int64_t kOne = std::int64_t{1} << kFraction;
  std::array<std::int64_t, 3> z{};
  if (rng.between(0, 3) == 0) {
    // A half lies on the border between two levels; the next smaller depth has the level below.
    z.fill(kOne / 2);
    z[static_cast<std::size_t>(rng.between(0, 2))] = rng.between(0, kOne);
    return z;
  }
  const std::int64_t spread = rng.maybe() ? kOne : std::int64_t{1} << rng.between(0, kFraction);
  for (std::int64_t& each : z) {
    switch (rng.between(0, 5)) {
      case 0: each = rng.maybe() ? 0 : kOne; break;
      case 1: each = z[0]; break;
      default: each = std::clamp(z[0] + rng.between(-spread, spread), std::int64_t{0}, kOne); break;
    }
  }
  return z;
}

// The colour identifies the triangle of a pixel.
inline void add(CaseDraw& draw, const Tilted& tilted, std::size_t number, int width, int height) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double z = std::ldexp(static_cast<double>(tilted.z[k]), 1 - kFraction) - 1;
    for (const double c :
         {clip_x(tilted.triangle.at[k].x, width), clip_y(tilted.triangle.at[k].y, height), z, 1.0})
      draw.positions.push_back(static_cast<float>(c));
    for (const std::size_t shift : {0, 8, 16})
      draw.colors.push_back(static_cast<float>((number + 1) >> shift & 255) / 255);
    draw.colors.push_back(1);
  }
}
inline std::size_t number_of(const std::array<float, 3>& color) {
  const auto byte = [&](std::size_t c) { return static_cast<std::size_t>(std::lround(color[c] * 255)); };
  return (byte(0) | byte(1) << 8 | byte(2) << 16) - 1;  // the largest number if nothing was drawn
}

struct Window {
  int width;
  int height;
  int frames;
};
inline constexpr Window kWindows[] = {{256, 256, 12}, {16384, 16, 2}, {16, 16384, 2}, {1, 1, 4}};

struct TiltedState {
  DepthRange range{};
  PolygonOffset offset{};
  std::span<const Window> windows = kWindows;
};

// Calls pixel(triangle, x, y, stored depth) for each visible pixel.
template <class Pixel>
std::size_t for_each_pixel(const MakeRenderer& make, const DepthCase& depth, WindowShape shape, int rounds,
                           const Pixel& pixel, const TiltedState& state = {}) {
  std::size_t visible_pixels = 0;
  Rng rng(70 + static_cast<std::uint32_t>(shape));
  for (const Window& window : state.windows) {
    const auto renderer = make({.width = window.width, .height = window.height, .depth = depth.format});
    // Large triangles hide each other; needles cover few pixels.
    std::size_t count = 50;
    if (shape == WindowShape::any) count = 8;
    if (shape == WindowShape::needle) count = 1000;
    if (shape == WindowShape::small) count = 400;
    for (int round = 0; round < rounds * window.frames; ++round) {
      std::vector<Tilted> all;
      CaseDraw draw{.test_depth = true,
                    .depth_func = Compare::always,
                    .depth_near = state.range.near / 8.0,
                    .depth_far = state.range.far / 8.0,
                    .offset = state.offset};
      for (std::size_t n = 0; n < count; ++n) {
        all.push_back({random_triangle(rng, shape, window.width, window.height), random_depths(rng)});
        add(draw, all.back(), n, window.width, window.height);
      }
      const CasePicture& picture = renderer->draw({draw});
      for (int y = 0; y < window.height; ++y)
        for (int x = 0; x < window.width; ++x) {
          const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(window.width) +
                                 static_cast<std::size_t>(x);
          const std::size_t number = number_of(picture.colors[at]);
          if (number >= all.size() || !all[number].triangle.contains(WindowTriangle::center(x, y))) continue;
          pixel(all[number], x, y, picture.depth[at]);
          ++visible_pixels;
        }
    }
  }
  return visible_pixels;
}

// Depth in the whole range, as a multiple of 1 / (area * 2^kFraction).
inline Whole depth_numerator(const Tilted& t, const GridPoint& p) {
  return t.triangle.edge(0, p) * t.z[0] + t.triangle.edge(1, p) * t.z[1] + t.triangle.edge(2, p) * t.z[2];
}

inline std::string name_of(WindowShape shape) {
  constexpr const char* kNames[] = {"small", "large", "on centres", "slivers", "needles"};
  return kNames[static_cast<std::size_t>(shape)];
}
inline int rounds_of(bool is_tessera) { return is_tessera && long_tests() ? 40 : 1; }

}  // namespace tessera::test
