#include "raster/multi_tile_triangle.h"

#include <algorithm>
#include <cstdlib>

namespace tessera::detail {

void bin_multi_tile_triangle(Bins& bins, const TileGrid& grid, const WindowVertex* const (&v)[3], double area,
                             const BinDraw& draw, std::uint32_t id, int x0, int y0, int x1, int y1) {
  // Per edge, its maximum over the pixel centres (or samples) of a tile; the tile is outside if one is
  // negative. Values of 0 are left to the fill rule in the tile.
  const std::int64_t tile_side = std::int64_t{grid.tile_size} << kSubpixelBits;
  const std::int64_t reach = tile_side - kSubpixelScale;  // from the first to the last pixel centre
  std::int64_t row_value[3], step_x[3], step_y[3];
  for (int k = 0; k < 3; ++k) {
    const WindowVertex &p = *v[k], &q = *v[(k + 1) % 3];
    std::int64_t a = p.y - q.y, b = q.x - p.x;
    if (area < 0) {
      a = -a;
      b = -b;
    }
    row_value[k] = a * (x0 * tile_side + kHalfPixel - p.x) + b * (y0 * tile_side + kHalfPixel - p.y) +
                   std::max<std::int64_t>(a, 0) * reach + std::max<std::int64_t>(b, 0) * reach +
                   (std::abs(a) + std::abs(b)) * draw.sample_reach;
    step_x[k] = a * tile_side;
    step_y[k] = b * tile_side;
  }
  for (int ty = y0; ty <= y1; ++ty) {
    std::int64_t e0 = row_value[0], e1 = row_value[1], e2 = row_value[2];
    for (int tx = x0; tx <= x1; ++tx) {
      if ((e0 | e1 | e2) >= 0) bins.push(ty * grid.columns() + tx, draw.draw, id);
      e0 += step_x[0];
      e1 += step_x[1];
      e2 += step_x[2];
    }
    for (int k = 0; k < 3; ++k) row_value[k] += step_y[k];
  }
}

}  // namespace tessera::detail
