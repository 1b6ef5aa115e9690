// The field of the scene that decides about an effect of a draw.
#include "engine/plan/explain_text.h"

namespace tessera::detail {
namespace {

/// Field that turns an effect on or off.
std::string_view field_of(Effect effect) {
  switch (effect) {
    case Effect::draw: return "draw";
    case Effect::planar_shadow: return "shadow_on";
    case Effect::depth_test: return "depth.test";
    case Effect::depth_write: return "depth.write";
    case Effect::plane_masks: return "color_mask";
    case Effect::alpha_test: return "alpha_test";
    case Effect::stencil_test: return "stencil";
    case Effect::blending: return "blend";
    case Effect::dither: return "framebuffer.dither";
    case Effect::logic_op: return "logic_op";
    case Effect::alpha_planes: return "framebuffer.alpha_bits";
    case Effect::polygon_offset: return "polygon_offset";
    case Effect::polygon_mode: return "front_mode";
    case Effect::multisampling: return "framebuffer.samples";
    case Effect::bitmap: return "bitmap";
    case Effect::image: return "image";
    case Effect::texture: return "texture";
    case Effect::texture_coordinates: return "mesh.texcoords";
    case Effect::texture_lod: return "texture.min";
    case Effect::lighting: return "lighting";
    case Effect::two_sided_lighting: return "light_model.two_sided";
    case Effect::index_lighting: return "material.index_ramp";
    case Effect::vertex_colors: return "mesh.colors";
    case Effect::color_indices: return "mesh.color_indices";
    case Effect::generated_normals: return "mesh.normals";
    case Effect::shading: return "shading";
    case Effect::light: return ".position";
    case Effect::light_attenuation: return ".attenuation";
    case Effect::light_spot: return ".spot_cutoff";
    case Effect::light_highlight: return "material.specular";
    case Effect::light_ambient: return ".ambient";
    case Effect::light_tracked_colors: return "color_material";
    case Effect::renormalization: return "quality.renormalize";
    case Effect::interpolation: return "quality.interpolation";
    case Effect::texture_filter: return "quality.texture";
    case Effect::vertex_stage: return "vertex_stage";
    case Effect::fragment_stage: return "fragment_stage";
  }
  return "";
}

/// Field that decides, unless the note names it. That of a light begins with a dot.
std::string_view field_of(const EffectNote& note) {
  switch (note.reason) {
    case EffectReason::disabled:
      return note.effect == Effect::depth_test ? "depth.enabled" : field_of(note.effect);
    case EffectReason::no_depth_buffer: return "framebuffer.depth";
    case EffectReason::stores_indices:
    case EffectReason::rgb_buffer: return "framebuffer.color_mode";
    case EffectReason::no_color_stored: return "color_mask";
    case EffectReason::no_faces:
    case EffectReason::per_point: return "mesh.primitive";
    case EffectReason::per_2x2_pixels:
    case EffectReason::per_4x4_pixels: return "quality.shading";
    case EffectReason::draw_is_lit: return "lighting";
    case EffectReason::draw_has_color_indices: return "mesh.color_indices";
    case EffectReason::color_material_none: return "color_material";
    case EffectReason::material_has_index_ramp: return "material.index_ramp";
    case EffectReason::independent_of_surface: return "lights";
    case EffectReason::black: return ".diffuse";
    case EffectReason::constant_ambient: return ".ambient";
    case EffectReason::light_outside_cone: return ".spot_cutoff";
    case EffectReason::blinn_infinite_viewer:
    case EffectReason::blinn_local_viewer: return "light_model.local_viewer";
    case EffectReason::phong_infinite_viewer:
    case EffectReason::phong_local_viewer: return "light_model.specular";
    case EffectReason::equal_normals: return "mesh.normals";
    case EffectReason::replaced_by_stage: return "fragment_stage";
    case EffectReason::outside_view: return "mesh.positions";
    case EffectReason::never_read: return "clear";
    default: return field_of(note.effect);
  }
}

}  // namespace

std::string cause_of(const EffectNote& note) {
  const std::string_view field = note.cause.empty() ? field_of(note) : note.cause;
  if (note.light < 0) return std::string(field);
  // Fields of a light follow its number; those of the material and the light model do not need it.
  if (!field.starts_with('.')) return std::string(field);
  return "lights[" + std::to_string(note.light) + "]" + std::string(field);
}

}  // namespace tessera::detail
