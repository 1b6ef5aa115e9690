// Polygons that snapping has made concave are split into triangles that cover them exactly. The reference is
// the even-odd rule, which needs no triangles.
#include "raster/window_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/raster/random_triangles.h"

namespace tessera::test::window_polygon_test {
using namespace detail;
namespace {

constexpr int kSide = 24;

VertexTransform window_transform() {
  VertexTransform t;
  t.half_width = t.half_height = kSide / 2.0;
  t.center_x = t.center_y = 128 * kSide;
  return t;
}

// Corners in 1/256 pixel relative to the window's centre, y down.
struct Corner {
  std::int32_t x, y;
};
ClippedPolygon clipped(const std::vector<Corner>& corners) {
  ClippedPolygon polygon;
  for (const Corner& c : corners)
    polygon.vertices[polygon.count++].position = {c.x / (128.0 * kSide), -c.y / (128.0 * kSide), 0, 1};
  return polygon;
}

// Even-odd rule: crossings of a ray to the right. A centre on an edge is classified as if moved by (e, e^2)
// with an infinitesimal e, y down.
bool is_inside(const WindowPolygon& polygon, int x, int y) {
  const std::int64_t px = 256 * x + 128, py = 256 * y + 128;
  bool inside = false;
  for (int i = 0; i < polygon.clipped.count; ++i) {
    WindowVertex a = polygon.window[i], b = polygon.window[(i + 1) % polygon.clipped.count];
    if ((a.y > py) == (b.y > py)) continue;
    if (a.y > b.y) std::swap(a, b);
    inside ^= (b.x - a.x) * (py - a.y) > (px - a.x) * (b.y - a.y);  // the crossing is to the right of px
  }
  return inside;
}

void expect_covered_once(const WindowPolygon& polygon, int round) {
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      int covered = 0;
      for (const WindowPolygon::Corners& c : polygon.triangles())
        covered +=
            reference_of({polygon.window[c[0]], polygon.window[c[1]], polygon.window[c[2]]}).covers(x, y);
      ASSERT_EQ(covered, is_inside(polygon, x, y) ? 1 : 0)
          << "round " << round << ", pixel " << x << " " << y;
    }
}

// Corners around a point, ordered by direction: edges never cross, and the polygon may be concave anywhere.
// Snapping makes concavities of about 1/256 pixel; here they have any depth.
std::vector<Corner> random_corners(RandomTriangles& source) {
  const int count = source.between(3, kMaxClippedVertices);
  const double start = 6.3 * source.unit();
  std::vector<Corner> corners;
  for (int i = 0; i < count; ++i) {
    const double angle = start + (i + 0.8 * source.unit()) * 6.283185307179586 / count;
    const double radius = 128 * kSide * (0.2 + source.unit());
    corners.push_back({static_cast<std::int32_t>(std::lround(radius * std::cos(angle))),
                       static_cast<std::int32_t>(std::lround(radius * std::sin(angle)))});
  }
  if (source.between(0, 1) != 0) std::reverse(corners.begin(), corners.end());
  return corners;
}
bool is_concave(const WindowPolygon& polygon) {
  const int n = polygon.clipped.count;
  for (int i = 0; i < n; ++i)
    if (doubled_area(polygon.window[i], polygon.window[(i + 1) % n], polygon.window[(i + 2) % n]) *
            polygon.area <
        0)
      return true;
  return false;
}

TEST(WindowPolygon, TrianglesCoverPolygonOnce) {
  RandomTriangles source(41, kSide);
  int concave = 0;
  for (int round = 0; round < (long_tests() ? 100000 : 5000); ++round) {
    const WindowPolygon polygon(window_transform(), clipped(random_corners(source)));
    for (const WindowPolygon::Corners& c : polygon.triangles())
      ASSERT_GT(doubled_area(polygon.window[c[0]], polygon.window[c[1]], polygon.window[c[2]]) * polygon.area,
                0);
    concave += is_concave(polygon);
    expect_covered_once(polygon, round);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(concave, 500);
}

using SortedTriangles = std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>>;
SortedTriangles sorted_triangles(const WindowPolygon& polygon) {
  SortedTriangles triangles;
  for (const WindowPolygon::Corners& corners : polygon.triangles()) {
    triangles.emplace_back();
    for (const int c : corners) triangles.back().emplace_back(polygon.window[c].x, polygon.window[c].y);
    std::sort(triangles.back().begin(), triangles.back().end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

TEST(WindowPolygon, TrianglesDoNotDependOnFirstCornerOrDirection) {
  RandomTriangles source(42, kSide);
  for (int round = 0; round < 2000; ++round) {
    std::vector<Corner> corners = random_corners(source);
    const SortedTriangles first = sorted_triangles(WindowPolygon(window_transform(), clipped(corners)));
    for (std::size_t turn = 0; turn < 2 * corners.size(); ++turn) {
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      if (turn == corners.size()) std::reverse(corners.begin(), corners.end());
      ASSERT_EQ(sorted_triangles(WindowPolygon(window_transform(), clipped(corners))), first)
          << "round " << round;
    }
  }
}

// Coincident corners, collinear corners, and a line forth and back yield no triangles.
TEST(WindowPolygon, OmitsTrianglesWithoutArea) {
  const WindowPolygon line(window_transform(), clipped({{0, 0}, {256, 256}, {512, 512}, {256, 256}}));
  EXPECT_TRUE(line.triangles().empty());
  const WindowPolygon square(
      window_transform(),
      clipped({{0, 0}, {512, 0}, {1024, 0}, {1024, 0}, {1024, 1024}, {0, 1024}, {0, 512}}));
  EXPECT_EQ(square.area, 2 * 1024.0 * 1024.0);
  expect_covered_once(square, 0);
}

// Snapping may make the edges of a polygon thinner than a grid step cross, with a total area of 0. It is
// drawn nevertheless; otherwise there would be a hole between its neighbours.
TEST(WindowPolygon, CrossingEdgesLeaveNoHole) {
  const WindowPolygon crossed(window_transform(),
                              clipped({{-1024, -1024}, {1024, 1024}, {1024, -1024}, {-1024, 1024}}));
  EXPECT_EQ(crossed.area, 0);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      if (!is_inside(crossed, x, y)) continue;
      bool covered = false;
      for (const WindowPolygon::Corners& c : crossed.triangles())
        covered |=
            reference_of({crossed.window[c[0]], crossed.window[c[1]], crossed.window[c[2]]}).covers(x, y);
      EXPECT_TRUE(covered) << x << " " << y;
    }
}

}  // namespace
}  // namespace tessera::test::window_polygon_test
