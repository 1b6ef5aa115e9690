// Moving a triangle by whole pixels moves its coverage, depths and colours and changes nothing else, at any
// distance from the origin and for any position of tile borders.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/raster/depth_cases.h"
#include "tests/raster/tile_harness.h"

namespace tessera::test::translation_test {
namespace {

constexpr int kWindow = 64;  // width and height of the compared window, pixels

struct WindowPixels {
  std::vector<std::uint32_t> colors;
  std::vector<std::int32_t> depths;
  bool operator==(const WindowPixels&) const = default;
};

// Draws the triangle moved by the shift; returns the window whose first pixel is (shift_x, shift_y).
WindowPixels draw_moved(const DepthTriangle& t, const std::vector<float>& colors, DepthFormat kind,
                        InstructionSet isa, int tile_size, int shift_x, int shift_y) {
  TileHarness stage(shift_x + kWindow + 1, shift_y + kWindow + 1, tile_size, kind);
  Triangle moved = t.corners;
  for (WindowVertex& v : moved) v.x += shift_x * 256, v.y += shift_y * 256;
  TileDraw& draw = stage.add_draw(moved.data());
  draw.uses_depth = true;
  draw.depth_test = Compare::always;
  draw.source = ColorSource::interpolated;
  draw.attributes = colors.data();
  draw.attribute_stride = draw.attribute_count = 3;
  const TileGrid grid = stage.frame().grid;
  WindowPixels pixels;
  pixels.colors.resize(kWindow * kWindow);
  pixels.depths.resize(kWindow * kWindow);
  for (int tile_y = shift_y / tile_size; tile_y <= (shift_y + kWindow - 1) / tile_size; ++tile_y) {
    for (int tile_x = shift_x / tile_size; tile_x <= (shift_x + kWindow - 1) / tile_size; ++tile_x) {
      const int tile = tile_y * grid.columns() + tile_x;
      stage.push(tile, 0, 0);
      stage.render(isa, tile, 0xabcdef, 5);
      for (int y = 0; y < tile_size; ++y) {
        for (int x = 0; x < tile_size; ++x) {
          const int in_x = tile_x * tile_size + x - shift_x, in_y = tile_y * tile_size + y - shift_y;
          const bool in_window = in_x >= 0 && in_y >= 0 && in_x < kWindow && in_y < kWindow;
          if (!in_window) continue;
          pixels.colors[static_cast<std::size_t>(in_y * kWindow + in_x)] = stage.color(x, y);
          pixels.depths[static_cast<std::size_t>(in_y * kWindow + in_x)] = stage.depth(x, y);
        }
      }
    }
  }
  return pixels;
}

TEST(RasterTranslation, WholePixelMovesChangeNothing) {
  for (const DepthFormat kind : kDepthKinds) {
    RandomTriangles source(21, kWindow);
    for (int i = 0; i < (long_tests() ? 2000 : 100); ++i) {
      DepthTriangle t = with_random_depths(source, source.next());
      set_words(t, kind);
      if (reference_of(t.corners).area == 0) continue;
      if (i % 2 == 0)
        for (WindowVertex& v : t.corners) v.rw = static_cast<float>(std::exp2(20 * source.unit() - 10));
      std::vector<float> colors(9 + kAttributePadding);
      for (float& c : colors) c = 0.5f + 255 * static_cast<float>(source.unit());
      const InstructionSet isa = available_isas()[static_cast<std::size_t>(i) % available_isas().size()];
      const WindowPixels here = draw_moved(t, colors, kind, isa, 64, 0, 0);
      for (const int tile_size : {32, 64, 128}) {
        const int shift_x = source.between(0, 300), shift_y = source.between(0, 300);
        ASSERT_EQ(draw_moved(t, colors, kind, isa, tile_size, shift_x, shift_y), here)
            << name_of(kind) << " " << name_of(isa) << " " << shift_x << " " << shift_y << ": "
            << Describe{t.corners};
      }
      // To the far corner of the largest frame buffer.
      ASSERT_EQ(draw_moved(t, colors, kind, isa, 128, 16384 - kWindow - 1, source.between(0, 500)), here)
          << name_of(kind) << " " << name_of(isa) << ": " << Describe{t.corners};
      ASSERT_EQ(draw_moved(t, colors, kind, isa, 128, source.between(0, 500), 16384 - kWindow - 1), here)
          << name_of(kind) << " " << name_of(isa) << ": " << Describe{t.corners};
    }
  }
}

}  // namespace
}  // namespace tessera::test::translation_test
