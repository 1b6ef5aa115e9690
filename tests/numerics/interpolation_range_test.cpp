// Interpolated values before rounding to levels: their error, and how far they leave the range of the three
// vertices; from the kernels' barycentric coordinates on each instruction set. The last step uses the scalar
// twin, whose bits the kernels match (Interpolate in tests/shading).
//
// u = 2^-24. A weight is a product of positive factors, each rounded once. Where vertex 0 has no weight (on
// the opposite edge), b1 + b2 is off by at most 4 u: two sums, quotient, product; or, without perspective,
// 1/area, its product, the edge and the multiply-add. So first + b1 (second - first) + b2 (third - first)
// leaves the range by at most 4 u of the larger difference, plus one u each of that difference and of the
// results of the two sums. Let M be the largest magnitude of the three. With equal signs, differences are at
// most M: 7 u M in total. With mixed signs, differences are at most 2 M: 12 u M.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "shading/interpolate_reference.h"
#include "tests/numerics/bounds.h"
#include "tests/numerics/window_triangle.h"
#include "tests/raster/random_triangles.h"
#include "tests/shading/interpolate_lanes.h"

namespace tessera::test::interpolation_range_test {
using namespace detail;
namespace {

constexpr int kTile = 32;
constexpr long double kUnit = 0x1p-24L;

using Corners = std::array<float, 3>;

// Steep and flat gradients, and two equal corners (constant along an edge).
Corners random_corners(Rng& rng, bool one_sign) {
  Corners a{};
  const int kind = static_cast<int>(rng.between(0, 3));
  for (float& f : a) {
    const double part = rng.unit();
    switch (kind) {
      case 0: f = static_cast<float>(part); break;
      case 1: f = static_cast<float>(1 + std::floor(8 * part) * 0x1p-23); break;
      case 2: f = static_cast<float>(std::exp(20 * part - 10)); break;
      default: f = static_cast<float>(255 * part); break;
    }
    if (!one_sign && rng.maybe()) f = -f;
  }
  if (rng.maybe())
    a[static_cast<std::size_t>(rng.between(0, 2))] = a[static_cast<std::size_t>(rng.between(0, 2))];
  return a;
}

/// 1/w of the vertices: the largest, and the number of octaves that the others may be below it.
struct Reciprocals {
  float largest = 1;
  int octaves = 20;
};

// Calls pixel(triangle, 1/w, barycentric, x, y) for all covered pixels in the window's far corner.
template <class Pixel>
void for_each_pixel(std::uint32_t seed, const Pixel& pixel, int count = long_tests() ? 200000 : 8000,
                    const Reciprocals& reciprocals = {}) {
  Rng rng(seed);
  std::vector<float> b1(kTile * kTile), b2(kTile * kTile);
  for (int n = 0; n < count; ++n) {
    const bool is_wide = n % 4 == 0;
    const int width = is_wide ? 16384 : kTile;
    const int tile_x = 16384 - kTile;
    const int octaves = n % 3 == 0 ? 0 : reciprocals.octaves;
    WindowTriangle t = random_triangle(rng, rng.one_of(kWindowShapes), width, kTile);
    WindowVertex v[3];
    for (std::size_t k = 0; k < 3; ++k) {
      t.at[k].x += (16384 - width) * kGrid;
      const bool is_largest = octaves == 0 || k == static_cast<std::size_t>(n / 3 % 3);
      v[k] = {
          static_cast<std::int32_t>(t.at[k].x), static_cast<std::int32_t>(t.at[k].y), 0,
          reciprocals.largest * (is_largest ? 1.0f : static_cast<float>(std::exp2(-octaves * rng.unit())))};
    }
    for (const InstructionSet isa : available_isas()) {
      if (!tile_barycentrics(isa)(v, tile_x, 0, kTile, b1.data(), b2.data())) continue;
      for (int y = 0; y < kTile; ++y)
        for (int x = 0; x < kTile; ++x)
          if (t.contains(WindowTriangle::center(tile_x + x, y)))
            pixel(rng, t, v,
                  BarycentricReference{b1[static_cast<std::size_t>(y * kTile + x)],
                                       b2[static_cast<std::size_t>(y * kTile + x)]},
                  WindowTriangle::center(tile_x + x, y));
    }
  }
}

float largest_of(const Corners& a) { return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])}); }

TEST(InterpolationRange, IsExceededByAFewRoundingsAtMost) {
  long double worst[2] = {0, 0};
  long double count = 0;
  for_each_pixel(41, [&](Rng& rng, const WindowTriangle&, const WindowVertex(&)[3],
                         const BarycentricReference& at, const GridPoint&) {
    for (const bool one_sign : {false, true}) {
      const Corners a = random_corners(rng, one_sign);
      const auto [low, high] = std::minmax({a[0], a[1], a[2]});
      const long double value = at.interpolate(a[0], a[1], a[2]);
      update_worst(worst[one_sign], std::max(low - value, value - high) / (kUnit * largest_of(a)));
      ++count;
    }
  });
  EXPECT_GT(count, 3e5L * static_cast<long double>(available_isas().size()));
  expect_within("interpolated, of one sign, beyond the range", worst[1], 7, "2^-24 of the largest");
  expect_within("interpolated, of both signs, beyond the range", worst[0], 12, "2^-24 of the largest");
}

