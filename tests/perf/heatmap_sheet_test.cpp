// A heatmap next to its frame.
#include "perf/bench/heatmap_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace tessera::bench::heatmap_sheet_test {
namespace {

constexpr int kWidth = 40, kHeight = 30;

Picture filled(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  Picture picture(kWidth, kHeight);
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    const std::uint8_t rgba[] = {r, g, b, 255};
    std::copy_n(rgba, 4, &picture.rgba[i]);
  }
  return picture;
}

using Rgb = std::array<int, 3>;

Rgb pixel(const Picture& picture, int x, int y) {
  const std::uint8_t* const p = &picture.rgba[static_cast<std::size_t>(4 * (y * picture.width + x))];
  return {p[0], p[1], p[2]};
}

const Heatmap kMap{.picture = filled(255, 255, 0), .max_ns_per_pixel = 12};

TEST(BenchHeatmapSheet, ShowsFrameAndCostsSideBySide) {
  const Picture sheet = heatmap_sheet(kMap, filled(0, 0, 200), "made-up");
  constexpr int kTop = 20;
  for (const int y : {kTop, kTop + kHeight - 1}) {
    EXPECT_EQ(pixel(sheet, 8, y), (Rgb{0, 0, 200}));
    EXPECT_EQ(pixel(sheet, 8 + kWidth - 1, y), (Rgb{0, 0, 200}));
    EXPECT_EQ(pixel(sheet, 16 + kWidth, y), (Rgb{255, 255, 0}));
    EXPECT_EQ(pixel(sheet, 16 + 2 * kWidth - 1, y), (Rgb{255, 255, 0}));
  }
  EXPECT_EQ(pixel(sheet, 8 + kWidth, kTop), pixel(sheet, 0, 0)) << "background between the two";
}

TEST(BenchHeatmapSheet, HasAKeyFromBlackToWhiteWithText) {
  const Picture sheet = heatmap_sheet(kMap, filled(0, 0, 200), "made-up");
  const int key_y = 20 + kHeight + 8 + 2;
  EXPECT_EQ(pixel(sheet, 8, key_y)[1], 0);
  EXPECT_LT(pixel(sheet, 8, key_y)[0], 4) << "black: no cost";
  EXPECT_EQ(pixel(sheet, sheet.width / 3 + 4, key_y)[0], 255) << "red";
  EXPECT_EQ(pixel(sheet, 2 * sheet.width / 3, key_y)[1], 255) << "yellow";
  EXPECT_GT(pixel(sheet, sheet.width - 9, key_y)[2], 250) << "white: the most expensive tile";
  const auto has_text = [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < sheet.width; ++x)
        if (pixel(sheet, x, y) == Rgb{235, 235, 235}) return true;
    return false;
  };
  EXPECT_TRUE(has_text(8, 16)) << "name of the workload";
  EXPECT_TRUE(has_text(key_y + 10, key_y + 22)) << "costs";
  EXPECT_TRUE(has_text(key_y + 22, sheet.height)) << "unit";
  const Picture other =
      heatmap_sheet({.picture = kMap.picture, .max_ns_per_pixel = 34}, filled(0, 0, 200), "made-up");
  EXPECT_NE(sheet.rgba, other.rgba) << "the key has the cost of white";
}

}  // namespace
}  // namespace tessera::bench::heatmap_sheet_test
