// Clipping in homogeneous space: results lie inside the planes, shared edges stay shared, attributes stay
// linear.
#include "raster/clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>
#include <vector>

#include "tests/raster/random_triangles.h"
#include "tests/raster/tile_harness.h"

namespace tessera::test::clip_test {
using namespace detail;
namespace {

VertexTransform identity(double half_size, bool reversed = false) {
  VertexTransform t;
  for (int i = 0; i < 4; ++i) t.clip_from_object[5 * i] = 1;
  t.half_width = t.half_height = half_size;
  t.guard_x = t.guard_y = kGuardBandPixels / half_size;
  t.center_x = t.center_y = static_cast<std::int32_t>(256 * half_size);
  t.reversed = reversed;
  return t;
}

struct RandomClip {
  std::mt19937 random;
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  ClipVertex vertex(double scale) {
    ClipVertex v;
    v.position = {in(-5, 5) * scale, in(-5, 5) * scale, in(-2, 2) * scale, in(-0.5, 2) * scale};
    if (in(0, 1) < 0.05) v.position.w = 0;
    if (in(0, 1) < 0.05) v.position.z = -v.position.w;
    return v;
  }
};

std::uint8_t outcodes_of(const VertexTransform& t, const ClipVertex (&v)[3]) {
  return compute_outcode(t, v[0].position) | compute_outcode(t, v[1].position) |
         compute_outcode(t, v[2].position);
}
double magnitude(const ClipVertex (&v)[3]) {
  double max = 0;
  for (const ClipVertex& c : v)
    for (const double x : {c.position.x, c.position.y, c.position.z, c.position.w})
      max = std::max(max, std::abs(x));
  return max;
}

TEST(Clip, ResultLiesInsidePlanesAndAttributesStayLinear) {
  for (const double scale : {1.0, 1e-30, 1e30}) {
    for (const bool reversed : {false, true}) {
      RandomClip random{std::mt19937(7)};
      const VertexTransform t = identity(8191.5, reversed);
      std::size_t kept = 0;
      for (int round = 0; round < (long_tests() ? 300000 : 20000); ++round) {
        ClipVertex v[3] = {random.vertex(scale), random.vertex(scale), random.vertex(scale)};
        for (ClipVertex& c : v) {  // two coordinates and a constant
          c.attributes[0] = static_cast<float>(c.position.x);
          c.attributes[1] = static_cast<float>(c.position.w);
          c.attributes[2] = 0.1f;
        }
        const ClippedPolygon polygon = clip_triangle(t, v, outcodes_of(t, v), 3);
        ASSERT_LE(polygon.count, 9);
        const double size = magnitude(v);
        for (int i = 0; i < polygon.count; ++i) {
          const ClipPosition& p = polygon.vertices[i].position;
          const double slack = 1e-14 * size * t.guard_x;
          ASSERT_GT(p.w, 0);
          ASSERT_GE(t.guard_x * p.w - std::abs(p.x), -slack);
          ASSERT_GE(t.guard_y * p.w - std::abs(p.y), -slack);
          ASSERT_GE(p.w - p.z, -slack);
          ASSERT_GE(reversed ? p.z : p.w + p.z, -slack);
          ASSERT_NEAR(polygon.vertices[i].attributes[0], p.x, 1e-6 * size);
          ASSERT_NEAR(polygon.vertices[i].attributes[1], p.w, 1e-6 * size);
          ASSERT_EQ(polygon.vertices[i].attributes[2], 0.1f);
          // Later stages need coordinates of 24 bits.
          const WindowVertex window = project(t, p);
          ASSERT_LE(std::abs(window.x - t.center_x), kGuardBandPixels * 256 + 1);
          ASSERT_LE(std::abs(window.y - t.center_y), kGuardBandPixels * 256 + 1);
          ASSERT_TRUE(std::isfinite(window.rw) || scale < 1);
        }
        kept += polygon.count != 0 ? 1 : 0;
      }
      EXPECT_GT(kept, 1000u);
    }
  }
}

// Two triangles share an edge, in opposite directions: the cut points on it are bit-identical.
TEST(Clip, CutsSharedEdgesAtIdenticalPoints) {
  RandomClip random{std::mt19937(8)};
  const VertexTransform t = identity(8191.5);
  std::size_t cuts = 0;
  for (int round = 0; round < (long_tests() ? 300000 : 30000); ++round) {
    ClipVertex a = random.vertex(1), b = random.vertex(1), c = random.vertex(1), d = random.vertex(1);
    c.attributes[0] = d.attributes[0] = 1;  // exactly 0 on the edge from a to b only
    const auto on_edge = [&](const ClipVertex& first, const ClipVertex& second, const ClipVertex& third) {
      const ClipVertex v[3] = {first, second, third};
      const ClippedPolygon polygon = clip_triangle(t, v, outcodes_of(t, v), 1);
      std::vector<std::tuple<double, double, double, double>> points;
      for (int i = 0; i < polygon.count; ++i) {
        const ClipPosition& p = polygon.vertices[i].position;
        if (polygon.vertices[i].attributes[0] == 0) points.emplace_back(p.x, p.y, p.z, p.w);
      }
      std::sort(points.begin(), points.end());
      // A vertex on a plane is also the cut point of its other edge.
      points.erase(std::unique(points.begin(), points.end()), points.end());
      return std::pair(points, polygon.count);
    };
    const auto [one, one_count] = on_edge(a, b, c);
    const auto [other, other_count] = on_edge(b, a, d);
    if (one_count == 0 || other_count == 0) continue;  // one triangle is clipped away
    if (one.size() < 2 || other.size() < 2) continue;  // the edge touches a plane in a point
    ASSERT_EQ(one, other) << "round " << round;
    cuts += one.size();
  }
  EXPECT_GT(cuts, 1000u);
}

// A plane that meets all six sides of the clip volume cuts a hexagon; the triangle cuts off three of its
// corners: nine vertices.
TEST(Clip, ProducesUpToNineVertices) {
  const VertexTransform t = identity(8191.5);  // the guard band is 2 w
  // The plane X + Y + Z = 0 of the cube [-1, 1]^3, with x = 2 X, y = 2 Y, z = Z. u points to a corner of the
  // hexagon.
  const double u[3] = {std::sqrt(0.5), -std::sqrt(0.5), 0};
  const double v[3] = {std::sqrt(1 / 6.0), std::sqrt(1 / 6.0), -2 * std::sqrt(1 / 6.0)};
  constexpr double kInradius =
      1.35;  // between the distances of the hexagon's sides, 1.2247, and corners, 1.4142
  ClipVertex corners[3];
  for (int k = 0; k < 3; ++k) {
    const double angle = 3.14159265358979 / 3 + k * 2 * 3.14159265358979 / 3;
    const double x = 2 * kInradius * std::cos(angle), y = 2 * kInradius * std::sin(angle);
    corners[k].position = {2 * (x * u[0] + y * v[0]), 2 * (x * u[1] + y * v[1]), x * u[2] + y * v[2], 1};
  }
  const ClippedPolygon polygon = clip_triangle(t, corners, outcodes_of(t, corners), 0);
  EXPECT_EQ(polygon.count, 9);
  double area = 0;
  const auto at = [&](int i, const double(&axis)[3]) {
    const ClipPosition& p = polygon.vertices[i % polygon.count].position;
    return p.x / 2 * axis[0] + p.y / 2 * axis[1] + p.z * axis[2];
  };
  for (int i = 0; i < polygon.count; ++i) area += (at(i, u) * at(i + 1, v) - at(i + 1, u) * at(i, v)) / 2;
  const double cut_height = std::sqrt(2.0) - kInradius;
  EXPECT_NEAR(std::abs(area), 3 * std::sqrt(3.0) - 3 * cut_height * cut_height * std::sqrt(3.0), 1e-6);
}

TEST(Clip, RemovesTrianglesBehindTheEye) {
  const VertexTransform t = identity(100);
  const ClipVertex behind[3] = {{{0, 0, 0, -1}, {}}, {{1, 0, 0, -2}, {}}, {{0, 1, 0, -1}, {}}};
  EXPECT_EQ(clip_triangle(t, behind, outcodes_of(t, behind), 0).count, 0);
  const ClipVertex in_its_plane[3] = {{{0, 0, 0, 0}, {}}, {{1, 0, 0, 0}, {}}, {{0, 1, 0, 0}, {}}};
  EXPECT_EQ(clip_triangle(t, in_its_plane, outcodes_of(t, in_its_plane), 0).count, 0);
  const ClipVertex touching[3] = {{{0, 0, 0, 0}, {}}, {{1, 0, 0, -1}, {}}, {{0, 1, 0, -1}, {}}};
  EXPECT_EQ(clip_triangle(t, touching, outcodes_of(t, touching), 0).count, 0);
}

// Coordinates from 2^-1000 to 2^1023 in one triangle: a cut can lose all digits of w. Vertices of the result
// must lie in the guard band nevertheless.
TEST(Clip, ResultLiesInGuardBandForExtremeCoordinates) {
  constexpr std::int64_t kFarthest = std::int64_t{kGuardBandPixels} * kSubpixelScale;
  RandomClip random{std::mt19937(11)};
  VertexTransform t = identity(24);
  t.depth = DepthFormat::unorm32;
  std::size_t kept = 0;
  const auto check = [&](const ClipPosition& p) {
    const WindowVertex v = project(t, p);
    EXPECT_LE(std::abs(std::int64_t{v.x} - t.center_x), kFarthest);
    EXPECT_LE(std::abs(std::int64_t{v.y} - t.center_y), kFarthest);
    ++kept;
  };
  for (int round = 0; round < (long_tests() ? 1000000 : 50000); ++round) {
    t.depth_far = round % 3 == 0 ? 0 : 1;
    const auto size = [&] {
      return std::ldexp(random.in(-1, 1), round % 2 == 0 ? static_cast<int>(random.in(-1000, 1024))
                                                         : static_cast<int>(random.in(1000, 1025)));
    };
    ClipVertex v[3];
    for (ClipVertex& c : v) {
      c.position = {size(), size(), size(), size()};
      if (random.in(0, 1) < 0.5) c.position.z = 0;
      if (random.in(0, 1) < 0.5) c.position.w = std::abs(c.position.w);
    }
    const std::uint8_t outcodes = outcodes_of(t, v);
    if ((outcodes & kNonFinite) != 0 || outcodes == 0) continue;
    const ClippedPolygon polygon = clip_triangle(t, v, outcodes, 0);
    for (int i = 0; i < polygon.count; ++i) check(polygon.vertices[i].position);
    std::vector<ClipVertex> outline{v[0], v[1], v[2]};
    PolygonClipper().clip(t, outline, outcodes, 0);
    for (const ClipVertex& corner : outline) check(corner.position);
    ClipVertex line[2] = {v[0], v[1]};
    const std::uint8_t line_codes = compute_outcode(t, v[0].position) | compute_outcode(t, v[1].position);
    if (line_codes != 0 && clip_line(t, line, line_codes, 0))
      for (const ClipVertex& end : line) check(end.position);
  }
  EXPECT_GT(kept, 10000u);
}

// From vertices to pixels: a pixel is covered if a ray through its centre hits the triangle between the near
// and far planes. Pixels whose ray changes its result within 1/64 pixel are exempt, because cut points are
// snapped.
TEST(Clip, CoversPixelsWhoseRayHitsTheTriangle) {
  constexpr int kSize = 64;
  RandomClip random{std::mt19937(9)};
  std::size_t covered = 0;
  for (int round = 0; round < (long_tests() ? 20000 : 1500); ++round) {
    const VertexTransform t = identity(kSize / 2.0);
    const float scale = round % 10 == 0 ? 1e15f : 1;
    float positions[12];
    ClipVertex v[3];
    for (int k = 0; k < 3; ++k) {
      v[k] = random.vertex(scale);
      if (round % 4 == 0) v[k].position.x *= 1e5;
      const double values[4] = {v[k].position.x, v[k].position.y, v[k].position.z, v[k].position.w};
      for (int j = 0; j < 4; ++j) positions[4 * k + j] = static_cast<float>(values[j]);
      v[k].position = {positions[4 * k], positions[4 * k + 1], positions[4 * k + 2], positions[4 * k + 3]};
    }
    // Weights of the corners at a window position: the solution of [x y w] weights = (window x, window y, 1).
    const auto inside = [&](double px, double py) {
      const double x = (px - kSize / 2.0) / (kSize / 2.0), y = -(py - kSize / 2.0) / (kSize / 2.0);
      const auto det = [](const double* a, const double* b, const double* c) {
        return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) +
               c[0] * (a[1] * b[2] - a[2] * b[1]);
      };
      double m[3][3];
      for (int k = 0; k < 3; ++k)
        m[k][0] = v[k].position.x / scale, m[k][1] = v[k].position.y / scale,
        m[k][2] = v[k].position.w / scale;
      const double p[3] = {x, y, 1}, whole = det(m[0], m[1], m[2]);
      const double l[3] = {det(p, m[1], m[2]) / whole, det(m[0], p, m[2]) / whole,
                           det(m[0], m[1], p) / whole};
      if (!(l[0] >= 0 && l[1] >= 0 && l[2] >= 0)) return false;
      const double depth =
          (l[0] * v[0].position.z + l[1] * v[1].position.z + l[2] * v[2].position.z) / scale;  // w is 1 there
      return depth >= -1 && depth <= 1;
    };
    TileHarness stage(kSize, kSize, kSize);
    WindowVertex vertices[3];
    std::uint8_t outcodes[3];
    const InstructionSet isa = available_isas()[static_cast<std::size_t>(round) % available_isas().size()];
    const std::uint8_t any = transform_vertices(isa)(t, {positions, 4}, 4, 3, vertices, outcodes);
    stage.add_draw(vertices).packed_color = 1;
    BinDraw bin;
    bin.vertices = vertices;
    bin.outcodes = outcodes;
    bin.any_outcode = any != 0;
    bin.rect = {0, 0, kSize, kSize};
    bin.transform = &t;
    bin.positions = {positions, 4};
    bin.components = 4;
    const float none[3 * 16] = {};
    bin.attributes = none;
    bin_triangles(stage.bins(), stage.frame().grid, bin, 0, 1, isa);
    stage.draw(0).attributes = none;
    stage.render(isa, 0);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const bool hit = inside(x + 0.5, y + 0.5);
        covered += hit ? 1 : 0;
        if ((stage.color(x, y) != 0) == hit) continue;
        bool border = false;
        for (int j = -32; j <= 32; ++j)
          for (int i = -32; i <= 32; ++i) border |= inside(x + 0.5 + i / 2048.0, y + 0.5 + j / 2048.0) != hit;
        ASSERT_TRUE(border) << "round " << round << " pixel " << x << " " << y << (hit ? " lost" : " gained");
      }
    }
  }
  EXPECT_GT(covered, 10000u);
}

}  // namespace
}  // namespace tessera::test::clip_test
