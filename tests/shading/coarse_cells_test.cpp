// Where triangles are lit in cells of pixels: bit-identical to the scalar twin on every instruction set,
// whichever cells are evaluated together, and inside of the triangle.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "shading/coarse_cells_reference.h"
#include "tests/numerics/bounds.h"
#include "tests/raster/random_triangles.h"
#include "tests/raster/tile_harness.h"
#include "tests/shading/coarse_cells_lanes.h"

namespace tessera::test::coarse_cells_test {
using namespace detail;
namespace {

constexpr int kCellTile = 32;

/// Calls check(vertices, size, x, y, b1, b2, isa) for all cells of random triangles in a tile at (tile_x,
/// tile_y); x and y are the cell's first pixel in the window.
template <class Check>
void for_each_cell(std::uint32_t seed, int rounds, const Check& check) {
  RandomTriangles source(seed, kCellTile);
  for (int round = 0; round < rounds; ++round) {
    Triangle t = source.next();
    for (WindowVertex& v : t) v.rw = static_cast<float>(std::exp2(20 * source.unit() - 10));
    if (round % 4 == 0) t[1].rw = t[2].rw = t[0].rw;
    const WindowVertex vertices[3] = {t[0], t[1], t[2]};
    if (TriangleReference(vertices).area == 0) continue;
    for (const int size : {2, 4}) {
      const int side = kCellTile / size;
      std::vector<float> b1(static_cast<std::size_t>(side * side)), b2(b1.size());
      for (const InstructionSet isa : available_isas())
        for (const bool together : {false, true}) {
          if (!tile_cells(isa)(vertices, 0, 0, kCellTile, size, together, b1.data(), b2.data())) continue;
          for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
              const auto cell = static_cast<std::size_t>(row * side + column);
              check(vertices, size, column * size, row * size, b1[cell], b2[cell], isa);
              if (::testing::Test::HasFatalFailure()) return;
            }
        }
    }
  }
}

TEST(CoarseCells, MatchTheScalarTwin) {
  int of_rule[3] = {};
  for_each_cell(
      41, long_tests() ? 6000 : 300,
      [&](const WindowVertex(&v)[3], int size, int x, int y, float b1, float b2, InstructionSet isa) {
        const CellReference expected = cell_reference(v, size, x, y);
        ++of_rule[static_cast<int>(expected.rule)];
        ASSERT_EQ(std::bit_cast<std::uint32_t>(b1), std::bit_cast<std::uint32_t>(expected.at.b1))
            << name_of(isa) << ", cell of " << size << " at " << x << " " << y;
        ASSERT_EQ(std::bit_cast<std::uint32_t>(b2), std::bit_cast<std::uint32_t>(expected.at.b2))
            << name_of(isa) << ", cell of " << size << " at " << x << " " << y;
      });
  for (const int cells : of_rule) EXPECT_GT(cells, 1000);
}

// Weights are not negative and their sum is above 0, so coordinates are 0 to 1, wherever the cell is.
TEST(CoarseCells, AreLitInsideOfTheTriangle) {
  for_each_cell(42, long_tests() ? 6000 : 300,
                [](const WindowVertex(&)[3], int size, int x, int y, float b1, float b2, InstructionSet) {
                  ASSERT_TRUE(b1 >= 0 && b1 <= 1) << b1 << ", cell of " << size << " at " << x << " " << y;
                  ASSERT_TRUE(b2 >= 0 && b2 <= 1) << b2 << ", cell of " << size << " at " << x << " " << y;
                  ASSERT_LE(b1 + b2, 1 + 0x1p-22f);
                });
}

}  // namespace
}  // namespace tessera::test::coarse_cells_test
