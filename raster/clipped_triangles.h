// Triangles that need clipping: to the near and far planes and to the guard band.
#pragma once

#include <cstdint>

#include "raster/binning.h"
#include "raster/window_polygon.h"

namespace tessera::detail {

/// Clip-space vertex with its attributes, before clipping.
ClipVertex clip_vertex(const BinDraw& draw, std::uint32_t vertex, int attribute_count);

/// Clips a triangle and projects the result. @param outcodes  bitwise or of the vertices' outcodes
WindowPolygon clip_to_window(const BinDraw& draw, std::uint32_t triangle, std::uint8_t outcodes,
                             int attribute_count);

/// Clips one triangle and bins the resulting triangles as derived primitives. Throws std::bad_alloc.
void bin_clipped_triangle(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t triangle,
                          std::uint8_t outcodes);

}  // namespace tessera::detail
