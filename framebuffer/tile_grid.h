// Tiles and their blocks: constants and the arithmetic between pixels and tiles. Rows are counted from the
// top of the picture.
#pragma once

#include <cstdint>

namespace tessera::detail {

inline constexpr int kBlockSize = 4;  ///< pixels; a block is 4x4 pixels, contiguous in tile memory
inline constexpr int kBlockPixels = kBlockSize * kBlockSize;
// Tiles are squares of 32, 64 or 128 pixels.
inline constexpr int kMinTileSize = 32;
inline constexpr int kMaxTileSize = 128;
inline constexpr int kTileAlignment = 64;  ///< bytes

/// Index of a pixel in tile memory: blocks row by row, the pixels of a block row by row. A block is one
/// AVX-512 vector or two AVX2 vectors.
constexpr int tile_index(int x, int y, int tile_size) {
  return ((y / kBlockSize) * (tile_size / kBlockSize) + x / kBlockSize) * kBlockPixels +
         (y % kBlockSize) * kBlockSize + x % kBlockSize;
}

struct TileGrid {
  int width_px = 0, height_px = 0;  ///< size of the frame buffer
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
