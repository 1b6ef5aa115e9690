#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/shading/interpolate_lanes.cpp"
#include "framebuffer/lanes.h"

#include "raster/coverage-inl.h"
#include "raster/triangle_setup-inl.h"
#include "shading/interpolate-inl.h"
#include "tests/shading/interpolate_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

bool tile_barycentrics_lanes(const WindowVertex (&vertices)[3], int tile_x, int tile_y, int tile_size,
                             float* b1, float* b2) {
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
  ShadedTriangle t;
  Edges64 wide;
  t.edges = tile_edges32(g, 0);
  if (is_wide && !tile_edges64(g, 0, tile_x, tile_y, tile_size, t.edges, wide)) return false;
  t.edges64_index = is_wide ? 0 : -1;
  t.affine = g.affine[0] != 0;
  for (int k = 0; k < 3; ++k) {
    t.scale[k] = is_wide ? g.unit_scale[k][0] : g.scale[k][0];
    t.shift[k] = g.shift[k][0];
  }
  for (int by = 0; by < tile_size; by += 4) {
    for (int bx = 0; bx < tile_size; bx += 4) {
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
        const Barycentric at = barycentric(t, &wide, bx, by, chunk);
        alignas(64) float lanes1[kLanes], lanes2[kLanes];
        hn::Store(at.b1, kFloat, lanes1);
        hn::Store(at.b2, kFloat, lanes2);
        for (int l = 0; l < kLanes; ++l) {
          const int p = chunk * kLanes + l;
          const int pixel = (by + p / 4) * tile_size + bx + p % 4;
          b1[pixel] = lanes1[l];
          b2[pixel] = lanes2[l];
        }
      }
    }
  }
  return true;
}

void interpolate_values_lanes(const float (&at_vertices)[3], const float* b1, const float* b2,
                              std::size_t count, const test::InterpolatedValues& values) {
  alignas(64) float attributes[3][kAttributePadding] = {};
  ShadedTriangle t;
  for (int k = 0; k < 3; ++k) {
    attributes[k][0] = at_vertices[k];
    t.attributes[k] = attributes[k];
  }
  const Interpolant single = make_interpolant(t, 0);
  const Interpolant clamped = make_interpolant(t, 0, true);
  const InterpolantArrays arrays(t, 0, 1);
  InterpolantLanes lanes;
  lanes.set(single);
  ClampedInterpolantLanes clamped_lanes;
  clamped_lanes.set(clamped);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Barycentric at{hn::LoadU(kFloat, b1 + i), hn::LoadU(kFloat, b2 + i), splat(1.0f)};
    hn::StoreU(interpolate(at, single), kFloat, values.single + i);
    hn::StoreU(interpolate(at, lanes), kFloat, values.lanes + i);
    hn::StoreU(interpolate(at, arrays[0]), kFloat, values.arrays + i);
    hn::StoreU(interpolate_clamped(at, clamped), kFloat, values.clamped + i);
    hn::StoreU(interpolate_clamped(at, clamped_lanes), kFloat, values.clamped_lanes + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::test {
TileBarycentrics* tile_barycentrics(InstructionSet isa) {
  return TESSERA_KERNEL(isa, tile_barycentrics_lanes);
}
InterpolateValues* interpolate_values(InstructionSet isa) {
  return TESSERA_KERNEL(isa, interpolate_values_lanes);
}
}  // namespace tessera::test
#endif
