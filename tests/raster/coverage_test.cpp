// Coverage is exact: every pixel of a tile, on every path and instruction set, matches 128-bit integer
// arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "tests/raster/random_triangles.h"
#include "tests/raster/tile_harness.h"

namespace tessera::test::coverage_test {
namespace {

// Sets the depth words of triangle i nearer than those of earlier triangles: all pass the depth test,
// which selects other pixel paths. At most 120 triangles.
void bring_nearer(DepthFormat kind, Triangle& triangle, std::uint32_t i) {
  for (WindowVertex& vertex : triangle) vertex.z = (120 - i) << (kind == DepthFormat::float32 ? 23 : 25);
}
constexpr std::int32_t kFarthest = std::numeric_limits<std::int32_t>::max();

// Triangles in one tile. Each is a separate draw that writes its own colour bit, so none hides another.
void compare_by_bits(std::uint32_t seed, int tile_size, int rounds, PixelRect rect,
                     DepthFormat depth = DepthFormat::none) {
  RandomTriangles source(seed, tile_size);
  TileHarness stage(tile_size, tile_size, tile_size, depth);
  std::vector<WindowVertex> vertices(3 * 32);
  std::vector<Triangle> triangles(32);
  std::vector<std::uint32_t> expected(static_cast<std::size_t>(tile_size * tile_size));
  std::array<int, static_cast<std::size_t>(Shape::kCount)> drawn{}, visible{};
  for (int round = 0; round < rounds; ++round) {
    stage.clear_draws();
    std::fill(expected.begin(), expected.end(), 0u);
    for (std::uint32_t bit = 0; bit < 32; ++bit) {
      const auto shape = static_cast<std::size_t>(source.any_shape());
      triangles[bit] = source.next(static_cast<Shape>(shape));
      bring_nearer(depth, triangles[bit], bit);
      std::copy(triangles[bit].begin(), triangles[bit].end(), vertices.begin() + 3 * bit);
      TileDraw& draw = stage.add_draw(vertices.data() + 3 * bit);
      draw.rect = rect;
      draw.uses_depth = depth != DepthFormat::none;
      draw.packed_color = 0xffffffffu;
      draw.write_mask = 1u << bit;
      if (reference_of(triangles[bit]).area == 0) continue;  // dropped by binning
      stage.push(0, bit, 0);
      bool is_visible = false;
      reference_of(triangles[bit]).for_each_covered(rect.x0, rect.y0, rect.x1, rect.y1, [&](int x, int y) {
        expected[static_cast<std::size_t>(y * tile_size + x)] |= 1u << bit;
        is_visible = true;
      });
      ++drawn[shape];
      visible[shape] += is_visible ? 1 : 0;
    }
    for (const InstructionSet isa : available_isas()) {
      stage.render(isa, 0, 0, kFarthest);
      for (int y = 0; y < tile_size; ++y) {
        for (int x = 0; x < tile_size; ++x) {
          const std::uint32_t wrong =
              stage.color(x, y) ^ expected[static_cast<std::size_t>(y * tile_size + x)];
          ASSERT_EQ(wrong, 0u) << name_of(isa) << ", tile of " << tile_size << ", round " << round
                               << ", pixel " << x << " " << y << ", triangle "
                               << Describe{triangles[static_cast<std::size_t>(std::countr_zero(wrong))]};
        }
      }
    }
  }
  if (rect.x1 - rect.x0 < tile_size || rect.y1 - rect.y0 < tile_size) return;
  for (std::size_t shape = 0; shape < drawn.size(); ++shape)
    EXPECT_GT(visible[shape], drawn[shape] / 50) << "too few visible triangles of shape " << shape;
}

int rounds_of_32(int normal) { return long_tests() ? normal * 33 : normal; }

TEST(Coverage, MatchesExactIntegersInTilesOf32) { compare_by_bits(1, 32, rounds_of_32(320), {0, 0, 32, 32}); }
TEST(Coverage, MatchesExactIntegersInTilesOf64) { compare_by_bits(2, 64, rounds_of_32(320), {0, 0, 64, 64}); }
TEST(Coverage, MatchesExactIntegersInTilesOf128) {
  compare_by_bits(3, 128, rounds_of_32(160), {0, 0, 128, 128});
}
TEST(Coverage, MatchesExactIntegersWithDepthTest) {
  for (const DepthFormat depth :
       {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32, DepthFormat::float32})
    for (const int size : {32, 64, 128})
      compare_by_bits(30 + static_cast<std::uint32_t>(size), size, rounds_of_32(size == 128 ? 20 : 40),
                      {0, 0, size, size}, depth);
}
TEST(Coverage, MatchesExactIntegersInRectanglesThatCutBlocks) {
  RandomTriangles source(4, 64);
  for (int i = 0; i < 40; ++i) {
    PixelRect rect{source.between(0, 40), source.between(0, 40), 0, 0};
    rect.x1 = source.between(rect.x0 + 1, 64);
    rect.y1 = source.between(rect.y0 + 1, 64);
    compare_by_bits(100 + static_cast<std::uint32_t>(i), 64, rounds_of_32(4), rect,
                    i % 2 == 0 ? DepthFormat::none : DepthFormat::unorm24);
  }
}

// Triangles of one draw share groups of 16; the last one that covers a pixel determines its colour.
TEST(Coverage, GroupsOfTrianglesPaintInOrder) {
  constexpr int kTile = 64, kTriangles = 100;
  RandomTriangles source(5, kTile);
  std::vector<WindowVertex> vertices(3 * kTriangles);
  std::vector<std::uint32_t> packed_colors(kTriangles), expected(kTile * kTile);
  constexpr DepthFormat kDepths[] = {DepthFormat::none, DepthFormat::unorm24, DepthFormat::float32};
  for (int round = 0; round < (long_tests() ? 2000 : 90); ++round) {
    const DepthFormat depth = kDepths[round % 3];
    TileHarness stage(kTile, kTile, kTile, depth);
    TileDraw& draw = stage.add_draw(vertices.data());
    draw.uses_depth = depth != DepthFormat::none;
    draw.source = ColorSource::per_triangle_packed;
    draw.packed_colors[0] = draw.packed_colors[1] = packed_colors.data();
    std::fill(expected.begin(), expected.end(), 0u);
    for (std::uint32_t i = 0; i < kTriangles; ++i) {
      Triangle t = source.next(round % 4 == 0 ? Shape::tiny : source.any_shape());
      bring_nearer(depth, t, i);
      std::copy(t.begin(), t.end(), vertices.begin() + 3 * i);
      packed_colors[i] = i + 1;
      if (reference_of(t).area == 0) continue;
      stage.push(0, 0, i);
      reference_of(t).for_each_covered(0, 0, kTile, kTile, [&](int x, int y) {
        expected[static_cast<std::size_t>(y * kTile + x)] = i + 1;
      });
    }
    for (const InstructionSet isa : available_isas()) {
      stage.render(isa, 0, 0, kFarthest);
      for (int y = 0; y < kTile; ++y)
        for (int x = 0; x < kTile; ++x)
          ASSERT_EQ(stage.color(x, y), expected[static_cast<std::size_t>(y * kTile + x)])
              << name_of(isa) << " round " << round << ", pixel " << x << " " << y;
    }
  }
}

// The top-left rule: left and top borders belong to a triangle, right and bottom ones do not.
TEST(CoverageReference, OwnsLeftAndTopBorders) {
  const Triangle upper{WindowVertex{128, 128, 0, 1}, WindowVertex{1152, 128, 0, 1},
                       WindowVertex{128, 1152, 0, 1}};
  const Triangle lower{WindowVertex{1152, 1152, 0, 1}, WindowVertex{1152, 128, 0, 1},
                       WindowVertex{128, 1152, 0, 1}};
  EXPECT_TRUE(reference_of(upper).covers(0, 0));
  EXPECT_TRUE(reference_of(upper).covers(3, 0)) << "top border";
  EXPECT_TRUE(reference_of(upper).covers(0, 3)) << "left border";
  EXPECT_FALSE(reference_of(upper).covers(4, 0)) << "end of the top border, on a right border";
  EXPECT_FALSE(reference_of(upper).covers(2, 2)) << "right border";
  EXPECT_TRUE(reference_of(lower).covers(2, 2)) << "the same border, left border of this triangle";
  EXPECT_FALSE(reference_of(lower).covers(4, 2)) << "right border";
  EXPECT_FALSE(reference_of(lower).covers(2, 4)) << "bottom border";
}
TEST(CoverageReference, SteppedAndSinglePixelsAgree) {
  RandomTriangles source(6, 32);
  for (int i = 0; i < 2000; ++i) {
    const Triangle t = source.next();
    int stepped = 0, single = 0;
    reference_of(t).for_each_covered(0, 0, 32, 32, [&](int x, int y) {
      ++stepped;
      EXPECT_TRUE(reference_of(t).covers(x, y)) << Describe{t};
    });
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) single += reference_of(t).covers(x, y) ? 1 : 0;
    ASSERT_EQ(stepped, single) << Describe{t};
  }
}

}  // namespace
}  // namespace tessera::test::coverage_test
