// Tiles and the blocks inside them: constants and pixel <-> tile arithmetic. Rows are counted from the top of
// the picture.
#pragma once

#include <cstdint>

namespace tessera::detail {

inline constexpr int kBlockSize = 4;  ///< pixels; a block is 4x4, stored in 16 consecutive words
inline constexpr int kBlockPixels = kBlockSize * kBlockSize;
inline constexpr int kMinTileSize = 32,
                     kMaxTileSize = 128;   ///< pixels; tiles are 32, 64 or 128 wide and high
inline constexpr int kTileAlignment = 64;  ///< bytes

/// Tile memory keeps blocks row by row and the pixels of a block row by row, so that one block is one or two
/// vectors.
constexpr int tile_index(int x, int y, int tile_size) {
  return ((y / kBlockSize) * (tile_size / kBlockSize) + x / kBlockSize) * kBlockPixels +
         (y % kBlockSize) * kBlockSize + x % kBlockSize;
}

struct TileGrid {
  int width_px = 0, height_px = 0;  ///< of the frame buffer
  int tile_size = 64;
  int columns() const { return (width_px + tile_size - 1) / tile_size; }
  int rows() const { return (height_px + tile_size - 1) / tile_size; }
  int count() const { return columns() * rows(); }
};

/// A rectangle of pixels in raster space (rows from the top): x0 <= x < x1, y0 <= y < y1.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
  friend constexpr bool operator==(const PixelRect&, const PixelRect&) = default;
};
constexpr PixelRect intersect(PixelRect a, PixelRect b) {
  return {a.x0 > b.x0 ? a.x0 : b.x0, a.y0 > b.y0 ? a.y0 : b.y0, a.x1 < b.x1 ? a.x1 : b.x1,
          a.y1 < b.y1 ? a.y1 : b.y1};
}

}  // namespace tessera::detail
