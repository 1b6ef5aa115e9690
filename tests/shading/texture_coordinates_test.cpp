// Texture coordinates and levels of detail against equation 3.14 in double, from exact edges; bit-identical
// on every instruction set.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <vector>

#include "raster/clip.h"
#include "tests/numerics/bounds.h"
#include "tests/raster/random_triangles.h"
#include "tests/raster/tile_harness.h"
#include "tests/shading/texture_lanes.h"

namespace tessera::test::texture_coordinates_test {
using namespace detail;
namespace {

constexpr int kTile = 32;

struct Expected {
  double s, t, level_of_detail;
};

// s = N / W of two linear functions: quotient rule.
Expected expected_at(const Triangle& triangle, const TriangleReference& exact, const double (&s)[3],
                     const double (&t)[3], double width, double height, int x, int y) {
  double sum[3] = {}, of_s[3] = {}, of_t[3] = {};  // at the pixel, one pixel to the right, one pixel down
  for (std::size_t k = 0; k < 3; ++k) {
    const EdgeReference& edge = exact.edge[k];
    const double parts[3] = {static_cast<double>(edge.at(x, y)), static_cast<double>(edge.dx),
                             static_cast<double>(edge.dy)};
    for (std::size_t i = 0; i < 3; ++i) {
      const double weight = parts[i] / static_cast<double>(exact.area) * triangle[k].rw;
      sum[i] += weight;
      of_s[i] += weight * s[k];
      of_t[i] += weight * t[k];
    }
  }
  const double at_s = of_s[0] / sum[0];
  const double at_t = of_t[0] / sum[0];
  const auto length = [&](std::size_t i) {
    return std::hypot(width * (of_s[i] - at_s * sum[i]) / sum[0],
                      height * (of_t[i] - at_t * sum[i]) / sum[0]);
  };
  return {at_s, at_t, std::log2(std::max(length(1), length(2)))};
}

/// Attributes of a vertex.
struct Corner {
  float at[kAttributePadding] = {};
};

template <class Check>
void for_each_triangle(std::uint32_t seed, int rounds, const Check& check) {
  RandomTriangles source(seed, kTile);
  constexpr Shape kShapes[] = {Shape::medium,     Shape::large,        Shape::widest_edges32, Shape::edges64,
                               Shape::on_centers, Shape::axis_aligned, Shape::sliver};
  for (int round = 0; round < rounds; ++round) {
    Triangle triangle = source.next(kShapes[round % 7]);
    const double base = std::exp2(8 * source.unit() - 4);
    for (WindowVertex& v : triangle)
      v.rw = static_cast<float>(base * (round % 3 == 0 ? 1 : std::exp2(-6 * source.unit())));
    Corner corners[3];
    const double reach = std::exp2(6 * source.unit() - 3);
    for (Corner& corner : corners)
      for (int k = 2; k < 4; ++k)
        corner.at[k] = static_cast<float>(reach * source.unit() - (round % 2 == 0 ? 0.0 : 2.0));
    check(triangle, corners, source);
  }
}

TEST(TextureCoordinates, LevelsOfDetailAreWithinOneSixteenthOfEquation3_14) {
  double worst = 0, worst_coordinate = 0;
  for_each_triangle(
      51, long_tests() ? 20000 : 1400,
      [&](const Triangle& triangle, const Corner(&corners)[3], RandomTriangles& source) {
        TextureLevels levels;
        levels.level[0].width = source.between(1, 512);
        levels.level[0].height = source.between(0, 4) == 0 ? 1 : source.between(2, 512);
        levels.last = 1;
        const DrawTexture texture{.levels = &levels, .attribute = 2};
        const WindowVertex vertices[3] = {triangle[0], triangle[1], triangle[2]};
        const TriangleReference exact(vertices);
        if (exact.area == 0) return;
        const float* const attributes[3] = {corners[0].at, corners[1].at, corners[2].at};
        const double s[3] = {corners[0].at[2], corners[1].at[2], corners[2].at[2]};
        const double t[3] = {corners[0].at[3], corners[1].at[3], corners[2].at[3]};
        std::vector<float> first[3];
        for (const InstructionSet isa : available_isas()) {
          std::vector<float> at_s(kTile * kTile), at_t(kTile * kTile), squared(kTile * kTile);
          const bool touched = tile_coordinates(isa)(vertices, attributes, texture, kTile, at_s.data(),
                                                     at_t.data(), squared.data());
          if (first[0].empty()) {
            first[0] = at_s;
            first[1] = at_t;
            first[2] = squared;
          }
          exact.for_each_covered(0, 0, kTile, kTile, [&](int x, int y) {
            ASSERT_TRUE(touched) << Describe{triangle};
            const auto i = static_cast<std::size_t>(y * kTile + x);
            ASSERT_EQ(std::bit_cast<std::uint32_t>(squared[i]), std::bit_cast<std::uint32_t>(first[2][i]))
                << name_of(isa) << " " << x << " " << y << ": " << Describe{triangle};
            ASSERT_EQ(std::bit_cast<std::uint32_t>(at_s[i]), std::bit_cast<std::uint32_t>(first[0][i]))
                << name_of(isa);
            ASSERT_EQ(std::bit_cast<std::uint32_t>(at_t[i]), std::bit_cast<std::uint32_t>(first[1][i]))
                << name_of(isa);
            const double height = levels.level[0].height == 1 ? 0 : levels.level[0].height;
            const Expected expected = expected_at(triangle, exact, s, t, levels.level[0].width, height, x, y);
            if (expected.level_of_detail < -20) return;  // no measurable slope
            const double off = std::abs(0.5 * std::log2(double{squared[i]}) - expected.level_of_detail);
            ASSERT_LE(off, 1.0 / 16) << name_of(isa) << " " << x << " " << y << ", " << levels.level[0].width
                                     << "x" << levels.level[0].height << ", expected "
                                     << expected.level_of_detail << ": " << Describe{triangle};
            update_worst(worst, off);
            update_worst(worst_coordinate, std::abs(at_s[i] - expected.s), std::abs(at_t[i] - expected.t));
          });
          if (::testing::Test::HasFatalFailure()) return;
        }
      });
  EXPECT_LE(worst_coordinate, 1e-5);
  std::printf("[  figure  ] levels of detail are off by at most %.3g, coordinates by %.3g\n", worst,
              worst_coordinate);
}

TEST(TextureCoordinates, ConstantCoordinatesHaveNoSlope) {
  for_each_triangle(52, 200, [&](const Triangle& triangle, const Corner(&)[3], RandomTriangles&) {
    TextureLevels levels;
    levels.level[0].width = levels.level[0].height = 256;
    levels.last = 8;
    const DrawTexture texture{.levels = &levels, .attribute = 0};
    const WindowVertex vertices[3] = {triangle[0], triangle[1], triangle[2]};
    Corner same;
    same.at[0] = 0.3f;
    same.at[1] = -7.7f;
    const float* const attributes[3] = {same.at, same.at, same.at};
    for (const InstructionSet isa : available_isas()) {
      std::vector<float> s(kTile * kTile, 0.3f), t(kTile * kTile, -7.7f), squared(kTile * kTile);
      tile_coordinates(isa)(vertices, attributes, texture, kTile, s.data(), t.data(), squared.data());
      TriangleReference(vertices).for_each_covered(0, 0, kTile, kTile, [&](int x, int y) {
        const auto i = static_cast<std::size_t>(y * kTile + x);
        ASSERT_EQ(s[i], 0.3f);
        ASSERT_EQ(t[i], -7.7f);
        ASSERT_EQ(squared[i], 0.0f);
      });
    }
  });
}

}  // namespace
}  // namespace tessera::test::texture_coordinates_test
