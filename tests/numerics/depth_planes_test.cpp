// Depth between the vertices in each format, against the exact plane through the snapped vertices: from a few
// pixels to slivers, needles and triangles 16,384 pixels wide.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/case_renderer.h"
#include "tests/numerics/depth_formats.h"
#include "tests/numerics/tilted_triangles.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::depth_planes_test {
namespace {

TEST(DepthPlanes, UnormDepthsAreWithinTheirLevels) {
  for (const DepthCase& depth : kUnorms)
    for (const WindowShape shape : kWindowShapes)
      expect_figure("depth, " + std::string(depth.name) + ", triangles " + name_of(shape),
                    depth.bits == 32 ? 4 : 1, "levels", [&](const MakeRenderer& make, bool is_tessera) {
                      std::int64_t worst = 0;
                      const std::size_t visible_pixels =
                          for_each_pixel(make, depth, shape, rounds_of(is_tessera),
                                         [&](const Tilted& t, int x, int y, std::uint32_t stored) {
                                           const std::int64_t exact = exact_level(
                                               depth, depth_numerator(t, WindowTriangle::center(x, y)),
                                               t.triangle.area() << kFraction);
                                           worst = std::max(worst, std::abs(std::int64_t{stored} - exact));
                                         });
                      EXPECT_GT(visible_pixels, 300u);
                      return static_cast<long double>(worst);
                    });
}

// Maps into part of the range, and reversed. A depth outside the range counts as the maximum error.
TEST(DepthPlanes, UnormDepthsAreWithinTheirLevelsInNarrowedAndReversedRanges) {
  constexpr DepthRange kRanges[] = {{2, 3}, {0, 1}, {7, 8}, {8, 0}, {5, 2}, {4, 4}};
  for (const DepthCase& depth : kUnorms)
    expect_figure(
        "depth, " + std::string(depth.name) + ", ranges narrowed and reversed", depth.bits == 32 ? 4 : 1,
        "levels", [&](const MakeRenderer& make, bool is_tessera) {
          std::int64_t worst = 0;
          for (const DepthRange& range : kRanges) {
            const auto ends =
                std::minmax({exact_level(depth, range.near, 8), exact_level(depth, range.far, 8)});
            const auto check = [&](const Tilted& t, int x, int y, std::uint32_t stored) {
              const Whole denominator = t.triangle.area() << kFraction;
              const Whole moved = denominator * range.near +
                                  depth_numerator(t, WindowTriangle::center(x, y)) * (range.far - range.near);
              worst = std::max(worst, stored < ends.first || stored > ends.second
                                          ? depth.levels()
                                          : std::abs(stored - exact_level(depth, moved, denominator * 8)));
            };
            EXPECT_GT(
                for_each_pixel(make, depth, WindowShape::any, rounds_of(is_tessera), check, {.range = range}),
                10000u);
          }
          return static_cast<long double>(worst);
        });
}

// The plane is evaluated in double. Each gradient term goes through 8 roundings of 2^-53 (a difference, two
// products, a sum, the reciprocal area, the product with the distance, two sums), which only matter for
// needles. The depth is rounded once and clamped to the vertices' range.
TEST(DepthPlanes, FloatDepthsAreWithinTheirRoundings) {
  for (const WindowShape shape : kWindowShapes)
    expect_figure("depth, floats, triangles " + name_of(shape), 1, "of one rounding",
                  [&](const MakeRenderer& make, bool is_tessera) {
                    long double worst = 0;
                    const std::size_t visible_pixels = for_each_pixel(
                        make, kFloat32, shape, rounds_of(is_tessera),
                        [&](const Tilted& t, int x, int y, std::uint32_t stored) {
                          const std::size_t anchor = t.triangle.topmost();
                          const GridPoint at = WindowTriangle::center(x, y);
                          const GridPoint& first = t.triangle.at[anchor];
                          const auto area = static_cast<long double>(t.triangle.area());
                          const auto depth = [&](std::size_t k) {
                            return std::ldexp(static_cast<long double>(t.z[k]), -kFraction);
                          };
                          // Change of the interpolated depth along x and y, from the anchor to the pixel.
                          const auto gains = [&](std::size_t k) {
                            const long double along_x = static_cast<long double>(
                                t.triangle.edge(k, {at.x, first.y}) - t.triangle.edge(k, first));
                            const long double along_y = static_cast<long double>(
                                t.triangle.edge(k, {first.x, at.y}) - t.triangle.edge(k, first));
                            return std::array<long double, 2>{along_x * (depth(k) - depth(anchor)) / area,
                                                              along_y * (depth(k) - depth(anchor)) / area};
                          };
                          const auto of_second = gains((anchor + 1) % 3);
                          const auto of_third = gains((anchor + 2) % 3);
                          const long double terms = std::abs(of_second[0]) + std::abs(of_third[0]) +
                                                    std::abs(of_second[1]) + std::abs(of_third[1]);
                          const auto [low, high] = std::minmax({depth(0), depth(1), depth(2)});
                          const long double exact =
                              static_cast<long double>(depth_numerator(t, at)) / area * 0x1p-24L;
                          const long double bound =
                              std::min(0x1p-24L * exact + 0x1p-50L * (depth(anchor) + terms), high - low);
                          const long double error = std::abs(float_of(stored) - exact);
                          // If all three depths are equal, the depth is exact.
                          if (!(error <= bound) || bound > 0)
                            update_worst(worst, bound > 0 ? error / bound : 0x1p24L * error);
                        });
                    EXPECT_GT(visible_pixels, 300u);
                    return worst;
                  });
}

TEST(DepthPlanes, DepthsStayWithinTheRangeOfTheVertices) {
  for (const DepthCase& depth : kDepthCases)
    expect_figure("depth, " + std::string(depth.name) + ", beyond the vertices' own", 0, "levels",
                  [&](const MakeRenderer& make, bool is_tessera) {
                    std::int64_t worst = 0;
                    std::size_t visible_pixels = 0;
                    for (const WindowShape shape : kWindowShapes)
                      visible_pixels += for_each_pixel(
                          make, depth, shape, rounds_of(is_tessera),
                          [&](const Tilted& t, int, int, std::uint32_t stored) {
                            const auto [low, high] = std::minmax({t.z[0], t.z[1], t.z[2]});
                            const auto level = [&](std::int64_t z) {
                              // Positive floats order like their bits.
                              if (depth.is_float())
                                return std::int64_t{std::bit_cast<std::uint32_t>(
                                    std::ldexp(static_cast<float>(z), -kFraction))};
                              return exact_level(depth, z, Whole{1} << kFraction);
                            };
                            worst = std::max({worst, level(low) - stored, stored - level(high)});
                          });
                    EXPECT_GT(visible_pixels, 10000u);
                    return static_cast<long double>(worst);
                  });
}

}  // namespace
}  // namespace tessera::test::depth_planes_test
