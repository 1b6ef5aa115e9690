// Triangles of polygons, against the polygons' area.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "engine/program/import/polygon_split.h"

namespace tessera::polygon_split_test {
using namespace program;
namespace {

using Polygon = std::vector<std::array<float, 3>>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

double length(const std::array<double, 3>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// Whether the triangles tile a planar polygon: their areas add up, and all face the same side.
void expect_tiles(const Polygon& polygon) {
  const Triangles triangles = split_polygon(polygon);
  EXPECT_EQ(triangles.size(), polygon.size() - 2);
  const std::array<double, 3> whole = polygon_normal(polygon);
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const std::array<double, 3> n = polygon_normal(Polygon{polygon[a], polygon[b], polygon[c]});
    sum += length(n);
    EXPECT_GE(n[0] * whole[0] + n[1] * whole[1] + n[2] * whole[2], 0) << a << " " << b << " " << c;
  }
  EXPECT_NEAR(sum, length(whole), 1e-5 * length(whole));
}

/// Points of the plane z = 0, and of three other planes, from either side.
void expect_tiles_in_every_plane(const std::vector<std::array<float, 2>>& points) {
  for (int plane = 0; plane < 4; ++plane)
    for (const bool is_reversed : {false, true}) {
      Polygon polygon;
      for (const auto& [x, y] : points) {
        if (plane == 0) polygon.push_back({x, y, 0});
        else if (plane == 1) polygon.push_back({0, x, y});
        else if (plane == 2) polygon.push_back({y, 3, x});
        else polygon.push_back({x, y, 2 * x - 3 * y});
      }
      if (is_reversed) std::ranges::reverse(polygon);
      expect_tiles(polygon);
    }
}

TEST(PolygonSplit, ConvexPolygonsBecomeFans) {
  Polygon polygon;
  for (int i = 0; i < 7; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 7;
    polygon.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 5});
  }
  EXPECT_EQ(split_polygon(polygon), (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}}));
  expect_tiles(polygon);
}

TEST(PolygonSplit, QuadrilateralsAreSplitAlongTheShorterDiagonal) {
  EXPECT_EQ(split_polygon(Polygon{{0, 0, 0}, {4, 0, 0}, {5, 1, 0}, {0, 1, 0}}),
            (Triangles{{0, 1, 3}, {1, 2, 3}}));
  EXPECT_EQ(split_polygon(Polygon{{0, 0, 0}, {5, 0, 0}, {4, 1, 0}, {-1, 1, 0}}),
            (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(PolygonSplit, ConcavePolygonsAreTiled) {
  expect_tiles_in_every_plane({{0, 0}, {4, 1}, {0, 2}, {1, 1}});  // the shorter diagonal is outside
  expect_tiles_in_every_plane({{4, 1}, {0, 2}, {1, 1}, {0, 0}});
  expect_tiles_in_every_plane({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
  expect_tiles_in_every_plane({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}});  // straight corners
  expect_tiles_in_every_plane(  // a hole and its bridge
      {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}});
}

TEST(PolygonSplit, StarsOfAnyShapeAreTiled) {
  std::mt19937 random(7);
  for (int sample = 0; sample < 200; ++sample) {
    const int corners = 5 + static_cast<int>(random() % 30);
    std::vector<std::array<float, 2>> points;
    for (int i = 0; i < corners; ++i) {
      const double radius = 1 + static_cast<double>(random() % 1000) / 100;
      const double angle = 2 * 3.14159265358979 * i / corners;
      points.push_back(
          {static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle))});
    }
    expect_tiles_in_every_plane(points);
  }
}

TEST(PolygonSplit, OddPolygonsGiveTrianglesToo) {
  EXPECT_EQ(split_polygon(Polygon(9, {1, 1, 1})).size(), 7u);
  EXPECT_EQ(split_polygon(Polygon{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0.5f, 0}}).size(), 3u);
  EXPECT_EQ(split_polygon(Polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}).size(), 3u);
}

}  // namespace
}  // namespace tessera::polygon_split_test
