#include "draw_mesh.h"

#include "fragment_pipeline.h"
#include "named_stages.h"
#include "planar_shadow.h"
#include "primitive_shader.h"
#include "rasterize_mesh.h"

namespace tessera::reference {
namespace {

std::optional<TextureSampler> sampler(const Draw& draw, const Scene& scene) {
  if (!draw.texture) return std::nullopt;
  return TextureSampler(scene.textures.at(*draw.texture));
}

// The draw of the shadow: one colour, projected after the object's transform.
Draw shadow_of(const Draw& draw, const std::vector<Light>& lights) {
  Draw shadow = draw;
  const Mat4 projection = shadow_matrix(draw.shadow_on->plane, lights.at(draw.shadow_on->light)).value();
  shadow.world_from_object = multiply(projection, draw.world_from_object);
  shadow.lighting = false;
  shadow.texture = std::nullopt;
  shadow.material.diffuse = draw.shadow_on->color;
  return shadow;
}

}  // namespace

void draw_mesh(const Draw& draw, const FrameState& state, SampleBuffers& buffers) {
  Draw drawn = draw.shadow_on ? shadow_of(draw, state.lights) : draw;
  const bool has_stage_colors = makes_vertex_colors(draw);
  if (has_stage_colors && draw.lighting && draw.color_material == ColorMaterial::kNone)
    drawn.color_material = ColorMaterial::kAmbientAndDiffuse;
  const Mesh& mesh = state.scene.meshes.at(draw.mesh);
  const std::optional<TextureSampler> texture = sampler(drawn, state.scene);
  const DrawColors colors{drawn,
                          state.scene.light_model,
                          lights_in_eye_space(state.lights, state.camera.view_from_world),
                          buffers.format(),
                          texture ? &*texture : nullptr,
                          !draw.shadow_on && (!mesh.colors.empty() || has_stage_colors),
                          !draw.shadow_on && !mesh.color_indices.empty()};
  // Shader and pipeline of the current primitive.
  std::optional<PrimitiveShader> shader;
  std::optional<FragmentPipeline> pipeline;
  const auto start = [&](const DrawnPrimitive& primitive) {
    shader.emplace(primitive.corners, primitive.is_back, colors);
    pipeline.emplace(
        drawn, [&shader](const Fragment& fragment) { return shader->shade(fragment); },
        FragmentPipeline::Source{state.command, static_cast<std::int32_t>(primitive.number),
                                 primitive.is_back},
        buffers);
    return [&](const Fragment& fragment) {
      if (const auto staged = staged_fragment(drawn, buffers.format(), fragment)) pipeline->take(*staged);
    };
  };
  rasterize_mesh(mesh, drawn, state.camera, buffers.format(), start, state.sample_shift);
}

}  // namespace tessera::reference
