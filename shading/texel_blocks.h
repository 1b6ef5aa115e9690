// Texels of a bitmap or an image at the pixels of a tile's blocks. Compiled once for all instruction sets:
// the operations on the fragments take longer.
#pragma once

#include <cstdint>

#include "framebuffer/tile_grid.h"
#include "raster/pixel_rectangle.h"

namespace tessera::detail {

/// The texels of a draw, and the pixels of a tile.
struct TexelTile {
  const PixelRectangle& texels;
  const TileGrid& grid;
  int tile_x, tile_y;  ///< the tile's corner, raster space
  PixelRect rect;      ///< where the draw may change pixels, tile-relative
};

/// The texel at each column and row of a tile, for one sample; kNoTexel outside the draw's rectangle.
struct TexelPlaces {
  std::int32_t column[kMaxTileSize], row[kMaxTileSize];

  void set_up(const TexelTile& tile, int samples, int sample);
  bool same_in_block(const TexelPlaces& other, int bx, int by) const;
  /// Pixels of a block with a texel, or with a bit of a bitmap that is set; 16 bits.
  std::uint32_t covered(const PixelRectangle& texels, int bx, int by) const;
  /// Writes the colors 0..1 of these pixels: r of the whole block, then g, b and a. @pre an image
  void fetch(const PixelRectangle& texels, int bx, int by, std::uint32_t bits, float* colors) const;
};

}  // namespace tessera::detail
