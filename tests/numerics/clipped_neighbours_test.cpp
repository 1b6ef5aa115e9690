// Neighbouring triangles that are clipped differently stay watertight. The visible part of a mesh covers each
// pixel exactly once; the part that clip planes remove covers no pixel. Only along a cut may a pixel be
// covered once or not at all, if it is closer to the exact cut than snapping moves vertices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "tests/numerics/plane_mesh.h"
#include "tests/numerics/snapped_folds.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::clipped_neighbours_test {
namespace {

constexpr int kSide = 64;
const CaseFormat kFormat{.width = kSide, .height = kSide};

int how_many(bool is_tessera, int normal, int in_long_tests) {
  return is_tessera && long_tests() ? in_long_tests : normal;
}

// A small viewport has its guard band at 512 times its half size, the largest at only twice. The buffer shows
// a random part of the viewport.
SquareViewport random_view(MeshRandom& random) {
  const int side = random.one_of({kSide, 2048, 16384});
  return {-random.between(0, side - kSide), -random.between(0, side - kSide), side};
}
CaseDraw counting(const CountedMesh& mesh, const SquareViewport& view) {
  CaseDraw draw = counting(mesh);
  draw.viewport = Rect{view.x, view.y, view.side, view.side};
  return draw;
}

// Clip planes that cut the triangles, as bits: 1 near, 2 far, 4 guard band. Triangles entirely outside a
// plane are ignored.
std::set<int> cuts_of(const CountedMesh& mesh, const SquareViewport& view) {
  std::set<int> cuts;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    int some = 0;
    int all = 63;
    for (std::size_t k = 0; k < 3; ++k) {
      const float* p = mesh.positions.data() + 4 * mesh.indices[t + k];
      const double guard = 2 * 16383.0 / view.side * double{p[3]};
      const int code = (p[2] < -p[3] ? 1 : 0) | (p[2] > p[3] ? 2 : 0) | (p[0] < -guard ? 4 : 0) |
                       (p[0] > guard ? 8 : 0) | (p[1] < -guard ? 16 : 0) | (p[1] > guard ? 32 : 0);
      some |= code;
      all &= code;
    }
    if (all == 0) cuts.insert((some & 3) | (some > 3 ? 4 : 0));
  }
  return cuts;
}

TEST(ClippedNeighbours, PlanesThroughAllClipPlanes) {
  constexpr int kSize = 64;
  std::set<int> cuts;
  expect_coverage("planes clipped in all ways", kFormat, [&](const Count& count, bool is_tessera) {
    for (int n = 0; n < how_many(is_tessera, 3000, 1000000); ++n) {
      MeshRandom random(n);
      const ClipPlane plane = random_plane(random);
      const SquareViewport view = random_view(random);
      const std::optional<VisiblePlane> visible = plane.visible(view);
      if (!visible) continue;
      const Grid grid = random_plane_grid(random, kSize, 12);
      CountedMesh mesh = plane.mesh_at(grid.points, random.one_of({1.0, 0x1p100, 0x1p-100}));
      grid.cut_into(mesh, random);
      cuts.merge(cuts_of(mesh, view));
      count({counting(mesh, view)}, "plane " + std::to_string(n),
            {covers_of(plane.region(*visible, kSize), kSide, kSide, view),
             [&] { return snapping_folds(mesh, view); }});
    }
  });
  EXPECT_EQ(cuts.size(), 8u) << "expected all combinations of near, far and guard band";
}

// The near plane is the line u = 0, which holds vertices and edges.
ClipPlane plane_at_near(MeshRandom& random) {
  ClipPlane plane = random_plane(random);
  plane.origin.z = -plane.origin.w;
  plane.to_v.z = -plane.to_v.w;
  return plane;
}

TEST(ClippedNeighbours, ThousandsOfTrianglesMeetingAtTheNearPlane) {
  expect_coverage("thousands that meet at the near plane", kFormat, [](const Count& count, bool is_tessera) {
    for (int n = 0; n < how_many(is_tessera, 40, 4000); ++n) {
      MeshRandom random(n);
      const ClipPlane plane = plane_at_near(random);
      const SquareViewport view = random_view(random);
      const std::optional<VisiblePlane> visible = plane.visible(view);
      if (!visible) continue;
      // Rows of vertices along the plane.
      Grid grid{64, 64, {}};
      for (int v = -32; v <= 32; ++v)
        for (int u = -32; u <= 32; ++u) grid.points.push_back({u, v});
      CountedMesh mesh = plane.mesh_at(grid.points);
      grid.cut_into(mesh, random);
      count({counting(mesh, view)}, "grid " + std::to_string(n),
            {covers_of(plane.region(*visible, 32), kSide, kSide, view),
             [&] { return snapping_folds(mesh, view); }});
      // A fan around one vertex on the plane.
      constexpr int kSpokes = 4096;
      constexpr int kRadius = 4096;
      std::vector<WindowPoint> points{{0, 0}};
      for (int i = 0; i < kSpokes; ++i) {
        const double angle = 2 * std::numbers::pi * i / kSpokes;
        points.push_back({std::llround(kRadius * std::cos(angle)), std::llround(kRadius * std::sin(angle))});
      }
      CountedMesh fan = plane.mesh_at(points);
      for (std::uint32_t i = 1; i <= kSpokes; ++i) fan.add_triangle(0, i, i % kSpokes + 1);
      fan.shuffle(random);
      count({counting(fan, view)}, "fan " + std::to_string(n),
            {covers_of(plane.region(*visible, kRadius / 2), kSide, kSide, view),
             [&] { return snapping_folds(fan, view); }});
    }
  });
}

