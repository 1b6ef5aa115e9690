// Triangles that share edges cover each pixel exactly once: whole meshes on a buffer that counts, through all of the engine. No tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tests/numerics/counting.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test {
namespace {

constexpr int kSide = 64;

struct Draws {
  std::mt19937 random;
  double unit() { return static_cast<double>(random()) * 0x1p-32; }
  int between(int low, int high) { return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1)); }
};

/// Window coordinates, in 1/256 pixel from the lower left corner, of buffers whose sides are powers of two: exact in clip space.
std::uint32_t add_window_vertex(CountedMesh& mesh, std::int64_t x, std::int64_t y, int width = kSide, int height = kSide) {
  return mesh.add_vertex(static_cast<double>(x) / (128.0 * width) - 1, static_cast<double>(y) / (128.0 * height) - 1);
}

void expect_once(Counter& counter, CountedMesh& mesh, Draws& draws, const std::string& what) {
  mesh.shuffle(draws.random);
  const std::vector<std::uint32_t>& counts = counter.count(mesh);
  const auto wrong = std::find_if(counts.begin(), counts.end(), [](std::uint32_t c) { return c != 1; });
  ASSERT_TRUE(wrong == counts.end()) << what << ": pixel " << wrong - counts.begin() << " is covered " << *wrong << " times";
}

using Point = std::array<std::int64_t, 2>;
std::int64_t doubled_area(const Point& a, const Point& b, const Point& c) { return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]); }

// Beyond the frame on all sides. Inner vertices are anywhere, on pixel centres, or on pixel borders (of which some are those of tiles).
CountedMesh jittered_grid(Draws& draws) {
  const int columns = draws.between(1, 24), rows = draws.between(1, 24), snap = std::array{1, 128, 256}[static_cast<std::size_t>(draws.between(0, 2))];
  const double jitter = draws.unit(), cell_x = (kSide + 8.0) * 256 / columns, cell_y = (kSide + 8.0) * 256 / rows;
  std::vector<Point> points;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const auto place = [&](double cell, int n, int last) {
        const double at = cell * (n + (n > 0 && n < last ? jitter * (draws.unit() - 0.5) : 0)) - 1024;
        return static_cast<std::int64_t>(std::lround(at / snap)) * snap;
      };
      const std::int64_t x = place(cell_x, i, columns);
      points.push_back({x, place(cell_y, j, rows)});
    }
  CountedMesh mesh;
  for (const Point& p : points) add_window_vertex(mesh, p[0], p[1]);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const auto at = [&](int di, int dj) { return static_cast<std::uint32_t>((j + dj) * (columns + 1) + i + di); };
      const std::uint32_t p = at(0, 0), q = at(1, 0), r = at(1, 1), s = at(0, 1);
      // A cell that is not convex has one diagonal inside.
      const auto area = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { return doubled_area(points[a], points[b], points[c]); };
      const bool first = area(p, q, r) >= 0 && area(p, r, s) >= 0, second = area(q, r, s) >= 0 && area(q, s, p) >= 0;
      if (first && (!second || draws.between(0, 1) != 0)) {
        mesh.add_triangle(p, q, r, draws.random);
        mesh.add_triangle(p, r, s, draws.random);
      } else {
        mesh.add_triangle(q, r, s, draws.random);
        mesh.add_triangle(q, s, p, draws.random);
      }
    }
  return mesh;
}

// Snapped to coarse places, cells of fine grids fold over; those are no meshes without overlap.
bool folds(const CountedMesh& mesh) {
  double area = 0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const auto corner = [&](std::size_t k) { return Point{std::llround((double{mesh.positions[4 * mesh.indices[t + k]]} + 1) * 128 * kSide), std::llround((double{mesh.positions[4 * mesh.indices[t + k] + 1]} + 1) * 128 * kSide)}; };
    area += static_cast<double>(std::abs(doubled_area(corner(0), corner(1), corner(2))));
  }
  constexpr double kWhole = 2 * 256.0 * 256.0 * (kSide + 8) * (kSide + 8);
  return area != kWhole;
}

TEST(ExactlyOnce, Grids) {
  Draws draws{std::mt19937(1)};
  Counter counter(kSide, kSide);
  const int wanted = long_tests() ? 1000000 : 10000;
  for (int n = 0; n < wanted;) {
    CountedMesh mesh = jittered_grid(draws);
    if (folds(mesh)) continue;
    expect_once(counter, mesh, draws, "grid " + std::to_string(n++));
    if (HasFatalFailure()) return;
  }
}

