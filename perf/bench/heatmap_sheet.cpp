#include "perf/bench/heatmap_sheet.h"

#include <algorithm>
#include <cstring>

#include "engine/program/cli/bitmap_font.h"
#include "perf/bench/text.h"

namespace tessera::bench {
namespace {

constexpr int kMargin = 8;      // pixels around all parts
constexpr int kMinWidth = 400;  // room for the text of the key
constexpr std::uint8_t kBackground = 48;
constexpr std::array<std::uint8_t, 3> kTextColor{235, 235, 235};

void copy_into(const Picture& part, int x0, int y0, Picture& sheet) {
  for (int y = 0; y < part.height; ++y)
    std::memcpy(&sheet.rgba[4 * (static_cast<std::size_t>(y0 + y) * static_cast<std::size_t>(sheet.width) +
                                 static_cast<std::size_t>(x0))],
                &part.rgba[4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(part.width)],
                4 * static_cast<std::size_t>(part.width));
}

/// The colours of costs from 0 to the maximum, from left to right.
Picture color_bar(int width, int height) {
  Picture bar(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint8_t* const rgba = &bar.rgba[static_cast<std::size_t>(4 * (y * width + x))];
      paint_cost(rgba, (x + 0.5) / width);
      rgba[3] = 255;
    }
  return bar;
}

}  // namespace

Picture heatmap_sheet(const Heatmap& map, const Picture& frame, const std::string& workload) {
  using namespace program::cli;
  const TextStyle style{.scale = map.picture.width >= 640 ? 2 : 1, .color = kTextColor};
  const int line = (kGlyphHeight + 4) * style.scale;
  const int pictures_y = kMargin + line;
  const int key_y = pictures_y + map.picture.height + kMargin;
  const int map_x = frame.width + 2 * kMargin;
  Picture sheet(std::max(map_x + map.picture.width + kMargin, kMinWidth * style.scale),
                key_y + 3 * line + kMargin);
  std::fill(sheet.rgba.begin(), sheet.rgba.end(), kBackground);
  draw_text(workload, kMargin, kMargin, style, sheet);
  draw_text("cost of each tile", map_x, kMargin, style, sheet);
  copy_into(frame, kMargin, pictures_y, sheet);
  copy_into(map.picture, map_x, pictures_y, sheet);
  const int bar_width = sheet.width - 2 * kMargin;
  copy_into(color_bar(bar_width, line), kMargin, key_y, sheet);
  constexpr int kLabels = 4;  // a third apart: black, red, yellow, white
  for (int k = 0; k < kLabels; ++k) {
    const std::string label = formatted("%.2f", map.max_ns_per_pixel * k / (kLabels - 1));
    const int x = kMargin + (bar_width - text_width(label, style.scale)) * k / (kLabels - 1);
    draw_text(label, x, key_y + line + 2 * style.scale, style, sheet);
  }
  draw_text("nanoseconds of one thread per pixel of the tile", kMargin, key_y + 2 * line, style, sheet);
  return sheet;
}

}  // namespace tessera::bench
