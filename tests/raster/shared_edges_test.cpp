// Triangles that share edges cover every pixel exactly once over all tiles, including binning.
//
// Method: tiles count the pixels they shade. The painted pixels must be the union of the triangles by the
// exact reference. If the count equals their number, no pixel was shaded twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "raster/coverage_reference.h"
#include "tests/raster/random_triangles.h"
#include "tests/raster/tile_harness.h"

namespace tessera::test::shared_edges_test {
using namespace detail;
namespace {

struct IndexedMesh {
  std::vector<WindowVertex> vertices;
  std::vector<std::uint32_t> indices;
  void add(std::size_t a, std::size_t b, std::size_t c, bool turned = false) {
    for (const std::size_t i : {a, turned ? c : b, turned ? b : c})
      indices.push_back(static_cast<std::uint32_t>(i));
  }
};

// A grid over [-margin, size + margin]. `jitter` moves inner vertices by less than half a cell, so that no
// cell folds.
IndexedMesh jittered_grid(RandomTriangles& source, int width_px, int height_px, int columns, int rows,
                          double jitter) {
  IndexedMesh mesh;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double cell_x = (width_px + 8.0) * 256 / columns, cell_y = (height_px + 8.0) * 256 / rows;
      const bool inner_x = i > 0 && i < columns;
      const bool inner_y = j > 0 && j < rows;
      mesh.vertices.push_back({static_cast<std::int32_t>(std::lround(
                                   cell_x * (i + (inner_x ? jitter * (source.unit() - 0.5) : 0)) - 1024)),
                               static_cast<std::int32_t>(std::lround(
                                   cell_y * (j + (inner_y ? jitter * (source.unit() - 0.5) : 0)) - 1024)),
                               0, 1});
    }
  }
  const auto at = [columns](int i, int j) { return static_cast<std::size_t>(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      // Random diagonal and winding. A jittered cell may be concave; then only one diagonal lies inside.
      const auto cross = [&](std::size_t o, std::size_t a, std::size_t b) {
        const WindowVertex &vo = mesh.vertices[o], &va = mesh.vertices[a], &vb = mesh.vertices[b];
        return static_cast<double>(va.x - vo.x) * (vb.y - vo.y) -
               static_cast<double>(vb.x - vo.x) * (va.y - vo.y);
      };
      const std::size_t p = at(i, j), q = at(i + 1, j), r = at(i + 1, j + 1), s = at(i, j + 1);
      const bool first_inside = cross(p, q, r) >= 0 && cross(p, r, s) >= 0;
      const bool second_inside = cross(q, r, s) >= 0 && cross(q, s, p) >= 0;
      const bool turned = source.between(0, 1) != 0;
      const bool first = first_inside && (!second_inside || source.between(0, 1) != 0);
      mesh.add(first ? p : q, first ? q : r, first ? r : s, turned);
      mesh.add(first ? p : q, first ? r : s, first ? s : p, turned);
    }
  }
  return mesh;
}

// A closed fan around `center`: points ordered by angle, less than half a turn apart even after snapping.
IndexedMesh fan(RandomTriangles& source, WindowVertex center, int count, double radius_px) {
  for (;;) {
    IndexedMesh mesh;
    mesh.vertices.push_back(center);
    for (int i = 0; i < count; ++i) {
      const double angle = (i + 0.8 * source.unit()) * 6.283185307179586 / count;
      const double radius = 256 * radius_px * (0.05 + source.unit());
      mesh.vertices.push_back({center.x + static_cast<std::int32_t>(std::lround(radius * std::cos(angle))),
                               center.y + static_cast<std::int32_t>(std::lround(radius * std::sin(angle))), 0,
                               1});
    }
    bool folds = false;
    for (std::size_t i = 1; i < mesh.vertices.size(); ++i) {
      const WindowVertex &a = mesh.vertices[i], &b = mesh.vertices[i + 1 < mesh.vertices.size() ? i + 1 : 1];
      folds |=
          std::int64_t{a.x - center.x} * (b.y - center.y) <= std::int64_t{b.x - center.x} * (a.y - center.y);
    }
    if (folds) continue;
    for (int i = 0; i < count; ++i)
      mesh.add(0, static_cast<std::size_t>(1 + i), static_cast<std::size_t>(1 + (i + 1) % count),
               source.between(0, 1) != 0);
    return mesh;
  }
}

