#include "engine/plan/color_plan.h"

#include <algorithm>
#include <optional>

#include <glm/mat4x4.hpp>

#include "engine/plan/eye_space.h"
#include "engine/plan/light_facts.h"
#include "engine/plan/light_threshold.h"
#include "engine/plan/vertex_facts.h"
#include "engine/record/matrix.h"
#include "engine/record/quality_caps.h"
#include "shading/fragment_scalar.h"
#include "shading/lighting_reference.h"

namespace tessera::detail {
namespace {

SurfaceMaterial surface(const Material& m) {
  return {rgb(m.ambient), rgb(m.diffuse), rgb(m.specular), rgb(m.emission), m.shininess};
}

ReflectedColors reflected_colors(const Material& m, const TrackedColors& tracked) {
  return {rgb(m.ambient), rgb(m.diffuse), rgb(m.specular), m.shininess, tracked};
}

/// Keeps only the lights that are below the threshold.
void forget_proofs(std::vector<LightReach>& reach) {
  for (LightReach& light : reach)
    if (light != LightReach::below_threshold) light = LightReach::unknown;
}

TrackedColors tracked_colors(ColorMaterial mode) {
  switch (mode) {
    case ColorMaterial::none: return {};
    case ColorMaterial::ambient_and_diffuse: return {.ambient = true, .diffuse = true};
    case ColorMaterial::diffuse: return {.diffuse = true};
    case ColorMaterial::ambient: return {.ambient = true};
    case ColorMaterial::emission: return {.emission = true};
    case ColorMaterial::specular: return {.specular = true};
  }
  return {};
}

const Material& back_material(const DrawState& state) {
  return state.back_material ? *state.back_material : state.material;
}

/// Notes colour inputs of the mesh and the materials that this draw ignores.
void note_unused_colors(const DrawPlan& plan, const RecordedDraw& draw, const ColorLayout& layout,
                        const EffectNotes& notes) {
  const DrawState& state = draw.state;
  const bool has_colors = draw.mesh.has_colors();
  if (draw.mesh.color_indices && !plan.uses_color_indices)
    notes.skipped(Effect::color_indices,
                  layout.takes_indices() ? EffectReason::draw_is_lit : EffectReason::rgb_buffer);
  if (has_colors && plan.uses_color_indices)
    notes.skipped(Effect::vertex_colors, EffectReason::draw_has_color_indices);
  if (!state.lighting) return;
  if (has_colors && state.color_material == ColorMaterial::none)
    notes.skipped(Effect::vertex_colors, EffectReason::color_material_none);
  if (has_colors && state.color_material != ColorMaterial::none && plan.only_indices())
    notes.skipped(Effect::vertex_colors, EffectReason::material_has_index_ramp);
  const bool has_index_ramp =
      state.material.index_ramp || (plan.two_sided && back_material(state).index_ramp);
  if (has_index_ramp && !layout.takes_indices())
    notes.skipped(Effect::index_lighting, EffectReason::rgb_buffer);
}

void plan_lights(DrawPlan& plan, const RecordedDraw& draw, const ColorLayout& layout,
                 const ColorOptions& options, const EffectNotes& notes) {
  const Quality& quality = draw.scene_state->quality;
  const LightModel& asked_model = draw.scene_state->light_model;
  const LightModel model = capped(asked_model, quality.viewer);
  const glm::dmat4 view = to_glm(draw.scene_state->camera.view);
  plan.lights.clear();
  for (const Light& light : draw.scene_state->lights) plan.lights.push_back(eye_light(light, view));
  // Proofs decide which lights are below the threshold, with and without `elide`: same picture.
  std::optional<ContributionBounds> bounds;
  const bool has_bounds = quality.light_threshold > 0 && plan.vertex_stage == nullptr;
  if (has_bounds) bounds.emplace(plan, draw, options.sampled, options.isa);
  if (options.elide || bounds) prove_light_reach(plan, draw, options.isa);
  const TrackedColors tracked =
      draw.mesh.has_colors() ? tracked_colors(draw.state.color_material) : TrackedColors{};
  const bool renormalizes = renormalizes_normals(draw);
  const bool interpolates_normals = draw.state.shading == Shading::phong;
  const LightingModel lighting{
      .scene_ambient = rgb(model.ambient),
      .local_viewer = model.local_viewer,
      .phong_highlight = model.specular == SpecularModel::phong,
      .unit_normals =
          renormalizes || (draw.state.normalize && !interpolates_normals && !draw.mesh.stage_makes_normals),
      .viewer_is_capped = model.local_viewer != asked_model.local_viewer};
  const auto set_program = [&](LightingProgram& program, const Material& material, int face,
                               const EffectNotes& face_notes) {
    if (bounds && !plan.is_index[face])
      leave_out_weak_lights(plan, face, reflected_colors(material, tracked), *bounds,
                            quality.light_threshold);
    if (bounds && !options.elide) forget_proofs(plan.light_reach[face]);
    if (plan.is_index[face]) {
      face_notes.active(Effect::index_lighting);
      program =
          plan_index_lighting({*material.index_ramp, material.shininess, layout.index_modulus()}, plan.lights,
                              lighting, face_notes, std::move(program.terms), plan.light_reach[face]);
    } else {
      program = plan_lighting(surface(material), tracked, plan.lights, lighting, face_notes,
                              std::move(program.terms), plan.light_reach[face]);
    }
    program.renormalize = renormalizes;
  };
  set_program(plan.front, draw.state.material, 0, notes);
  if (plan.two_sided) {
    notes.active(Effect::two_sided_lighting);
    set_program(plan.back, back_material(draw.state), 1, notes.for_back_faces());
    plan.back.negate_normal = true;
  }
  plan.uses_vertex_colors = tracked.any() && !plan.only_indices();
  plan.alpha[0] = clamp_unit(draw.state.material.diffuse.a);
  plan.alpha[1] = plan.two_sided ? clamp_unit(back_material(draw.state).diffuse.a) : plan.alpha[0];
  plan.vertex_alpha = tracked.diffuse && !plan.only_indices();
}

/// The index that a program without light terms yields.
float unlit_index(const LightingProgram& program) {
  return masked_index(std::min(program.indexes[0], program.indexes[2]), program.index_modulus);
}

/// No light depends on the surface, and both faces have the same colour.
bool has_constant_color(const DrawPlan& plan) {
  const bool color_varies = !plan.front.terms.empty() || plan.front.tracked;
  const bool alpha_varies = plan.float_colors && plan.vertex_alpha;
  if (color_varies || alpha_varies) return false;
  if (!plan.two_sided) return true;
  if (!plan.back.terms.empty() || plan.is_index[0] != plan.is_index[1]) return false;
  if (plan.only_indices()) return unlit_index(plan.back) == unlit_index(plan.front);
  return plan.back.base == plan.front.base && plan.alpha[0] == plan.alpha[1];
}

/// The one colour of a lit draw whose normals are all equal, under directional lights and an infinite viewer.
/// It has the bits of every pixel: interpolation keeps constants.
std::optional<Rgb> equal_lit_color(const DrawPlan& plan, const RecordedDraw& draw) {
  const LightingProgram& program = plan.front;
  if (draw.mesh.vertices == 0 || !draw.mesh.normals || plan.two_sided || plan.is_index[0])
    return std::nullopt;
  const bool alpha_varies = plan.float_colors && plan.vertex_alpha;
  if (program.needs_position || program.tracked || alpha_varies) return std::nullopt;
  if (!equal_normal(draw.mesh)) return std::nullopt;
  float normal[3][kVertexBatch];
  eye_normals(InstructionSet::scalar)(plan.eye, draw.mesh.normals, 1, normal[0], normal[1], normal[2]);
  return light_point_reference(program, {.normal = {normal[0][0], normal[1][0], normal[2][0]}});
}

/// The stored value depends on the value before, or on the position of the pixel, or it includes alpha; or
/// the fragment stage needs fragments.
bool prevents_deferral(const DrawPlan& plan, const ColorLayout& layout) {
  if (plan.fragment_stage && plan.stage_needs_fragments) return true;
  const bool reads_stored = plan.ops.blend || plan.ops.logic != LogicOp::copy;
  const bool stores_alpha = layout.alpha_bits > 0;
  return plan.has_ops && (reads_stored || plan.ops.dither || stores_alpha);
}

/// Alpha for the alpha test of a draw that stores no colour. Lighting takes alpha from the diffuse colour, so
/// no light is evaluated.
void plan_alpha(DrawPlan& plan, const RecordedDraw& draw) {
  const DrawState& state = draw.state;
  plan.vertex_alpha = plan.uses_vertex_colors =
      draw.mesh.has_colors() && (!state.lighting || tracked_colors(state.color_material).diffuse);
  plan.alpha[0] = clamp_unit(state.material.diffuse.a);
  plan.alpha[1] = state.lighting && draw.scene_state->light_model.two_sided
                      ? clamp_unit(back_material(state).diffuse.a)
                      : plan.alpha[0];
  plan.source = ColorSource::constant;
  if (!plan.vertex_alpha) return;
  plan.source = ColorSource::interpolated;
  plan.flat = state.shading == Shading::flat || plan.topology == Topology::points;
  plan.clamps_vertex_alpha = plan.flat || !state.lighting || state.shading != Shading::phong;
  plan.scaled_colors = false;
}

/// One colour for the draw. Texels are applied at the pixels; a texture of one colour is folded in here.
void set_constant_color(DrawPlan& plan, const Rgb& color, const ColorLayout& layout) {
  plan.constant_color = {clamp_unit(color[0]), clamp_unit(color[1]), clamp_unit(color[2])};
  if (plan.fragment_stage) {
    plan.scaled_colors = false;
    plan.deferred = !prevents_deferral(plan, layout);
  }
  if (plan.is_index[0] || plan.texture.use == TexturePlan::Use::none) return;
  if (plan.texture.use == TexturePlan::Use::texels) {
    plan.textures_per_pixel = true;
    plan.scaled_colors = false;
    plan.deferred = !prevents_deferral(plan, layout);
    return;
  }
  const auto [r, g, b, a] = texture_env_reference(
      plan.texture.texture,
      {plan.constant_color[0], plan.constant_color[1], plan.constant_color[2], plan.alpha[0]},
      plan.texture.texture.texel);
  plan.constant_color = {r, g, b};
  plan.alpha[0] = plan.alpha[1] = a;
}

/// Decides whether the texture is applied per pixel.
/// @param at_vertices  colours are computed at the vertices and interpolated, never extrapolated
void plan_texturing(DrawPlan& plan, bool at_vertices) {
  plan.textures_per_pixel =
      plan.texture.use != TexturePlan::Use::none && !(at_vertices && plan.texture.is_affine());
}

/// Plans a draw that stores no colour. Its alpha test may still need alpha.
void plan_unstored_color(DrawPlan& plan, const RecordedDraw& draw, const EffectNotes& notes) {
  plan.source = ColorSource::none;
  if (plan.ops.alpha_test) plan_alpha(plan, draw);
  plan_texturing(plan, false);
  notes.skipped(Effect::shading, EffectReason::no_color_stored);
}

/// The colour of a draw whose fragment stage replaces colours without reading them.
void plan_unread_color(DrawPlan& plan, const RecordedDraw& draw, const ColorLayout& layout,
                       const EffectNotes& notes) {
  plan.two_sided = false;
  plan.alpha[0] = plan.alpha[1] = clamp_unit(draw.state.material.diffuse.a);
  set_constant_color(plan, rgb(draw.state.material.diffuse), layout);
  notes.skipped(Effect::shading, EffectReason::replaced_by_stage);
}

/// The one colour of a draw, before texturing.
struct DrawColor {
  Rgb color;
  std::string_view cause;  ///< the field because of which there is only one
};

/// Plans what colours are computed from: colour indices, vertex colours, or materials and lights.
/// @return  the colour of the draw, if it has only one
std::optional<DrawColor> plan_color_inputs(DrawPlan& plan, const RecordedDraw& draw,
                                           const ColorLayout& layout, const ColorOptions& options,
                                           const EffectNotes& notes) {
  const DrawState& state = draw.state;
  note_unused_colors(plan, draw, layout, notes);
  if (state.lighting) {
    plan_lights(plan, draw, layout, options, notes);
    plan.lit = !has_constant_color(plan);
    if (plan.lit) {
      const std::optional<Rgb> color = options.elide ? equal_lit_color(plan, draw) : std::nullopt;
      plan.lit = !color;
      if (!color) return std::nullopt;
      notes.active(Effect::lighting, EffectReason::equal_normals);
      return DrawColor{*color, "mesh.normals"};
    }
    plan.two_sided = false;
    if (plan.is_index[0]) plan.constant_index = unlit_index(plan.front);
    notes.skipped(Effect::lighting, EffectReason::independent_of_surface);
    return DrawColor{plan.front.base, "lights"};
  }
  notes.skipped(Effect::lighting, EffectReason::disabled);
  if (plan.uses_color_indices) {
    notes.active(Effect::color_indices);
    return std::nullopt;
  }
  plan.uses_vertex_colors = plan.vertex_alpha = draw.mesh.has_colors();
  plan.alpha[0] = plan.alpha[1] = clamp_unit(state.material.diffuse.a);
  const auto equal = options.elide && plan.uses_vertex_colors && draw.mesh.vertices > 0
                         ? equal_color(draw.mesh)
                         : std::nullopt;
  if (equal) {
    plan.uses_vertex_colors = plan.vertex_alpha = false;
    plan.alpha[0] = plan.alpha[1] = clamp_unit((*equal)[3]);
    notes.active(Effect::vertex_colors, EffectReason::equal_colors);
    return DrawColor{{(*equal)[0], (*equal)[1], (*equal)[2]}, "mesh.colors"};
  }
  if (plan.uses_vertex_colors) {
    notes.active(Effect::vertex_colors);
    return std::nullopt;
  }
  notes.skipped(Effect::vertex_colors, EffectReason::not_in_mesh);
  return DrawColor{rgb(state.material.diffuse), "mesh.colors"};
}

/// Side of the cells of coarse shading, in pixels. 0: none; lines and outlines are lit at each pixel.
int cell_size(const DrawPlan& plan, ShadingCap cap) {
  const bool fills = plan.mode[0] == PolygonMode::fill || plan.mode[1] == PolygonMode::fill;
  if (plan.topology != Topology::triangles || !fills) return 0;
  if (cap == ShadingCap::phong_2x2) return 2;
  return cap == ShadingCap::phong_4x4 ? 4 : 0;
}

/// Dithers visible pixels in place of fragments: an ordered dither depends on colour and position alone.
void defer_dither(DrawPlan& plan) {
  if (!plan.can_defer_dither) return;
  plan.defers_dither = plan.unit_colors = true;
  plan.has_ops = plan.float_colors = false;
}

/// Phong shading: lighting at the pixels, or once per cell of pixels.
void plan_pixel_lighting(DrawPlan& plan, const RecordedDraw& draw, const ColorLayout& layout,
                         const EffectNotes& notes) {
  defer_dither(plan);
  plan.source = ColorSource::per_pixel;
  plan.deferred = !prevents_deferral(plan, layout);
  plan_texturing(plan, false);
  plan.cell_size = cell_size(plan, draw.scene_state->quality.shading);
  if (plan.cell_size > 0)
    notes.active(Effect::shading,
                 plan.cell_size == 2 ? EffectReason::per_2x2_pixels : EffectReason::per_4x4_pixels);
  else notes.active(Effect::shading, plan.deferred ? EffectReason::per_pixel : EffectReason::per_fragment);
  if (!renormalizes_normals(draw) && plan.needs_normal())
    notes.skipped(Effect::renormalization, EffectReason::disabled);
}

/// One colour per triangle, line or point.
void plan_flat_colors(DrawPlan& plan, std::string_view cause, const EffectNotes& notes) {
  // Packed colors cannot be textured: colours are kept as floats, as for fragment operations.
  if (plan.texture.use == TexturePlan::Use::texels)
    plan.has_ops = plan.float_colors = plan.textures_per_pixel = true;
  const bool by_triangle = plan.face_normals || plan.provoking_vertex_elsewhere;
  plan.source = by_triangle ? ColorSource::per_triangle_packed : ColorSource::per_vertex_packed;
  if (plan.float_colors) {
    plan.source = ColorSource::interpolated;
    plan.flat = true;
    plan.scaled_colors = false;
  }
  EffectReason rate = EffectReason::per_vertex;
  if (plan.topology == Topology::points) rate = EffectReason::per_point;
  else if (plan.face_normals) rate = EffectReason::per_face;
  else if (by_triangle) rate = EffectReason::per_provoking_vertex;
  notes.active(Effect::shading, rate, cause);
}

/// Colours of the vertices, interpolated.
void plan_interpolated_colors(DrawPlan& plan, const ColorLayout& layout, bool sampled, std::string_view cause,
                              const EffectNotes& notes) {
  defer_dither(plan);
  plan.source = ColorSource::interpolated;
  const bool inside_triangles = plan.topology == Topology::triangles && !sampled;
  plan_texturing(plan, inside_triangles && !plan.outlines);  // otherwise colours may be extrapolated
  // Greys and palette entries are not linear in the colour: they are evaluated per visible pixel. So is a
  // colour that the samples of a pixel share, unless it is merely stored.
  const bool is_linear = !layout.takes_indices() && !layout.luminance;
  const bool needs_floats = plan.float_colors || plan.unit_colors || plan.textures_per_pixel;
  plan.scaled_colors = is_linear && inside_triangles && !needs_floats;
  const bool merely_stored = !plan.has_ops && plan.write_mask == 0xffffffffu;
  const bool modifies_shared_color = sampled && !merely_stored;
  const bool is_carried = plan.textures_per_pixel || plan.unit_colors;
  const bool is_input = plan.fragment_stage.has_value();
  const bool shades_visible = !is_linear || is_carried || modifies_shared_color || is_input;
  plan.deferred = shades_visible && !prevents_deferral(plan, layout);
  notes.active(Effect::shading,
               plan.deferred ? EffectReason::interpolated_per_pixel : EffectReason::interpolated, cause);
}

void note_generated_normals(const DrawPlan& plan, const EffectNotes& notes) {
  if (plan.topology != Topology::triangles)
    return notes.skipped(Effect::generated_normals, EffectReason::no_faces);
  notes.active(Effect::generated_normals,
               plan.smooth_normals ? EffectReason::mean_normals : EffectReason::face_normals);
}

}  // namespace

void plan_faces(DrawPlan& plan, const RecordedDraw& draw, const ColorLayout& layout) {
  const DrawState& state = draw.state;
  if (!plan.needs_colors()) return;
  plan.two_sided = state.lighting && draw.scene_state->light_model.two_sided && plan.keep_back;
  if (!layout.takes_indices()) return;
  plan.uses_color_indices = !state.lighting && draw.mesh.color_indices;
  plan.is_index[0] = plan.uses_color_indices || (state.lighting && state.material.index_ramp);
  plan.is_index[1] = plan.two_sided ? back_material(state).index_ramp.has_value() : plan.is_index[0];
}

void plan_color(DrawPlan& plan, const RecordedDraw& draw, const ColorLayout& layout,
                const ColorOptions& options, const EffectNotes& notes) {
  if (!plan.needs_colors()) return plan_unstored_color(plan, draw, notes);
  if (plan.fragment_stage && !plan.fragment_stage->stage.reads.color)
    return plan_unread_color(plan, draw, layout, notes);
  if (const std::optional<DrawColor> one = plan_color_inputs(plan, draw, layout, options, notes)) {
    notes.add({.effect = Effect::shading, .reason = EffectReason::per_draw, .cause = one->cause});
    return set_constant_color(plan, one->color, layout);
  }
  const Shading shading = draw.state.shading;
  const bool generates_normals = plan.needs_normal() && !draw.mesh.has_normals();
  plan.face_normals = generates_normals && shading == Shading::flat && plan.topology == Topology::triangles;
  plan.smooth_normals = generates_normals && !plan.face_normals;
  const bool phong = shading == Shading::phong && plan.lit;
  const bool one_color_each = shading == Shading::flat || plan.topology == Topology::points;
  const std::string_view cause = draw.shading_is_capped ? "quality.shading" : "";
  if (one_color_each) plan_flat_colors(plan, cause, notes);
  else if (phong) plan_pixel_lighting(plan, draw, layout, notes);
  else plan_interpolated_colors(plan, layout, options.sampled, cause, notes);
  if (generates_normals) note_generated_normals(plan, notes);
}

}  // namespace tessera::detail