/// Raises `worst` to the largest relative error of the weights, in u. If all `rw` are equal, the weights are
/// linear in the window.
void update_worst_weight(long double& worst, const WindowTriangle& t, const std::array<float, 3>& rw,
                         const BarycentricReference& at, const GridPoint& p) {
  long double weights[3];
  long double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += weights[k] = static_cast<long double>(t.edge(k, p)) * rw[k];
  for (const auto& [found, exact] : {std::pair{at.b1, weights[1] / sum}, {at.b2, weights[2] / sum}})
    update_worst(worst, exact == 0 ? std::abs(found) / kUnit : std::abs(found - exact) / (kUnit * exact));
}

// Roundings without perspective: 1/area, its product with the edge's fraction, and the multiply-add of the
// edge. Under perspective 1/area is common to all weights; each weight also has a ratio of 1/w and the
// product with it. That is four roundings per weight, eight between two weights; then two sums, a quotient
// and a product. No step is a difference, so a zero is exact.
TEST(InterpolationRange, WeightsAreWithinTheirRoundings) {
  long double worst[2] = {0, 0};
  long double count[2] = {0, 0};
  for_each_pixel(44, [&](Rng&, const WindowTriangle& t, const WindowVertex(&v)[3],
                         const BarycentricReference& at, const GridPoint& p) {
    const bool is_affine = v[0].rw == v[1].rw && v[1].rw == v[2].rw;
    update_worst_weight(worst[is_affine], t, {v[0].rw, v[1].rw, v[2].rw}, at, p);
    ++count[is_affine];
  });
  for (const long double pixels : count) EXPECT_GT(pixels, 50000);
  expect_within("barycentric coordinates, linear in the window", worst[1], 3, "2^-24 of themselves");
  expect_within("barycentric coordinates, w apart by up to 10^6", worst[0], 12, "2^-24 of themselves");
}

// Beyond that the ratios of 1/w would overflow.
TEST(InterpolationRange, PerspectiveAppliesToReciprocalsUpTo2To120) {
  constexpr float kLow = 0x1p-120f;
  constexpr float kHigh = 0x1p120f;
  struct Case {
    float largest;
    bool has_perspective;
  };
  const Case cases[] = {{0x1p-121f, false},
                        {std::nextafter(kLow, 0.0f), false},
                        {kLow, false},
                        {std::nextafter(kLow, 1.0f), true},
                        {0x1p-119f, true},
                        {0x1p119f, true},
                        {std::nextafter(kHigh, 1.0f), true},
                        {kHigh, false},
                        {std::nextafter(kHigh, HUGE_VALF), false},
                        {0x1p121f, false}};
  long double worst[2] = {0, 0};
  long double count[2] = {0, 0};
  for (const auto& [largest, has_perspective] : cases)
    for_each_pixel(
        45,
        [&, perspective = has_perspective](Rng&, const WindowTriangle& t, const WindowVertex(&v)[3],
                                           const BarycentricReference& at, const GridPoint& p) {
          if (v[0].rw == v[1].rw && v[1].rw == v[2].rw) return;
          update_worst_weight(
              worst[perspective], t,
              perspective ? std::array{v[0].rw, v[1].rw, v[2].rw} : std::array{1.0f, 1.0f, 1.0f}, at, p);
          ++count[perspective];
        },
        800, {largest, 4});
  for (const long double pixels : count) EXPECT_GT(pixels, 10000);
  expect_within("barycentric coordinates, 1/w beyond 2^-120 .. 2^120: linear in the window", worst[0], 3,
                "2^-24 of themselves");
  expect_within("barycentric coordinates, 1/w just within", worst[1], 12, "2^-24 of themselves");
}

// Barycentric coordinates are within 9 u of exact perspective and are multiplied by the differences, which
// are rounded themselves. Each sum rounds once more, relative to its result, which is at most the largest
// value.
TEST(InterpolationRange, ErrorsAreWithinTheirRoundings) {
  long double worst = 0;
  for_each_pixel(42, [&](Rng& rng, const WindowTriangle& t, const WindowVertex(&v)[3],
                         const BarycentricReference& at, const GridPoint& p) {
    const Corners a = random_corners(rng, false);
    long double sum = 0;
    long double weights = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const long double weight = static_cast<long double>(t.edge(k, p)) * v[k].rw;
      sum += weight * a[k];
      weights += weight;
    }
    const long double differences =
        std::abs(static_cast<long double>(a[1]) - a[0]) + std::abs(static_cast<long double>(a[2]) - a[0]);
    const long double bound = kUnit * (10 * differences + 2.01L * largest_of(a));
    update_worst(worst, std::abs(at.interpolate(a[0], a[1], a[2]) - sum / weights) / bound);
  });
  expect_within("interpolated, w apart by up to 10^6: error", worst, 1,
                "of 10 roundings of differences and 2 of the largest");
}

}  // namespace
}  // namespace tessera::test::interpolation_range_test
