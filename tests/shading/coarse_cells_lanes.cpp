#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/shading/coarse_cells_lanes.cpp"
#include "framebuffer/lanes.h"

#include "raster/coverage-inl.h"
#include "raster/triangle_setup-inl.h"
#include "shading/coarse_cells-inl.h"
#include "tests/shading/coarse_cells_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Sets up the record that shading reads. Returns false if the triangle has no pixel in the tile.
bool set_up_shaded(const WindowVertex (&vertices)[3], int tile_x, int tile_y, int tile_size,
                   ShadedTriangle& t, Edges64& wide) {
  TriangleGroup g;
  g.count = 1;
  for (int i = 0; i < kGroupSize; ++i)
    for (int k = 0; k < 3; ++k) {
      g.x[k][i] = vertices[k].x;
      g.y[k][i] = vertices[k].y;
      g.z[k][i] = vertices[k].z;
      g.rw[k][i] = vertices[k].rw;
    }
  set_up_edges(g, tile_x, tile_y, {0, 0, tile_size, tile_size});
  set_up_weights(g);
  if (g.mask == 0) return false;
  const bool is_wide = g.needs_edges64[0] != 0;
  t.edges = tile_edges32(g, 0);
  if (is_wide && !tile_edges64(g, 0, tile_x, tile_y, tile_size, t.edges, wide)) return false;
  t.edges64_index = is_wide ? 0 : -1;
  t.affine = g.affine[0] != 0;
  for (int k = 0; k < 3; ++k) {
    t.scale[k] = is_wide ? g.unit_scale[k][0] : g.scale[k][0];
    t.shift[k] = g.shift[k][0];
  }
  return true;
}

bool tile_cells_lanes(const WindowVertex (&vertices)[3], int tile_x, int tile_y, int tile_size, int size,
                      bool together, float* b1, float* b2) {
  ShadedTriangle t;
  Edges64 wide;
  if (!set_up_shaded(vertices, tile_x, tile_y, tile_size, t, wide)) return false;
  const int cells = cells_per_block(size);
  for (int by = 0; by < tile_size; by += 4)
    for (int bx = 0; bx < tile_size; bx += 4)
      for (int cell = 0; cell < cells; ++cell) {
        const int first = cell / kLanes * kLanes;
        const std::uint32_t all = (1u << std::min(cells, kLanes)) - 1;
        const std::uint32_t wanted = together ? all : 1u << (cell - first);
        const Barycentric at = barycentric_of_cells(t, &wide, size, bx, by, first, wanted);
        alignas(64) float lanes1[kLanes], lanes2[kLanes];
        hn::Store(at.b1, kFloat, lanes1);
        hn::Store(at.b2, kFloat, lanes2);
        const int column = (bx + cell_columns(size)[cell]) / size, row = (by + cell_rows(size)[cell]) / size;
        b1[row * (tile_size / size) + column] = lanes1[cell - first];
        b2[row * (tile_size / size) + column] = lanes2[cell - first];
      }
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::test {
TileCells* tile_cells(InstructionSet isa) { return TESSERA_KERNEL(isa, tile_cells_lanes); }
}  // namespace tessera::test
#endif
