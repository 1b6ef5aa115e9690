// LineSteps on every instruction set against LineWalk, its twin in exact integers.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "raster/line_walk.h"
#include "tests/raster/line_steps_lanes.h"
#include "tests/raster/random_triangles.h"
#include "tests/raster/tile_harness.h"

namespace tessera::test::line_steps_test {
using namespace detail;
namespace {

using Pixels = std::vector<std::pair<int, int>>;

struct Cases {
  const char* name;
  int origin;     // range of the first ends, 1/256 pixel
  int reach;      // range of the second ends relative to the first, 1/256 pixel
  int grid;       // ends are multiples of it
  int max_width;  // pixels
  PixelRect window;
};
constexpr PixelRect kTile{0, 0, 64, 64}, kFarTile{16256, 16320, 16384, 16384};
constexpr int kFarthest = (1 << 24) - 1;
constexpr Cases kCases[] = {{"short", 20000, 3000, 1, 1, kTile},
                            {"on borders", 20000, 1024, 32, 1, kTile},
                            {"on centres", 20000, 5000, 128, 1, kTile},
                            {"wide", 20000, 5000, 1, 9, kTile},
                            {"wide on borders", 20000, 5000, 64, 200, kTile},
                            {"long", 4000000, 8000000, 1, 1, kTile},
                            {"longest", kFarthest, 2 * kFarthest, 1, 1, kFarTile},
                            {"widest", kFarthest, 2 * kFarthest, 1, 65536, kFarTile}};

void fill_lines(TriangleGroup& lines, const Cases& of, std::mt19937& bits) {
  const auto between = [&](int low, int high) {
    return low + static_cast<int>(bits() % (static_cast<unsigned>(high - low) + 1));
  };
  const auto within = [&](int v) { return std::clamp(v / of.grid * of.grid, -kFarthest, kFarthest); };
  for (int i = 0; i < kGroupSize; ++i) {
    // Every fourth line crosses the window: its second end is mirrored at a point of the window.
    const int middle_x = between(of.window.x0, of.window.x1) * kSubpixelScale;
    const int middle_y = between(of.window.y0, of.window.y1) * kSubpixelScale;
    lines.x[0][i] = within(between(-of.origin, of.origin));
    lines.y[0][i] = within(between(-of.origin, of.origin));
    const bool through = i % 4 == 0;
    lines.x[1][i] = within(through ? 2 * middle_x - lines.x[0][i] + between(-300, 300)
                                   : lines.x[0][i] + between(-of.reach, of.reach));
    lines.y[1][i] = within(through ? 2 * middle_y - lines.y[0][i] + between(-300, 300)
                                   : lines.y[0][i] + between(-of.reach, of.reach));
    if (i == 5) lines.x[1][i] = lines.x[0][i];
    if (i == 6) lines.y[1][i] = lines.y[0][i];
    if (i == 7) lines.x[1][i] = lines.x[0][i], lines.y[1][i] = lines.y[0][i];
    if (i == 9) lines.y[1][i] = within(lines.y[0][i] + std::abs(lines.x[1][i] - lines.x[0][i]));
  }
}

void expect_pixels_of_walk(const Cases& of, int width, const TriangleGroup& lines, InstructionSet isa,
                           std::size_t& pixel_count) {
  Pixels found[kGroupSize];
  pixels_of_lines(isa)(lines, width, of.window, found);
  for (int i = 0; i < kGroupSize; ++i) {
    const LinePoint a{lines.x[0][i], lines.y[0][i]}, b{lines.x[1][i], lines.y[1][i]};
    Pixels expected;
    LineWalk(a, b, width).for_each(of.window, [&](int x, int y) { expected.push_back({x, y}); });
    std::sort(expected.begin(), expected.end());
    std::sort(found[i].begin(), found[i].end());
    ASSERT_EQ(found[i], expected) << of.name << ", width " << width << ", " << name_of(isa) << ": " << a.x
                                  << " " << a.y << " to " << b.x << " " << b.y;
    pixel_count += expected.size();
  }
}

TEST(LineSteps, MatchLineWalk) {
  for (const Cases& of : kCases)
    for (const InstructionSet isa : available_isas()) {
      const int groups =
          (long_tests() ? 60000 : 600) / (of.max_width > 1 ? 20 : 1);  // wide lines: more pixels
      std::mt19937 bits(11);
      std::size_t pixel_count = 0;
      for (int n = 0; n < groups; ++n) {
        TriangleGroup lines;
        lines.count = kGroupSize;
        fill_lines(lines, of, bits);
        const int width = 1 + static_cast<int>(bits() % static_cast<unsigned>(of.max_width));
        expect_pixels_of_walk(of, width, lines, isa, pixel_count);
        if (HasFatalFailure()) return;
      }
      EXPECT_GT(pixel_count, static_cast<std::size_t>(groups))
          << of.name << ": too few lines meet the window";
    }
}

}  // namespace
}  // namespace tessera::test::line_steps_test
