// Barycentric coordinates at which a triangle is lit in cells, as computed by the kernels.
#pragma once

#include "framebuffer/instruction_set.h"
#include "raster/fixed_point.h"

namespace tessera::test {
using namespace detail;

/// Fills b1 and b2 for all cells of a tile, row by row. Returns false if the triangle has no pixel in the
/// tile.
/// @param size      2 or 4, pixels
/// @param together  evaluates the cells of a block together; false: one by one
using TileCells = bool(const WindowVertex (&vertices)[3], int tile_x, int tile_y, int tile_size, int size,
                       bool together, float* b1, float* b2);
TileCells* tile_cells(InstructionSet isa);

}  // namespace tessera::test
