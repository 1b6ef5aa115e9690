// The blocks of a tile that see a bitmap's or an image's texels: which pixels, and their colours. Plain code,
// once for all instruction sets: what happens to the fragments then takes longer.
#pragma once

#include <cstdint>

#include "framebuffer/tile_grid.h"
#include "raster/pixel_rectangle.h"

namespace tessera::detail {

/// Where the texels of a draw meet the pixels of a tile.
struct TexelTile {
  const PixelRectangle& texels;
  const TileGrid& grid;
  int tile_x, tile_y;  ///< the tile's corner, raster space
  PixelRect rect;      ///< where the draw may change pixels, tile-relative
};

/// The texels that a tile's pixels see at one of their samples; kNoTexel outside of the draw's rectangle.
struct TexelPlaces {
  std::int32_t column[kMaxTileSize], row[kMaxTileSize];

  void set_up(const TexelTile& tile, int samples, int sample);
  bool same_in_block(const TexelPlaces& other, int bx, int by) const;
  /// The pixels of a block that see a texel, or a bit that is set; 16 bits.
  std::uint32_t covered(const PixelRectangle& texels, int bx, int by) const;
  /// The colours of these pixels, 0..1: r of the whole block, then g, b and a. @pre an image
  void fetch(const PixelRectangle& texels, int bx, int by, std::uint32_t bits, float* colors) const;
};

}  // namespace tessera::detail
