// An operation of the accumulation buffer on one tile.
#pragma once

#include <cstdint>

#include "framebuffer/accumulation.h"
#include "framebuffer/tile_grid.h"
#include "shading/fragment_ops.h"

namespace tessera::detail {

/// Runs before draw `before_draw` and after `after_clears` of the frame's clears.
struct TileAccumulation {
  std::uint32_t before_draw = 0, after_clears = 0;
  PixelRect rect;  ///< raster space
  Accumulation arithmetic;
  std::uint32_t write_mask = 0xffffffffu;  ///< return_color: bits of the packed colour that change
  const ColorDither* dither = nullptr;     ///< return_color; null: none
};

/// Runs the operation on the pixels of `rect`, tile-relative.
/// @param tile_x, tile_y  the tile's top left pixel, raster space
/// @param color, levels   packed colours and accumulated levels of the tile, in tile order
void accumulate_tile(const TileAccumulation& command, const PixelRect& rect, int tile_x, int tile_y,
                     int tile_size, std::uint32_t* color, const AccumulatedPixels& levels);

}  // namespace tessera::detail