// A convex polygon split into triangles by random diagonals.
IndexedMesh polygon(RandomTriangles& source, int count, double width_px, double height_px) {
  IndexedMesh mesh;
  const double start = source.unit();
  for (int i = 0; i < count; ++i) {
    const double angle = (i + start) * 6.283185307179586 / count;
    mesh.vertices.push_back(
        {static_cast<std::int32_t>(std::lround(256 * width_px / 2 * (1 + std::cos(angle)))),
         static_cast<std::int32_t>(std::lround(256 * height_px / 2 * (1 + std::sin(angle)))), 0, 1});
  }
  std::vector<std::size_t> left(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  while (left.size() > 2) {
    const auto ear = static_cast<std::size_t>(source.between(0, static_cast<std::int32_t>(left.size()) - 1));
    const auto n = left.size();
    mesh.add(left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n], source.between(0, 1) != 0);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return mesh;
}

// Draws the mesh on every instruction set; returns the number of covered pixels.
std::size_t expect_each_pixel_once(const IndexedMesh& mesh, int width_px, int height_px, int tile_size) {
  std::vector<std::uint8_t> inside(static_cast<std::size_t>(width_px * height_px));
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Triangle t{mesh.vertices[mesh.indices[i]], mesh.vertices[mesh.indices[i + 1]],
                     mesh.vertices[mesh.indices[i + 2]]};
    const auto [low_x, high_x] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [low_y, high_y] = std::minmax({t[0].y, t[1].y, t[2].y});
    reference_of(t).for_each_covered(
        std::max(0, low_x / 256 - 1), std::max(0, low_y / 256 - 1), std::min(width_px, high_x / 256 + 2),
        std::min(height_px, high_y / 256 + 2),
        [&](int x, int y) { ++inside[static_cast<std::size_t>(y * width_px + x)]; });
  }
  for (const std::uint8_t times : inside) EXPECT_LE(times, 1) << "the reference itself covers a pixel twice";
  const auto covered = static_cast<std::size_t>(std::count(inside.begin(), inside.end(), 1));

  for (const InstructionSet isa : available_isas()) {
    TileHarness stage(width_px, height_px, tile_size);
    TileDraw& draw = stage.add_draw(mesh.vertices.data());
    draw.indices = mesh.indices.data();
    draw.packed_color = 1;
    BinDraw bin;
    bin.vertices = mesh.vertices.data();
    bin.indices = mesh.indices.data();
    bin.rect = draw.rect;
    bin_triangles(stage.bins(), stage.frame().grid, bin, 0,
                  static_cast<std::uint32_t>(mesh.indices.size() / 3), isa);
    std::uint64_t shaded = 0, wrong = 0;
    const TileGrid grid = stage.frame().grid;
    for (int tile = 0; tile < grid.count(); ++tile) {
      shaded += stage.render(isa, tile).shaded_pixels;
      const int tile_x = tile % grid.columns() * tile_size, tile_y = tile / grid.columns() * tile_size;
      for (int y = 0; y < std::min(tile_size, height_px - tile_y); ++y)
        for (int x = 0; x < std::min(tile_size, width_px - tile_x); ++x)
          wrong += stage.color(x, y) != inside[static_cast<std::size_t>((tile_y + y) * width_px + tile_x + x)]
                       ? 1
                       : 0;
    }
    EXPECT_EQ(wrong, 0u) << name_of(isa) << ": pixels lost or gained, tiles of " << tile_size;
    EXPECT_EQ(shaded, covered) << name_of(isa) << ": pixels covered more than once, tiles of " << tile_size;
  }
  return covered;
}

constexpr int kTileSizes[] = {32, 64, 128};
int seeds(int normal) { return long_tests() ? normal * 20 : normal; }

