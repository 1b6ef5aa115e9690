// The triangles in the tiles' bins against the exact coverage reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "raster/binning.h"
#include "raster/coverage_reference.h"
#include "tests/raster/random_triangles.h"
#include "tests/raster/tile_harness.h"

namespace tessera::test::binning_test {
using namespace detail;
namespace {

constexpr int kTileSizes[] = {32, 64, 128};
int seeds(int normal) { return long_tests() ? normal * 20 : normal; }

std::vector<std::uint32_t> triangles_of(const Bins& bins, int tile) {
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t index = bins.first(tile); index != Bins::kNone; index = bins.block(index).next)
    for (std::uint32_t e = 0; e < bins.block(index).count; ++e)
      if (const std::uint32_t entry = bins.block(index).entries[e]; (entry & kDrawMarker) == 0)
        triangles.push_back(entry);
  return triangles;
}

// Single triangles: the bin of every tile with a covered pixel must hold the triangle.
TEST(Binning, BinsTriangleIntoEveryTileItCovers) {
  for (const int tile_size : kTileSizes) {
    RandomTriangles source(static_cast<std::uint32_t>(tile_size), 256);
    for (int i = 0; i < seeds(3000); ++i) {
      const Triangle t = source.next();
      const TriangleReference reference = reference_of(t);
      if (reference.area == 0) continue;
      const TileGrid grid{256, 256, tile_size};
      std::vector<std::uint8_t> touched(static_cast<std::size_t>(grid.count()));
      reference.for_each_covered(0, 0, 256, 256, [&](int x, int y) {
        touched[static_cast<std::size_t>(y / tile_size * grid.columns() + x / tile_size)] = 1;
      });
      BinDraw draw;
      draw.vertices = t.data();
      draw.rect = {0, 0, 256, 256};
      for (const InstructionSet isa : available_isas()) {
        Bins bins;
        bins.reset(grid.count());
        bin_triangles(bins, grid, draw, 0, 1, isa);
        for (int tile = 0; tile < grid.count(); ++tile) {
          const bool binned = bins.first(tile) != Bins::kNone;
          ASSERT_TRUE(binned || touched[static_cast<std::size_t>(tile)] == 0)
              << name_of(isa) << " tile " << tile << " of " << tile_size << ": " << Describe{t};
        }
      }
    }
  }
}

// Small triangles along tile borders, with larger ones between them.
std::vector<WindowVertex> triangles_along_borders(int count, int size, int tile_size) {
  RandomTriangles source(static_cast<std::uint32_t>(tile_size) + 1, size);
  std::vector<WindowVertex> vertices;
  for (int t = 0, start = 0, border = 0; t < count; ++t) {
    if (t % 20 == 0)
      start = source.between(0, size) * 256, border = source.between(1, size / tile_size) * tile_size * 256;
    const int extent = (t % 11 == 0 ? source.between(20, 90) : source.between(2, 6)) * 256;
    const int along = start + t % 20 * 700;
    const bool downwards = t % 40 < 20;
    const auto around = [&](int center) { return center + source.between(-extent / 2, extent / 2); };
    for (int k = 0; k < 3; ++k)
      vertices.push_back({around(downwards ? along : border), around(downwards ? border : along), 0, 1});
  }
  return vertices;
}

// Each bin holds its triangles once, in submission order, and none whose bounds miss the tile. Includes
// rectangles that cut triangles, and grids of one column.
TEST(Binning, KeepsSubmissionOrderInEachTile) {
  constexpr int kSize = 256, kCount = 16 * 40 + 7;
  for (const int tile_size : kTileSizes) {
    const std::vector<WindowVertex> vertices = triangles_along_borders(kCount, kSize, tile_size);
    for (const PixelRect& rect :
         {PixelRect{0, 0, kSize, kSize}, PixelRect{30, 20, 200, 231}, PixelRect{0, 0, tile_size, kSize}})
      for (const std::int32_t reach : {0, 128})
        for (const InstructionSet isa : available_isas()) {
          const TileGrid grid{rect.x1 == tile_size ? tile_size : kSize, kSize, tile_size};
          BinDraw draw;
          draw.vertices = vertices.data();
          draw.rect = rect;
          draw.sample_reach = reach;
          Bins bins;
          bins.reset(grid.count());
          bin_triangles(bins, grid, draw, 0, kCount, isa);
          for (int tile = 0; tile < grid.count(); ++tile) {
            SCOPED_TRACE(name_of(isa) + " tile " + std::to_string(tile) + " of " + std::to_string(tile_size) +
                         " reach " + std::to_string(reach));
            const int tile_x = tile % grid.columns() * tile_size, tile_y = tile / grid.columns() * tile_size;
            const PixelRect part = intersect(rect, {tile_x, tile_y, tile_x + tile_size, tile_y + tile_size});
            const std::vector<std::uint32_t> found = triangles_of(bins, tile);
            ASSERT_TRUE(std::is_sorted(found.begin(), found.end()) &&
                        std::adjacent_find(found.begin(), found.end()) == found.end());
            for (std::uint32_t t = 0; t < kCount; ++t) {
              const WindowVertex* const v = vertices.data() + std::size_t{3} * t;
              const auto [low_x, high_x] = std::minmax({v[0].x, v[1].x, v[2].x});
              const auto [low_y, high_y] = std::minmax({v[0].y, v[1].y, v[2].y});
              const PixelRect bounds =
                  intersect(part, {first_pixel(low_x - reach), first_pixel(low_y - reach),
                                   last_pixel(high_x + reach) + 1, last_pixel(high_y + reach) + 1});
              bool covers = false;
              if (!bounds.empty())
                reference_of({v[0], v[1], v[2]})
                    .for_each_covered(bounds.x0, bounds.y0, bounds.x1, bounds.y1,
                                      [&](int, int) { covers = true; });
              const bool is_binned = std::binary_search(found.begin(), found.end(), t);
              ASSERT_TRUE(is_binned ? !bounds.empty() : !covers) << "triangle " << t;
            }
          }
        }
  }
}

// Triangles up to three pixels wide, with vertices on pixel centres, on pixel edges or anywhere, in
// rectangles that cut them; in full groups of 16 and in partial ones.
TEST(Binning, CullsTrianglesBetweenSamplePoints) {
  constexpr std::uint32_t kCount = 16 * 200 + 5;
  constexpr int kSize = 128;
  RandomTriangles source(5, kSize);
  std::vector<WindowVertex> vertices;
  std::vector<std::uint32_t> backwards;
  for (std::uint32_t t = 0; t < kCount; ++t) {
    const int x = source.between(-2, kSize) * 256, y = source.between(-2, kSize) * 256;
    const int extent = source.between(1, 3) * 256;
    const int step = 1 << source.between(0, 7);
    for (int k = 0; k < 3; ++k)
      vertices.push_back(
          {x + source.between(0, extent / step) * step, y + source.between(0, extent / step) * step, 0, 1});
  }
  for (std::uint32_t i = 3 * kCount; i-- > 0;) backwards.push_back(i);
  std::size_t culled = 0, kept = 0;
  for (const PixelRect& rect : {PixelRect{0, 0, kSize, kSize}, PixelRect{17, 40, 90, 41}})
    for (const bool indexed : {false, true})
      for (const int reach : {0, 128})
        for (const InstructionSet isa : available_isas()) {
          BinDraw draw;
          draw.vertices = vertices.data();
          draw.indices = indexed ? backwards.data() : nullptr;
          draw.rect = rect;
          draw.sample_reach = reach;
          Bins bins;
          bins.reset(1);
          bin_triangles(bins, {kSize, kSize, kSize}, draw, 0, kCount, isa);
          std::vector<bool> binned(kCount);
          for (const std::uint32_t triangle : triangles_of(bins, 0)) binned[triangle] = true;
          for (std::uint32_t t = 0; t < kCount; ++t) {
            const auto vertex = [&](std::uint32_t k) { return vertices[vertex_index<3>(draw, t, k)]; };
            const Triangle triangle{vertex(0), vertex(1), vertex(2)};
            const TriangleReference reference = reference_of(triangle);
            const auto [low_x, high_x] = std::minmax({triangle[0].x, triangle[1].x, triangle[2].x});
            const auto [low_y, high_y] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
            const int x0 = std::max(first_pixel(low_x - reach), rect.x0);
            const int x1 = std::min(last_pixel(high_x + reach), rect.x1 - 1);
            const int y0 = std::max(first_pixel(low_y - reach), rect.y0);
            const int y1 = std::min(last_pixel(high_y + reach), rect.y1 - 1);
            bool expected = reference.area != 0 && x0 <= x1 && y0 <= y1;
            // Larger triangles, cut by the rectangle, are not culled.
            const bool is_small = high_x - low_x < 768 && high_y - low_y < 768;
            const bool has_few_pixels = x1 - x0 <= 1 && y1 - y0 <= 1;
            if (expected && reach == 0 && has_few_pixels && is_small) {
              // All 2x2 pixels count, including those outside the rectangle: culling is conservative there.
              bool covers = false, covers_any = false;
              reference.for_each_covered(x0, y0, x0 + 2, y0 + 2, [&](int x, int y) {
                covers |= x <= x1 && y <= y1;
                covers_any = true;
              });
              ASSERT_TRUE(covers_any || !covers);
              expected = covers_any;
              ++(expected ? kept : culled);
            }
            ASSERT_EQ(binned[t], expected)
                << name_of(isa) << " reach " << reach << ": " << Describe{triangle};
          }
        }
  EXPECT_GT(culled, 1000u);
  EXPECT_GT(kept, 1000u);
}

// Large triangles with 64-bit edges, cut to 2x2 pixels by the rectangle, must not be culled as small ones.
TEST(Binning, KeepsLargeTrianglesInRectanglesOfFewPixels) {
  constexpr int kSize = 128;
  RandomTriangles source(9, kSize);
  std::size_t covered = 0;
  for (int i = 0; i < seeds(20000); ++i) {
    const Triangle t = source.next();
    const int x = source.between(0, kSize - 2), y = source.between(0, kSize - 2);
    bool touched = false;
    reference_of(t).for_each_covered(x, y, x + 2, y + 2, [&](int, int) { touched = true; });
    if (!touched) continue;
    ++covered;
    BinDraw draw;
    draw.vertices = t.data();
    draw.rect = {x, y, x + 2, y + 2};
    for (const InstructionSet isa : available_isas()) {
      Bins bins;
      bins.reset(1);
      bin_triangles(bins, {kSize, kSize, kSize}, draw, 0, 1, isa);
      ASSERT_NE(bins.first(0), Bins::kNone) << name_of(isa) << ": " << Describe{t};
    }
  }
  EXPECT_GT(covered, 1000u);
}

TEST(Binning, CullsAndCountsUnwantedFaces) {
  // Counter-clockwise in the window.
  const Triangle counter_clockwise{WindowVertex{0, 2560, 0, 1}, WindowVertex{2560, 2560, 0, 1},
                                   WindowVertex{0, 0, 0, 1}};
  for (const bool clockwise_fronts : {false, true}) {
    for (const bool keep_front : {false, true}) {
      for (const bool keep_back : {false, true}) {
        BinDraw draw;
        draw.vertices = counter_clockwise.data();
        draw.rect = {0, 0, 64, 64};
        draw.front_is_clockwise = clockwise_fronts;
        draw.keep_front = keep_front;
        draw.keep_back = keep_back;
        Bins bins;
        bins.reset(1);
        bin_triangles(bins, {64, 64, 64}, draw, 0, 1, available_isas().front());
        const bool kept = clockwise_fronts ? keep_back : keep_front;
        EXPECT_EQ(bins.counts.binned, kept ? 1u : 0u);
        EXPECT_EQ(bins.counts.culled, kept ? 0u : 1u);
      }
    }
  }
}

}  // namespace
}  // namespace tessera::test::binning_test