// z = 1 and depth 1/w: from the near plane at w = 1 to points at infinity (w = 0) and beyond.
TEST(ClippedNeighbours, UnderReversedInfiniteDepth) {
  constexpr int kSize = 64;
  const CaseFormat format{
      .width = kSide, .height = kSide, .depth = DepthFormat::float32, .reversed = true, .cleared_depth = 0};
  expect_coverage("planes under reversed infinite depth", format, [](const Count& count, bool is_tessera) {
    for (int n = 0; n < how_many(is_tessera, 1000, 200000); ++n) {
      MeshRandom random(n);
      ClipPlane plane = random_plane(random);
      plane.origin.z = 1;
      plane.to_u.z = plane.to_v.z = 0;
      const SquareViewport view = random_view(random);
      const std::optional<VisiblePlane> visible = plane.visible(view);
      if (!visible) continue;
      const Grid grid = random_plane_grid(random, kSize, 12);
      CountedMesh mesh = plane.mesh_at(grid.points);
      grid.cut_into(mesh, random);
      CaseDraw draw = counting(mesh, view);
      draw.test_depth = true;
      draw.depth_func = Compare::gequal;
      count({draw}, "plane " + std::to_string(n),
            {covers_of(plane.region(*visible, kSize, true), kSide, kSide, view),
             [&] { return snapping_folds(mesh, view, true); }});
    }
  });
}

// From the inside, a surface around the eye is visible exactly once in every direction, whichever part is in
// front, behind or beyond the guard band. Corners are at any distance, so all kinds of cuts occur.
TEST(ClippedNeighbours, SurfacesAroundTheEye) {
  expect_coverage("surfaces around the eye", kFormat, [](const Count& count, bool is_tessera) {
    for (int n = 0; n < how_many(is_tessera, 2000, 1000000); ++n) {
      MeshRandom random(n);
      const int cells = random.between(1, 6);
      const double spread = random.one_of({0, random.between(0, 4), 30});  // decades
      const double degrees = 360 * random.unit();
      const double x = random.unit() - 0.5;
      const double y = random.unit() - 0.5;
      const double z = random.unit() + 0.1;
      const Matrix turn = rotate(degrees, x, y, z);
      const Matrix view = perspective(random.one_of({5.0, 40.0, 90.0, 150.0}), 1, 1e-18, 1e18) * turn;
      CountedMesh mesh;
      // Corners of the cells of a cube in whole numbers, identical on all faces that meet there.
      std::vector<std::array<int, 3>> keys;
      const auto vertex = [&](const std::array<int, 3>& key) {
        const auto found = std::find(keys.begin(), keys.end(), key);
        if (found != keys.end()) return static_cast<std::uint32_t>(found - keys.begin());
        keys.push_back(key);
        const double distance = std::pow(10, spread * (random.unit() - 0.5)) / cells;
        const auto row = [&](std::size_t r) {
          return distance *
                     (view.m[4 * r] * key[0] + view.m[4 * r + 1] * key[1] + view.m[4 * r + 2] * key[2]) +
                 view.m[4 * r + 3];
        };
        return mesh.add_vertex(row(0), row(1), row(2), row(3));
      };
      for (std::size_t face = 0; face < 6; ++face)
        for (int j = -cells; j < cells; j += 2)
          for (int i = -cells; i < cells; i += 2) {
            const auto corner = [&](int u, int v) {
              std::array<int, 3> key{};
              key[face / 2] = face % 2 != 0 ? cells : -cells;
              key[(face / 2 + 1) % 3] = u;
              key[(face / 2 + 2) % 3] = v;
              return vertex(key);
            };
            const std::uint32_t p = corner(i, j);
            const std::uint32_t q = corner(i + 2, j);
            const std::uint32_t r = corner(i + 2, j + 2);
            const std::uint32_t s = corner(i, j + 2);
            mesh.add_triangle(p, q, r);
            mesh.add_triangle(p, r, s);
          }
      mesh.shuffle(random);
      count({counting(mesh)}, "surface " + std::to_string(n), {.overlaps = [&] {
              return snapping_folds(mesh, {0, 0, kSide});
            }});
    }
  });
}

}  // namespace
}  // namespace tessera::test::clipped_neighbours_test
