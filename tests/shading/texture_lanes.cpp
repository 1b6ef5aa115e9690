#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/shading/texture_lanes.cpp"
#include "framebuffer/lanes.h"

#include "raster/coverage-inl.h"
#include "raster/triangle_setup-inl.h"
#include "shading/texture_coordinates-inl.h"
#include "shading/texture_env-inl.h"
#include "shading/texture_sampling-inl.h"
#include "tests/shading/texture_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

void sample_lanes(const TextureLevels& texture, ShadingBatch& batch, int count) {
  sample_texture_lanes(texture, batch, count);
}

void component_lanes(const std::uint16_t (&components)[16], float (&units)[16], std::uint32_t (&packed)[16]) {
  for (int i = 0; i < 16; i += kLanes) {
    alignas(64) std::int32_t lanes[kLanes];
    for (int l = 0; l < kLanes; ++l) lanes[l] = components[i + l];
    const Int component = hn::Load(kInt, lanes);
    hn::StoreU(unit_component(component), kFloat, units + i);
    hn::Store(pack_texels({in_both_halves(component), in_both_halves(component)}), kInt, lanes);
    for (int l = 0; l < kLanes; ++l) packed[i + l] = static_cast<std::uint32_t>(lanes[l]);
  }
}

void color_lanes(const DrawTexture& texture, float (&colors)[4][16], const float (&texels)[4][16]) {
  for (int i = 0; i < 16; i += kLanes) {
    Colors color, texel;
    for (int c = 0; c < 4; ++c) {
      color.c[c] = hn::LoadU(kFloat, colors[c] + i);
      texel.c[c] = hn::LoadU(kFloat, texels[c] + i);
    }
    color = texture_env_lanes(texture, color, texel);
    for (int c = 0; c < 4; ++c) hn::StoreU(color.c[c], kFloat, colors[c] + i);
  }
}

bool coordinate_lanes(const WindowVertex (&vertices)[3], const float* const (&attributes)[3],
                      const DrawTexture& texture, int tile_size, float* s, float* t, float* squared) {
  TriangleGroup g;
  g.count = 1;
  for (int i = 0; i < kGroupSize; ++i)
    for (int k = 0; k < 3; ++k) {
      g.x[k][i] = vertices[k].x;
      g.y[k][i] = vertices[k].y;
      g.z[k][i] = vertices[k].z;
      g.rw[k][i] = vertices[k].rw;
    }
  set_up_edges(g, 0, 0, {0, 0, tile_size, tile_size});
  set_up_weights(g);
  if (g.mask == 0) return false;
  const bool is_wide = g.needs_edges64[0] != 0;
  ShadedTriangle triangle;
  Edges64 wide;
  triangle.edges = tile_edges32(g, 0);
  if (is_wide && !tile_edges64(g, 0, 0, 0, tile_size, triangle.edges, wide)) return false;
  triangle.edges64_index = is_wide ? 0 : -1;
  triangle.affine = g.affine[0] != 0;
  for (int k = 0; k < 3; ++k) {
    triangle.scale[k] = is_wide ? g.unit_scale[k][0] : g.scale[k][0];
    triangle.shift[k] = g.shift[k][0];
    triangle.attributes[k] = attributes[k];
  }
  TextureCoordinates coordinates;
  coordinates.set_up(triangle, &wide, texture, false, 1);
  for (int by = 0; by < tile_size; by += 4)
    for (int bx = 0; bx < tile_size; bx += 4)
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
        coordinates.at(barycentric(triangle, &wide, bx, by, chunk), [&](int field, Float value) HWY_ATTR {
          alignas(64) float lanes[kLanes];
          hn::Store(value, kFloat, lanes);
          float* to = squared;
          if (field == kTextureS) to = s;
          else if (field == kTextureT) to = t;
          for (int l = 0; l < kLanes; ++l) {
            const int p = chunk * kLanes + l;
            to[(by + p / 4) * tile_size + bx + p % 4] = lanes[l];
          }
        });
  return true;
}

void level_lanes(const float* footprints, std::int32_t* levels, std::size_t count) {
  TextureLevels texture;
  texture.last = kMaxTextureLevels - 1;
  texture.blends_levels = true;
  for (std::size_t i = 0; i < count; i += static_cast<std::size_t>(kLanes))
    hn::StoreU(level_of_detail(texture, hn::LoadU(kFloat, footprints + i)), kInt, levels + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::test {
SampleTexture* sample_texture(InstructionSet isa) { return TESSERA_KERNEL(isa, sample_lanes); }
TexelComponents* texel_components(InstructionSet isa) { return TESSERA_KERNEL(isa, component_lanes); }
TextureColors* texture_colors(InstructionSet isa) { return TESSERA_KERNEL(isa, color_lanes); }
LevelsOfDetail* levels_of_detail(InstructionSet isa) { return TESSERA_KERNEL(isa, level_lanes); }
TileCoordinates* tile_coordinates(InstructionSet isa) { return TESSERA_KERNEL(isa, coordinate_lanes); }
}  // namespace tessera::test
#endif
