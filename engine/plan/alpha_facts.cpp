#include "engine/plan/alpha_facts.h"

#include "engine/plan/vertex_facts.h"
#include "shading/fragment_scalar.h"

namespace tessera::detail {
namespace {

bool replaces_diffuse(ColorMaterial mode) {
  return mode == ColorMaterial::diffuse || mode == ColorMaterial::ambient_and_diffuse;
}

/// Alpha of the material's faces, if they agree.
std::optional<EqualAlpha> material_alpha(const RecordedDraw& draw) {
  const DrawState& state = draw.state;
  const bool two_sided = state.lighting && draw.scene_state->light_model.two_sided;
  const float front = clamp_unit(state.material.diffuse.a);
  const bool differs =
      two_sided && state.back_material && clamp_unit(state.back_material->diffuse.a) != front;
  if (differs) return std::nullopt;
  return EqualAlpha{front, "material.diffuse"};
}

std::optional<EqualAlpha> untextured_alpha(const RecordedDraw& draw) {
  const MeshArrays& mesh = draw.mesh;
  if (mesh.vertices == 0 || !mesh.has_colors()) return material_alpha(draw);
  if (draw.state.lighting && !replaces_diffuse(draw.state.color_material)) return material_alpha(draw);
  const std::optional<float> alpha = equal_alpha(mesh);
  if (!alpha) return std::nullopt;
  return EqualAlpha{clamp_unit(*alpha), "mesh.colors"};
}

BlendFactor folded(BlendFactor factor, float alpha) {
  const bool is_alpha = factor == BlendFactor::src_alpha;
  const bool is_rest = factor == BlendFactor::one_minus_src_alpha;
  if (!is_alpha && !is_rest) return factor;
  if (alpha == (is_alpha ? 1.0f : 0.0f)) return BlendFactor::one;
  if (alpha == (is_alpha ? 0.0f : 1.0f)) return BlendFactor::zero;
  return factor;
}

}  // namespace

std::optional<EqualAlpha> equal_fragment_alpha(const RecordedDraw& draw) {
  if (draw.pixels) {
    const bool is_bitmap = draw.pixels->rectangle.channels == 0;
    if (!is_bitmap) return std::nullopt;
    return EqualAlpha{clamp_unit(draw.pixels->color.a), "bitmap.color"};
  }
  const bool texels_have_alpha = draw.texture != nullptr && draw.texture->has_alpha();
  if (texels_have_alpha && draw.state.texture_env != TextureEnv::decal) {
    if (!draw.texture->is_opaque) return std::nullopt;
    if (draw.state.texture_env == TextureEnv::replace) return EqualAlpha{1, "texture"};
  }
  return untextured_alpha(draw);
}

void fold_alpha(FragmentOps& ops, float alpha) {
  for (BlendFactor* const factor : {&ops.src_color, &ops.dst_color, &ops.src_alpha, &ops.dst_alpha})
    *factor = folded(*factor, alpha);
}

}  // namespace tessera::detail
