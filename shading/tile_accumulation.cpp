#include "shading/tile_accumulation.h"

#include <algorithm>

namespace tessera::detail {
namespace {

/// The levels of the pixels from `index` on.
AccumulatedPixels levels_from(const AccumulatedPixels& levels, int index) {
  return {levels[0] + index, levels[1] + index, levels[2] + index, levels[3] + index};
}

void return_colors(const TileAccumulation& command, const PixelRect& rect, int tile_x, int tile_y,
                   int tile_size, std::uint32_t* color, const AccumulatedPixels& levels) {
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x) {
      const int at = tile_index(x, y, tile_size);
      const std::uint32_t packed =
          command.arithmetic.packed_color({levels[0][at], levels[1][at], levels[2][at], levels[3][at]},
                                          command.dither, tile_x + x, tile_y + y);
      color[at] = (color[at] & ~command.write_mask) | (packed & command.write_mask);
    }
}

}  // namespace

void accumulate_tile(const TileAccumulation& command, const PixelRect& rect, int tile_x, int tile_y,
                     int tile_size, std::uint32_t* color, const AccumulatedPixels& levels) {
  if (command.arithmetic.op() == AccumOp::return_color)
    return return_colors(command, rect, tile_x, tile_y, tile_size, color, levels);
  if (rect == PixelRect{0, 0, tile_size, tile_size})
    return command.arithmetic.run(color, levels, tile_size * tile_size);
  // Pixels of a row that lie in one block are adjacent.
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0, end = 0; x < rect.x1; x = end) {
      end = std::min(x / kBlockSize * kBlockSize + kBlockSize, rect.x1);
      const int at = tile_index(x, y, tile_size);
      command.arithmetic.run(color + at, levels_from(levels, at), end - x);
    }
}

}  // namespace tessera::detail
