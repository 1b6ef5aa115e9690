// Texels of a bitmap or an image at the pixels of a tile's blocks. Compiled once for all instruction sets:
// most of the time goes into the operations on the fragments.
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
  PixelRect rect;      ///< the draw's rectangle, tile-relative
};

/// The texel at each column and row of a tile, for one sample; kNoTexel outside the draw's rectangle.
struct TexelPlaces {
  std::int32_t column[kMaxTileSize], row[kMaxTileSize];

  void set_up(const TexelTile& tile, int samples, int sample);
  bool same_in_block(const TexelPlaces& other, int bx, int by) const;
  /// Covered pixels of a block, 16 bits: those with a texel of the image, or with a set bit of the bitmap.
  std::uint32_t covered(const PixelRectangle& texels, int bx, int by) const;
  /// Writes the colours 0..1 of a block: r of all pixels, then g, b and a.
  /// @pre `texels` are an image
  /// @param bits  covered(); the colours of other pixels are 0
  void fetch(const PixelRectangle& texels, int bx, int by, std::uint32_t bits, float* colors) const;
};

}  // namespace tessera::detail
