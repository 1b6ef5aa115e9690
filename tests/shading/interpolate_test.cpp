// Barycentric coordinates and interpolated attributes: bit-identical to their scalar twins on every
// instruction set, and close to exact perspective.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

#include "shading/interpolate_reference.h"
#include "tests/numerics/bounds.h"
#include "tests/raster/random_triangles.h"
#include "tests/raster/tile_harness.h"
#include "tests/shading/interpolate_lanes.h"

namespace tessera::test::interpolate_test {
using namespace detail;
namespace {

constexpr int kTile = 32;

// 1/w of the corners: equal, or different by up to `decades` powers of ten.
void set_random_w(RandomTriangles& source, Triangle& t, double decades) {
  const double base = std::pow(10.0, 6 * source.unit() - 3);
  for (WindowVertex& v : t)
    v.rw = static_cast<float>(
        base * std::pow(10.0, source.between(0, 2) == 0 ? -decades : -decades * source.unit()));
  if (source.between(0, 4) == 0) t[1].rw = t[2].rw = t[0].rw;
}

template <class CheckPixel>
void for_each_pixel(std::uint32_t seed, int rounds, double decades, const CheckPixel& check) {
  RandomTriangles source(seed, kTile);
  std::vector<float> b1(kTile * kTile), b2(kTile * kTile);
  for (int round = 0; round < rounds; ++round) {
    Triangle t = source.next();
    set_random_w(source, t, decades);
    const WindowVertex vertices[3] = {t[0], t[1], t[2]};
    const TriangleReference reference(vertices);
    if (reference.area == 0) continue;
    for (const InstructionSet isa : available_isas()) {
      const bool touched = tile_barycentrics(isa)(vertices, 0, 0, kTile, b1.data(), b2.data());
      reference.for_each_covered(0, 0, kTile, kTile, [&](int x, int y) {
        ASSERT_TRUE(touched) << Describe{t};
        const auto pixel = static_cast<std::size_t>(y * kTile + x);
        check(t, reference, x, y, b1[pixel], b2[pixel], isa);
      });
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}
int rounds(int normal) { return long_tests() ? normal * 30 : normal; }

TEST(Interpolate, BarycentricsMatchTheScalarTwin) {
  for_each_pixel(
      31, rounds(1500), 6,
      [](const Triangle& t, const TriangleReference&, int x, int y, float b1, float b2, InstructionSet isa) {
        const WindowVertex v[3] = {t[0], t[1], t[2]};
        const BarycentricReference expected = barycentric_reference(v, x, y);
        ASSERT_EQ(std::bit_cast<std::uint32_t>(b1), std::bit_cast<std::uint32_t>(expected.b1))
            << name_of(isa) << " " << x << " " << y << ": " << Describe{t};
        ASSERT_EQ(std::bit_cast<std::uint32_t>(b2), std::bit_cast<std::uint32_t>(expected.b2))
            << name_of(isa) << " " << x << " " << y << ": " << Describe{t};
      });
}

// All terms are positive and rounded a few times each: 1/area, its product with 1/w, the edge, the
// multiply-add, two sums, the quotient and the product. Nine roundings of a number that is at most 1 are at
// most 9 * 2^-24.
TEST(Interpolate, IsWithinNineRoundingsOfPerspective) {
  for (const double decades : {0.5, 6.0, 12.0}) {
    double worst = 0;
    for_each_pixel(32, rounds(1500), decades,
                   [&](const Triangle& t, const TriangleReference& reference, int x, int y, float b1,
                       float b2, InstructionSet) {
                     long double weight[3], sum = 0;
                     for (std::size_t k = 0; k < 3; ++k) {
                       weight[k] = static_cast<long double>(reference.edge[k].at(x, y)) * t[k].rw;
                       sum += weight[k];
                     }
                     const auto error1 = static_cast<double>(std::abs(b1 - weight[1] / sum));
                     const auto error2 = static_cast<double>(std::abs(b2 - weight[2] / sum));
                     update_worst(worst, error1, error2);
                     ASSERT_LE(worst, 9 * 0x1p-24) << Describe{t};
                     ASSERT_GE(b1, 0);
                     ASSERT_GE(b2, 0);
                     ASSERT_LE(b1 + b2, 1 + 0x1p-21f);
                   });
    std::printf("[  figure  ] barycentric coordinates, w apart by up to 10^%g: off by at most %.3g\n",
                decades, worst);
  }
}

constexpr std::size_t kPoints = 64;

/// An attribute at points inside a triangle and, like the centres of multisampled pixels, outside of it.
struct InterpolatedPoints {
  std::array<float, kPoints> b1, b2, single, lanes, arrays, clamped, clamped_lanes;

  explicit InterpolatedPoints(RandomTriangles& source) {
    for (std::size_t i = 0; i < kPoints; ++i) {
      b1[i] = static_cast<float>(1.5 * source.unit() - 0.25);
      b2[i] = static_cast<float>((1 - b1[i]) * (1.5 * source.unit() - 0.25));
    }
    b1[0] = b2[1] = 0;
    b1[2] = b2[3] = 1;
  }
  void interpolate(InstructionSet isa, const float (&at_vertices)[3]) {
    for (auto* values : {&single, &lanes, &arrays, &clamped, &clamped_lanes})
      values->fill(std::numeric_limits<float>::quiet_NaN());
    interpolate_values(isa)(
        at_vertices, b1.data(), b2.data(), kPoints,
        {single.data(), lanes.data(), arrays.data(), clamped.data(), clamped_lanes.data()});
  }
};

TEST(Interpolate, ValuesMatchTheScalarTwin) {
  RandomTriangles source(33, kTile);
  for (int round = 0; round < rounds(2000); ++round) {
    InterpolatedPoints points(source);
    const auto any = [&] {
      return static_cast<float>((source.unit() - 0.5) * std::exp2(200 * source.unit() - 100));
    };
    const float v[3] = {any(), any(), any()};
    const auto [low, high] = std::minmax({v[0], v[1], v[2]});
    for (const InstructionSet isa : available_isas()) {
      points.interpolate(isa, v);
      for (std::size_t i = 0; i < kPoints; ++i) {
        const float expected = BarycentricReference{points.b1[i], points.b2[i]}.interpolate(v[0], v[1], v[2]);
        for (const float found : {points.single[i], points.lanes[i], points.arrays[i]})
          ASSERT_EQ(std::bit_cast<std::uint32_t>(found), std::bit_cast<std::uint32_t>(expected))
              << name_of(isa) << ", " << points.b1[i] << " " << points.b2[i] << ", of " << v[0] << " " << v[1]
              << " " << v[2];
        for (const float found : {points.clamped[i], points.clamped_lanes[i]})
          ASSERT_EQ(found, std::clamp(expected, low, high)) << name_of(isa);
      }
    }
  }
}

TEST(Interpolate, ConstantsStayExactlyConstant) {
  RandomTriangles source(34, kTile);
  for (int round = 0; round < rounds(500); ++round) {
    InterpolatedPoints points(source);
    for (const float value : {0.0f, 0.1f, 1.0f, 255.5f, -3e30f})
      for (const InstructionSet isa : available_isas()) {
        points.interpolate(isa, {value, value, value});
        for (const auto* values :
             {&points.single, &points.lanes, &points.arrays, &points.clamped, &points.clamped_lanes})
          for (const float found : *values) ASSERT_EQ(found, value) << name_of(isa);
      }
  }
}

}  // namespace
}  // namespace tessera::test::interpolate_test
