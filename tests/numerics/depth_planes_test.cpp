// Depths between the vertices, in each format: against the exact plane through the snapped vertices, from a few pixels to slivers, needles and
// triangles 16,384 pixels wide.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/case_renderer.h"
#include "tests/numerics/depth_formats.h"
#include "tests/numerics/window_triangle.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test {
namespace {

constexpr int kFraction = 24;  // depths are whole multiples of 2^-24: floats, and exact in clip space, too

/// Ends of the depth range, in eighths.
struct Range {
  int near = 0, far = 8;
};

struct Tilted {
  WindowTriangle triangle;
  std::array<std::int64_t, 3> z;
};

std::array<std::int64_t, 3> random_depths(Dice& dice) {
  constexpr std::int64_t kOne = std::int64_t{1} << kFraction;
  std::array<std::int64_t, 3> z{};
  if (dice.between(0, 3) == 0) {
    // A half is on the border between two levels: what is less by a hair has the one below.
    z.fill(kOne / 2);
    z[static_cast<std::size_t>(dice.between(0, 2))] = dice.between(0, kOne);
    return z;
  }
  const std::int64_t spread = dice.maybe() ? kOne : std::int64_t{1} << dice.between(0, kFraction);
  for (std::int64_t& each : z) {
    switch (dice.between(0, 5)) {
      case 0: each = dice.maybe() ? 0 : kOne; break;
      case 1: each = z[0]; break;
      default: each = std::clamp(z[0] + dice.between(-spread, spread), std::int64_t{0}, kOne); break;
    }
  }
  return z;
}

// The colour tells which triangle a pixel shows.
void add(CaseDraw& draw, const Tilted& tilted, std::size_t number, int width, int height) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double z = std::ldexp(static_cast<double>(tilted.z[k]), 1 - kFraction) - 1;
    for (const double c : {clip_x(tilted.triangle.at[k].x, width), clip_y(tilted.triangle.at[k].y, height), z, 1.0}) draw.positions.push_back(static_cast<float>(c));
    for (const std::size_t shift : {0, 8, 16}) draw.colors.push_back(static_cast<float>((number + 1) >> shift & 255) / 255);
    draw.colors.push_back(1);
  }
}
std::size_t number_of(const std::array<float, 3>& color) {
  const auto byte = [&](std::size_t c) { return static_cast<std::size_t>(std::lround(color[c] * 255)); };
  return (byte(0) | byte(1) << 8 | byte(2) << 16) - 1;  // the largest there is where nothing was drawn
}

struct Window {
  int width, height, frames;
};
constexpr Window kWindows[] = {{256, 256, 12}, {16384, 16, 2}, {16, 16384, 2}, {1, 1, 4}};

// Calls pixel(triangle, x, y, what is stored) wherever one is seen.
template <class Pixel>
std::size_t for_each_pixel(const MakeRenderer& make, const DepthCase& depth, WindowShape shape, int rounds, const Pixel& pixel, const Range& range = {}) {
  std::size_t seen = 0;
  Dice dice(70 + static_cast<std::uint32_t>(shape));
  for (const Window& window : kWindows) {
    const auto renderer = make({.width = window.width, .height = window.height, .depth = depth.format});
    // Large ones hide each other, needles hardly have a pixel.
    const std::size_t count = shape == WindowShape::any ? 8 : shape == WindowShape::needle ? 1000 : shape == WindowShape::small ? 400 : 50;
    for (int round = 0; round < rounds * window.frames; ++round) {
      std::vector<Tilted> all;
      CaseDraw draw{.test_depth = true, .depth_func = Compare::always, .depth_near = range.near / 8.0, .depth_far = range.far / 8.0};
      for (std::size_t n = 0; n < count; ++n) {
        all.push_back({random_triangle(dice, shape, window.width, window.height), random_depths(dice)});
        add(draw, all.back(), n, window.width, window.height);
      }
      const CasePicture& picture = renderer->draw({draw});
      for (int y = 0; y < window.height; ++y)
        for (int x = 0; x < window.width; ++x) {
          const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(window.width) + static_cast<std::size_t>(x), number = number_of(picture.colors[at]);
          if (number >= all.size() || !all[number].triangle.contains(WindowTriangle::center(x, y))) continue;
          pixel(all[number], x, y, picture.depth[at]);
          ++seen;
        }
    }
  }
  return seen;
}

// Of a depth in the whole range, as a part of area 2^kFraction.
Whole depth_numerator(const Tilted& t, const GridPoint& p) { return t.triangle.edge(0, p) * t.z[0] + t.triangle.edge(1, p) * t.z[1] + t.triangle.edge(2, p) * t.z[2]; }

const std::string kNames[] = {"small", "large", "on centres", "slivers", "needles"};
int rounds_of(bool is_tessera) { return is_tessera && long_tests() ? 40 : 1; }