TEST(SharedEdges, GridsCoverTheFrameOnce) {
  for (int seed = 0; seed < seeds(20); ++seed) {
    RandomTriangles source(static_cast<std::uint32_t>(seed), 64);
    const int width = source.between(1, 300), height = source.between(1, 300);
    const int cells = 1 << source.between(0, 7);
    const IndexedMesh mesh = jittered_grid(source, width, height, cells, source.between(1, cells),
                                           source.between(0, 3) == 0 ? 0.0 : 0.9);
    for (const int tile_size : kTileSizes) {
      SCOPED_TRACE(seed);
      EXPECT_EQ(expect_each_pixel_once(mesh, width, height, tile_size),
                static_cast<std::size_t>(width * height));
    }
  }
}
TEST(SharedEdges, GridsFinerThanPixelsCoverTheFrameOnce) {
  for (int seed = 0; seed < seeds(4); ++seed) {
    RandomTriangles source(static_cast<std::uint32_t>(seed), 64);
    const IndexedMesh mesh = jittered_grid(source, 100, 70, 250, 190, 0.9);
    for (const int tile_size : kTileSizes) EXPECT_EQ(expect_each_pixel_once(mesh, 100, 70, tile_size), 7000u);
  }
}
TEST(SharedEdges, FansAroundPixelCentresCoverPixelsOnce) {
  for (int seed = 0; seed < seeds(60); ++seed) {
    RandomTriangles source(static_cast<std::uint32_t>(seed), 64);
    // On a pixel centre, on a corner of four tiles, or anywhere.
    WindowVertex center{70 * 256 + 128, 61 * 256 + 128, 0, 1};
    if (seed % 3 == 1) center = {64 * 256, 64 * 256, 0, 1};
    if (seed % 3 == 2) center = {source.between(0, 128 * 256), source.between(0, 128 * 256), 0, 1};
    const IndexedMesh mesh = fan(source, center, source.between(3, 40), std::exp2(1 + 6 * source.unit()));
    SCOPED_TRACE(seed);
    for (const int tile_size : kTileSizes) expect_each_pixel_once(mesh, 150, 140, tile_size);
  }
}
TEST(SharedEdges, RandomlySplitPolygonsCoverPixelsOnce) {
  for (int seed = 0; seed < seeds(40); ++seed) {
    RandomTriangles source(static_cast<std::uint32_t>(seed), 64);
    const double width = 20 + 280 * source.unit(), height = seed % 4 == 0 ? 1.5 : 20 + 180 * source.unit();
    const IndexedMesh mesh = polygon(source, source.between(3, 40), width, height);
    SCOPED_TRACE(seed);
    for (const int tile_size : kTileSizes) expect_each_pixel_once(mesh, 300, 200, tile_size);
  }
}
// Triangles with 64-bit edges next to triangles with 32-bit edges: both paths agree on the shared edge.
TEST(SharedEdges, VeryLargeTrianglesCoverTheFrameOnce) {
  for (int seed = 0; seed < seeds(30); ++seed) {
    RandomTriangles source(static_cast<std::uint32_t>(seed), 64);
    IndexedMesh mesh;
    const WindowVertex center{source.between(0, 300 * 256), source.between(0, 200 * 256), 0, 1};
    mesh.vertices.push_back(center);
    const int count = source.between(4, 12);
    for (int i = 0; i < count; ++i) {
      const double angle = (i + 0.3 * source.unit()) * 6.283185307179586 / count;
      const double radius = 256 * (i % 2 == 0 ? 16000.0 : 1500.0);
      mesh.vertices.push_back({center.x + static_cast<std::int32_t>(std::lround(radius * std::cos(angle))),
                               center.y + static_cast<std::int32_t>(std::lround(radius * std::sin(angle))), 0,
                               1});
    }
    for (int i = 0; i < count; ++i)
      mesh.add(0, static_cast<std::size_t>(1 + i), static_cast<std::size_t>(1 + (i + 1) % count));
    SCOPED_TRACE(seed);
    for (const int tile_size : kTileSizes)
      EXPECT_EQ(expect_each_pixel_once(mesh, 300, 200, tile_size), 60000u);
  }
}

}  // namespace
}  // namespace tessera::test::shared_edges_test
