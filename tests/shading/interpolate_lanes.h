// Barycentric coordinates of a triangle's pixels as the kernels compute them: one tile at a time.
#pragma once

#include "framebuffer/instruction_set.h"
#include "raster/fixed_point.h"

namespace tessera::test {

/// Fills b1 and b2, tile_size^2 each, in rows. False where the triangle has no pixel in the tile.
using TileBarycentrics = bool(const WindowVertex (&vertices)[3], int tile_x, int tile_y, int tile_size, float* b1, float* b2);
TileBarycentrics* tile_barycentrics(Isa isa);

}  // namespace tessera::test