TEST(DepthPlanes, AreWithinTheirLevels) {
  for (const DepthCase& depth : kUnorms)
    for (const WindowShape shape : kWindowShapes)
      expect_figure("depth, " + std::string(depth.name) + ", triangles " + kNames[static_cast<std::size_t>(shape)], depth.bits == 32 ? 4 : 1, "levels", [&](const MakeRenderer& make, bool is_tessera) {
        std::int64_t worst = 0;
        const std::size_t seen = for_each_pixel(make, depth, shape, rounds_of(is_tessera), [&](const Tilted& t, int x, int y, std::uint32_t stored) {
          const std::int64_t exact = exact_level(depth, depth_numerator(t, WindowTriangle::center(x, y)), t.triangle.area() << kFraction);
          worst = std::max(worst, std::abs(std::int64_t{stored} - exact));
        });
        EXPECT_GT(seen, 300u);
        return static_cast<long double>(worst);
      });
}

// Into a part of the range, and back to front; what leaves the range counts as wrong by all there is.
TEST(DepthPlanes, AreWithinTheirLevelsInNarrowedAndReversedRanges) {
  constexpr Range kRanges[] = {{2, 3}, {0, 1}, {7, 8}, {8, 0}, {5, 2}, {4, 4}};
  for (const DepthCase& depth : kUnorms)
    expect_figure("depth, " + std::string(depth.name) + ", ranges narrowed and reversed", depth.bits == 32 ? 4 : 1, "levels", [&](const MakeRenderer& make, bool is_tessera) {
      std::int64_t worst = 0;
      for (const Range& range : kRanges) {
        const auto ends = std::minmax({exact_level(depth, range.near, 8), exact_level(depth, range.far, 8)});
        const auto check = [&](const Tilted& t, int x, int y, std::uint32_t stored) {
          const Whole denominator = t.triangle.area() << kFraction;
          const Whole moved = denominator * range.near + depth_numerator(t, WindowTriangle::center(x, y)) * (range.far - range.near);
          worst = std::max(worst, stored < ends.first || stored > ends.second ? depth.levels() : std::abs(stored - exact_level(depth, moved, denominator * 8)));
        };
        for_each_pixel(make, depth, WindowShape::any, rounds_of(is_tessera), check, range);
      }
      return static_cast<long double>(worst);
    });
}

// The plane is one of doubles, off by 2^-52 of its gradients' terms and of its own, which only needles feel; the depth is rounded once, and cut to the
// vertices' range.
TEST(DepthPlanes, OfFloatsAreWithinTheirRoundings) {
  for (const WindowShape shape : kWindowShapes)
    expect_figure("depth, floats, triangles " + kNames[static_cast<std::size_t>(shape)], 1, "of one rounding", [&](const MakeRenderer& make, bool is_tessera) {
      long double worst = 0;
      for_each_pixel(make, kFloat32, shape, rounds_of(is_tessera), [&](const Tilted& t, int x, int y, std::uint32_t stored) {
        const std::size_t anchor = t.triangle.topmost();
        const GridPoint at = WindowTriangle::center(x, y), &first = t.triangle.at[anchor];
        const auto area = static_cast<long double>(t.triangle.area());
        const auto depth = [&](std::size_t k) { return std::ldexp(static_cast<long double>(t.z[k]), -kFraction); };
        // What an edge gains along x or y, from the anchor to the pixel.
        const auto gains = [&](std::size_t k) {
          const long double along_x = static_cast<long double>(t.triangle.edge(k, {at.x, first.y}) - t.triangle.edge(k, first)), along_y = static_cast<long double>(t.triangle.edge(k, {first.x, at.y}) - t.triangle.edge(k, first));
          return std::array<long double, 2>{along_x * (depth(k) - depth(anchor)) / area, along_y * (depth(k) - depth(anchor)) / area};
        };
        const auto of_second = gains((anchor + 1) % 3), of_third = gains((anchor + 2) % 3);
        const long double terms = std::abs(of_second[0]) + std::abs(of_third[0]) + std::abs(of_second[1]) + std::abs(of_third[1]);
        const auto [low, high] = std::minmax({depth(0), depth(1), depth(2)});
        const long double exact = static_cast<long double>(depth_numerator(t, at)) / area * 0x1p-24L, bound = std::min(0x1p-24L * exact + 0x1p-50L * (depth(anchor) + terms), high - low);
        const long double error = std::abs(float_of(stored) - exact);
        if (error > bound || bound > 0) worst = std::max(worst, bound > 0 ? error / bound : 0x1p24L * error);  // all the same: exactly that
      });
      return worst;
    });
}

TEST(DepthPlanes, NeverLeaveTheRangeOfTheVertices) {
  for (const DepthCase& depth : kDepthCases)
    expect_figure("depth, " + std::string(depth.name) + ", beyond the vertices' own", 0, "levels", [&](const MakeRenderer& make, bool is_tessera) {
      std::int64_t worst = 0;
      for (const WindowShape shape : kWindowShapes)
        for_each_pixel(make, depth, shape, rounds_of(is_tessera), [&](const Tilted& t, int, int, std::uint32_t stored) {
          const auto [low, high] = std::minmax({t.z[0], t.z[1], t.z[2]});
          const auto level = [&](std::int64_t z) {
            if (depth.is_float()) return std::int64_t{std::bit_cast<std::uint32_t>(std::ldexp(static_cast<float>(z), -kFraction))};  // floats above 0 count upwards as their bits do
            return exact_level(depth, z, Whole{1} << kFraction);
          };
          worst = std::max({worst, level(low) - stored, stored - level(high)});
        });
      return static_cast<long double>(worst);
    });
}

}  // namespace
}  // namespace tessera::test
