// Polygon offset, against the same triangles without offset and the exact slope of the plane through the
// snapped vertices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/tilted_triangles.h"

namespace tessera::test::depth_offset_test {
namespace {

// One window: an offset does not depend on it.
constexpr Window kWindow[] = {{256, 256, 6}};

// Calls pixel(triangle, offset, stored depth without offset, stored depth with offset).
template <class Pixel>
void for_each_pair(const MakeRenderer& make, const DepthCase& depth, int rounds,
                   const std::vector<PolygonOffset>& offsets, const Pixel& pixel) {
  for (const WindowShape shape : kWindowShapes) {
    std::vector<std::uint32_t> plain;
    for_each_pixel(make, depth, shape, rounds,
                   [&](const Tilted&, int, int, std::uint32_t stored) { plain.push_back(stored); },
                   {.windows = kWindow});
    EXPECT_GT(plain.size(), 300u) << name_of(shape);
    for (const PolygonOffset& offset : offsets) {
      std::size_t i = 0;
      for_each_pixel(
          make, depth, shape, rounds,
          [&](const Tilted& t, int, int, std::uint32_t stored) { pixel(t, offset, plain.at(i++), stored); },
          {.offset = offset, .windows = kWindow});
      EXPECT_EQ(i, plain.size());
    }
  }
}

TEST(DepthOffset, WholeUnitsAreExact) {
  for (const DepthCase& depth : kUnorms)
    expect_figure(
        "depth, " + std::string(depth.name) + ", offset by whole units", 0, "levels",
        [&](const MakeRenderer& make, bool is_tessera) {
          std::int64_t worst = 0;
          for_each_pair(
              make, depth, rounds_of(is_tessera), {{0, 1}, {0, -1}, {0, -1000}},
              [&](const Tilted&, const PolygonOffset& offset, std::uint32_t plain, std::uint32_t stored) {
                const std::int64_t expected = std::clamp(plain + static_cast<std::int64_t>(offset.units),
                                                         std::int64_t{0}, depth.levels());
                worst = std::max(worst, std::abs(stored - expected));
              });
          return static_cast<long double>(worst);
        });
}

/// Depth change per pixel, in fractions of the whole range.
struct Slope {
  long double steepest = 0;     // max(|dz/dx|, |dz/dy|)
  long double of_rounding = 0;  // change of the slope if each vertex depth changes by 1
  long double terms = 0;        // sum of the magnitudes whose difference is the slope
};
Slope slope_of(const Tilted& t) {
  long double along[2] = {};
  long double rounding[2] = {};
  long double terms[2] = {};
  const GridPoint origin;
  for (std::size_t k = 0; k < 3; ++k) {
    const GridPoint steps[] = {{kGrid, 0}, {0, kGrid}};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const long double weight =
          static_cast<long double>(t.triangle.edge(k, steps[axis]) - t.triangle.edge(k, origin)) /
          static_cast<long double>(t.triangle.area());
      const long double z = std::ldexp(static_cast<long double>(t.z[k]), -kFraction);
      along[axis] += weight * z;
      rounding[axis] += std::abs(weight);
      terms[axis] += std::abs(weight * z);
    }
  }
  return {std::max(std::abs(along[0]), std::abs(along[1])), std::max(rounding[0], rounding[1]),
          std::max(terms[0], terms[1])};
}

const std::vector<PolygonOffset> kOffsets = {{1, 0}, {-1, -1}, {2.5f, 3.25f}, {-0.125f, 0.75f}, {1000, 0}};

// Depths of 32 bits move by one rounded offset; the rounding of the vertex depths also changes the slope. At
// 16 and 24 bits the part below one level is invisible.
TEST(DepthOffset, SlopesRoundOnce) {
  for (const DepthCase& depth : kUnorms)
    expect_figure(
        "depth, " + std::string(depth.name) + ", offset by slopes", 1, "of one rounding",
        [&](const MakeRenderer& make, bool is_tessera) {
          long double worst = 0;
          for_each_pair(
              make, depth, rounds_of(is_tessera), kOffsets,
              [&](const Tilted& t, const PolygonOffset& offset, std::uint32_t plain, std::uint32_t stored) {
                const Slope slope = slope_of(t);
                const auto levels = static_cast<long double>(depth.levels());
                const auto word = std::ldexp(1.0L, depth.bits - 32);
                const auto factor = static_cast<long double>(std::abs(offset.factor));
                const long double move = offset.factor * slope.steepest * levels + offset.units;
                const long double of_vertices = 0.5L * word * factor * slope.of_rounding;
                const long double of_gradients = 0x1p-51L * factor * slope.terms * levels;
                const long double bound =
                    (depth.bits == 32 ? 0.5L : 1.0L) + 0.5L * word + of_vertices + of_gradients;
                update_worst(worst, std::abs(stored - std::clamp(plain + move, 0.0L, levels)) / bound);
              });
          return worst;
        });
}

TEST(DepthOffset, FloatDepthsRoundTwice) {
  expect_figure(
      "depth, floats, offset by slopes and units", 1, "of u of the depth and of the offset",
      [&](const MakeRenderer& make, bool is_tessera) {
        long double worst = 0;
        for_each_pair(
            make, kFloat32, rounds_of(is_tessera), kOffsets,
            [&](const Tilted& t, const PolygonOffset& offset, std::uint32_t plain, std::uint32_t stored) {
              const Slope slope = slope_of(t);
              const std::int64_t largest = std::max({t.z[0], t.z[1], t.z[2]});
              // At the largest depth of the triangle.
              const long double unit = std::ldexp(
                  1.0L, (largest > 0 ? std::ilogb(static_cast<double>(largest)) - kFraction : -126) - 23);
              const long double move = offset.factor * slope.steepest + offset.units * unit;
              const long double exact = std::clamp(float_of(plain) + move, 0.0L, 1.0L);
              const long double bound = 0x1p-24L * (exact + std::abs(move)) +
                                        0x1p-51L * std::abs(offset.factor) * slope.terms + 0x1p-149L;
              update_worst(worst, std::abs(float_of(stored) - exact) / bound);
            });
        return worst;
      });
}

}  // namespace
}  // namespace tessera::test::depth_offset_test
