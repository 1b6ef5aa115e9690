// Binning of triangles whose bounds span several tiles.
#pragma once

#include <cstdint>

#include "raster/binning.h"

namespace tessera::detail {

/// Bins one triangle, whose bounds span tiles [x0, x1] x [y0, y1], into the tiles that its edges do not
/// exclude.
void bin_multi_tile_triangle(Bins& bins, const TileGrid& grid, const WindowVertex* const (&v)[3], double area,
                             const BinDraw& draw, std::uint32_t id, int x0, int y0, int x1, int y1);

}  // namespace tessera::detail
