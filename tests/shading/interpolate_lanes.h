// Barycentric coordinates of a triangle's pixels as computed by the kernels, one tile at a time, and
// attributes interpolated with them.
#pragma once

#include <cstddef>

#include "framebuffer/instruction_set.h"
#include "raster/fixed_point.h"

namespace tessera::test {
using namespace detail;

/// Fills b1 and b2, tile_size^2 each, row by row. Returns false if the triangle has no pixel in the tile.
using TileBarycentrics = bool(const WindowVertex (&vertices)[3], int tile_x, int tile_y, int tile_size,
                              float* b1, float* b2);
TileBarycentrics* tile_barycentrics(InstructionSet isa);

/// One attribute at `count` points, a multiple of 16, by each interpolation kernel.
struct InterpolatedValues {
  float* single;         ///< Interpolant
  float* lanes;          ///< InterpolantLanes
  float* arrays;         ///< InterpolantArrays
  float* clamped;        ///< Interpolant, clamped to the range of the vertices
  float* clamped_lanes;  ///< ClampedInterpolantLanes
};
using InterpolateValues = void(const float (&at_vertices)[3], const float* b1, const float* b2,
                               std::size_t count, const InterpolatedValues& values);
InterpolateValues* interpolate_values(InstructionSet isa);

}  // namespace tessera::test