// Around a pixel's centre or corner, to points beyond the frame.
TEST(ExactlyOnce, Fans) {
  Draws draws{std::mt19937(2)};
  Counter counter(kSide, kSide);
  for (int n = 0; n < (long_tests() ? 100000 : 2000); ++n) {
    const Point center{draws.between(0, kSide) * 256 + draws.between(0, 1) * 128, draws.between(0, kSide) * 256 + draws.between(0, 1) * 128};
    CountedMesh mesh;
    add_window_vertex(mesh, center[0], center[1]);
    const int count = draws.between(5, 200);
    std::vector<Point> rim;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.9 * draws.unit()) / count, radius = 256 * kSide * (6 + 5 * draws.unit())  /* no chord comes near the frame */;
      rim.push_back({center[0] + std::llround(radius * std::cos(angle)), center[1] + std::llround(radius * std::sin(angle))});
      add_window_vertex(mesh, rim.back()[0], rim.back()[1]);
    }
    bool turns = true;
    for (int i = 0; i < count; ++i) {
      turns &= doubled_area(center, rim[static_cast<std::size_t>(i)], rim[static_cast<std::size_t>((i + 1) % count)]) > 0;
      mesh.add_triangle(0, static_cast<std::uint32_t>(i + 1), static_cast<std::uint32_t>((i + 1) % count + 1), draws.random);
    }
    if (!turns) continue;
    expect_once(counter, mesh, draws, "fan " + std::to_string(n));
    if (HasFatalFailure()) return;
  }
}

// 1/256 pixel wide and 16,384 pixels long, lying and standing.
TEST(ExactlyOnce, LongSlivers) {
  Draws draws{std::mt19937(3)};
  constexpr int kLong = 16384, kShort = 2;
  for (const bool lying : {true, false}) {
    const int width = lying ? kLong : kShort, height = lying ? kShort : kLong;
    Counter counter(width, height);
    CountedMesh mesh;
    for (int k = 0; k <= kShort * 256; ++k)
      for (const std::int64_t end : {0, kLong * 256}) add_window_vertex(mesh, lying ? end : k, lying ? k : end, width, height);
    for (std::uint32_t k = 0; k < kShort * 256; ++k) {
      mesh.add_triangle(2 * k, 2 * k + 1, 2 * k + 3, draws.random);
      mesh.add_triangle(2 * k, 2 * k + 3, 2 * k + 2, draws.random);
    }
    expect_once(counter, mesh, draws, lying ? "lying" : "standing");
  }
}

// Seen from within, a surface around the eye is seen once in each direction, whatever of it is in front, behind or beyond the guard band: corners are
// as far away as they like, so triangles are clipped in all ways.
TEST(ExactlyOnce, SurfacesAroundTheEye) {
  Draws draws{std::mt19937(4)};
  Counter counter(kSide, kSide);
  for (int n = 0; n < (long_tests() ? 100000 : 2000); ++n) {
    const int cells = draws.between(1, 6);
    const double spread = draws.between(0, 1) != 0 ? 0 : draws.between(0, 4);
    const Matrix turn = rotate(360 * draws.unit(), draws.unit() - 0.5, draws.unit() - 0.5, draws.unit() + 0.1);
    const Matrix view = perspective(std::array{5.0, 40.0, 90.0, 150.0}[static_cast<std::size_t>(draws.between(0, 3))], 1, 1e-6, 1e12) * turn;
    CountedMesh mesh;
    std::vector<std::array<int, 3>> keys;  // corners of a cube's faces, whole numbers: the same on all faces that meet there
    const auto vertex = [&](const std::array<int, 3>& key) {
      const auto found = std::find(keys.begin(), keys.end(), key);
      if (found != keys.end()) return static_cast<std::uint32_t>(found - keys.begin());
      keys.push_back(key);
      const double distance = std::pow(10, spread * (draws.unit() - 0.5));
      std::array<double, 4> clip{};
      for (int row = 0; row < 4; ++row) {
        for (int c = 0; c < 3; ++c) clip[static_cast<std::size_t>(row)] += view.m[static_cast<std::size_t>(4 * row + c)] * distance * key[static_cast<std::size_t>(c)] / cells;
        clip[static_cast<std::size_t>(row)] += view.m[static_cast<std::size_t>(4 * row + 3)];
      }
      return mesh.add_vertex(clip[0], clip[1], clip[2], clip[3]);
    };
    for (int face = 0; face < 6; ++face)
      for (int j = -cells; j < cells; j += 2)
        for (int i = -cells; i < cells; i += 2) {
          const auto corner = [&](int u, int v) {
            std::array<int, 3> key{};
            key[static_cast<std::size_t>(face / 2)] = face % 2 != 0 ? cells : -cells;
            key[static_cast<std::size_t>((face / 2 + 1) % 3)] = u;
            key[static_cast<std::size_t>((face / 2 + 2) % 3)] = v;
            return vertex(key);
          };
          const std::uint32_t p = corner(i, j), q = corner(i + 2, j), r = corner(i + 2, j + 2), s = corner(i, j + 2);
          mesh.add_triangle(p, q, r, draws.random);
          mesh.add_triangle(p, r, s, draws.random);
        }
    expect_once(counter, mesh, draws, "surface " + std::to_string(n) + " cells " + std::to_string(cells) + " spread " + std::to_string(spread) + " vertices " + std::to_string(keys.size()));
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace tessera::test
