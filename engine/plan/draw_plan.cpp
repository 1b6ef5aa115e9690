#include "engine/plan/draw_plan.h"

#include <algorithm>
#include <cmath>

#include <glm/mat4x4.hpp>

#include "engine/plan/eye_space.h"
#include "engine/plan/fragment_plan.h"
#include "engine/plan/pixel_plan.h"
#include "engine/record/matrix.h"
#include "raster/fixed_point.h"
#include "shading/fragment_scalar.h"

namespace tessera::detail {
namespace {

Rgb rgb(const Color& c) { return {c.r, c.g, c.b}; }

SurfaceMaterial surface(const Material& m) {
  return {rgb(m.ambient), rgb(m.diffuse), rgb(m.specular), rgb(m.emission), m.shininess};
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

void plan_transform(DrawPlan& plan, const RecordedDraw& draw, const FrameBufferState& target) {
  const FrameBufferFormat& format = target.format;
  const Camera& camera = draw.scene_state->camera;
  const glm::dmat4 eye_from_object = to_glm(camera.view) * to_glm(draw.state.transform);
  const Matrix clip = from_glm(to_glm(camera.projection) * eye_from_object);
  std::copy(clip.m.begin(), clip.m.end(), plan.transform.clip_from_object);
  const bool phong = draw.state.shading == Shading::phong;
  plan.eye = eye_transform(eye_from_object, draw.state.normalize ? kUnitNormals
                                            : phong              ? kNormalizableNormals
                                                                 : kUnscaledNormals);
  plan.captured_eye =
      draw.state.normalize || phong ? plan.eye : eye_transform(eye_from_object, kNormalizableNormals);

  const Rect viewport = draw.state.viewport.value_or(Rect{0, 0, format.width, format.height});
  VertexTransform& t = plan.transform;
  t.half_width = viewport.width / 2.0;
  t.half_height = viewport.height / 2.0;
  t.guard_x = kGuardBandPixels / t.half_width;
  t.guard_y = kGuardBandPixels / t.half_height;
  t.set_error_bounds();
  t.center_x = kSubpixelScale * viewport.x + kHalfPixel * viewport.width;
  t.center_y = kSubpixelScale * (format.height - viewport.y) - kHalfPixel * viewport.height;
  t.reversed = camera.reversed;
  t.depth_near = draw.state.depth_near;
  t.depth_far = draw.state.depth_far;
  t.depth = target.depth_format;

  plan.rect = intersect({0, 0, format.width, format.height}, raster_rect(viewport, format.height));
}

const Material& back_material(const DrawState& state) {
  return state.back_material ? *state.back_material : state.material;
}

/// Two-sided lighting, and the faces whose colours are indices.
void plan_faces(DrawPlan& plan, const RecordedDraw& draw, const ColorLayout& layout) {
  const DrawState& state = draw.state;
  if (plan.write_mask == 0) return;
  plan.two_sided = state.lighting && draw.scene_state->light_model.two_sided && plan.keep_back;
  if (!layout.index) return;
  plan.uses_color_indices = !state.lighting && draw.mesh.color_indices;
  plan.is_index[0] = plan.uses_color_indices || (state.lighting && state.material.index_ramp);
  plan.is_index[1] = plan.two_sided ? back_material(state).index_ramp.has_value() : plan.is_index[0];
}

/// Notes colour inputs of the mesh and the materials that this draw ignores.
void note_unused_colors(const DrawPlan& plan, const RecordedDraw& draw, const ColorLayout& layout,
                        const EffectNotes& notes) {
  const DrawState& state = draw.state;
  const bool has_colors = draw.mesh.has_colors();
  if (draw.mesh.color_indices && !plan.uses_color_indices)
    notes.skipped(Effect::color_indices, layout.index ? EffectReason::draw_is_lit : EffectReason::rgb_buffer);
  if (has_colors && plan.uses_color_indices)
    notes.skipped(Effect::vertex_colors, EffectReason::draw_has_color_indices);
  if (!state.lighting) return;
  if (has_colors && state.color_material == ColorMaterial::none)
    notes.skipped(Effect::vertex_colors, EffectReason::color_material_none);
  if (has_colors && state.color_material != ColorMaterial::none && plan.only_indices())
    notes.skipped(Effect::vertex_colors, EffectReason::material_has_index_ramp);
  if (!layout.index && (state.material.index_ramp || (plan.two_sided && back_material(state).index_ramp)))
    notes.skipped(Effect::index_lighting, EffectReason::rgb_buffer);
}

void plan_lights(DrawPlan& plan, const RecordedDraw& draw, const ColorLayout& layout,
                 const EffectNotes& notes) {
  const LightModel& model = draw.scene_state->light_model;
  const glm::dmat4 view = to_glm(draw.scene_state->camera.view);
  plan.lights.clear();
  for (const Light& light : draw.scene_state->lights) plan.lights.push_back(eye_light(light, view));
  const TrackedColors tracked =
      draw.mesh.has_colors() ? tracked_colors(draw.state.color_material) : TrackedColors{};
  const bool unit_normals = draw.state.normalize || draw.state.shading == Shading::phong;
  const LightingModel lighting{rgb(model.ambient), model.local_viewer, model.specular == SpecularModel::phong,
                               unit_normals};
  const auto set_program = [&](LightingProgram& program, const Material& material, bool index,
                               const EffectNotes& face_notes) {
    if (index) face_notes.active(Effect::index_lighting);
    program = index ? plan_index_lighting({*material.index_ramp, material.shininess, layout.index_modulus()},
                                          plan.lights, lighting, face_notes, std::move(program.terms))
                    : plan_lighting(surface(material), tracked, plan.lights, lighting, face_notes,
                                    std::move(program.terms));
  };
  set_program(plan.front, draw.state.material, plan.is_index[0], notes);
  if (plan.two_sided) {
    notes.active(Effect::two_sided_lighting);
    set_program(plan.back, back_material(draw.state), plan.is_index[1], notes.for_back_faces());
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
  if (!plan.front.terms.empty() || plan.front.tracked || (plan.float_colors && plan.vertex_alpha))
    return false;
  if (!plan.two_sided) return true;
  if (!plan.back.terms.empty() || plan.is_index[0] != plan.is_index[1]) return false;
  return plan.only_indices() ? unlit_index(plan.back) == unlit_index(plan.front)
                             : plan.back.base == plan.front.base && plan.alpha[0] == plan.alpha[1];
}

/// The stored value depends on the value before, or on the position of the pixel.
bool prevents_deferral(const DrawPlan& plan, const ColorLayout& layout) {
  return plan.has_ops &&
         (plan.ops.blend || plan.ops.dither || plan.ops.logic != LogicOp::copy || layout.alpha_bits > 0);
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
/// @param at_vertices  colours are computed at the vertices, and interpolated without extrapolation
void plan_texturing(DrawPlan& plan, bool at_vertices) {
  plan.textures_per_pixel =
      plan.texture.use != TexturePlan::Use::none && !(at_vertices && plan.texture.is_affine());
}

void plan_color(DrawPlan& plan, const RecordedDraw& draw, const ColorLayout& layout, bool sampled,
                const EffectNotes& notes) {
  const DrawState& state = draw.state;
  if (plan.write_mask == 0) {
    plan.source = ColorSource::none;
    if (plan.ops.alpha_test) plan_alpha(plan, draw);
    plan_texturing(plan, false);
    notes.skipped(Effect::shading, EffectReason::no_color_stored);
    return;
  }
  note_unused_colors(plan, draw, layout, notes);
  if (!state.lighting) notes.skipped(Effect::lighting, EffectReason::disabled);
  if (plan.uses_color_indices) {
    notes.active(Effect::color_indices);
  } else if (!state.lighting) {
    plan.uses_vertex_colors = plan.vertex_alpha = draw.mesh.has_colors();
    plan.alpha[0] = plan.alpha[1] = clamp_unit(state.material.diffuse.a);
    if (!plan.uses_vertex_colors) {
      notes.skipped(Effect::vertex_colors, EffectReason::not_in_mesh);
      notes.active(Effect::shading, EffectReason::per_draw);
      set_constant_color(plan, rgb(state.material.diffuse), layout);
      return;
    }
    notes.active(Effect::vertex_colors);
  } else {
    plan_lights(plan, draw, layout, notes);
    if (has_constant_color(plan)) {
      plan.two_sided = false;
      if (plan.is_index[0]) plan.constant_index = unlit_index(plan.front);
      notes.skipped(Effect::lighting, EffectReason::independent_of_surface);
      notes.active(Effect::shading, EffectReason::per_draw);
      set_constant_color(plan, plan.front.base, layout);
      return;
    }
    plan.lit = true;
  }
  const bool generate = plan.needs_normal() && !draw.mesh.normals;
  const bool has_faces = plan.topology == Topology::triangles;
  const bool phong = state.shading == Shading::phong && plan.lit;
  if (phong)
    for (LightingProgram* program : {&plan.front, &plan.back}) program->renormalize = true;
  if (phong && plan.topology != Topology::points) {
    plan.source = ColorSource::per_pixel;
    plan.deferred = !prevents_deferral(plan, layout);
    plan_texturing(plan, false);
    plan.smooth_normals = generate;
    notes.active(Effect::shading, plan.deferred ? EffectReason::per_pixel : EffectReason::per_fragment);
  } else if (state.shading == Shading::flat || plan.topology == Topology::points) {  // points have one colour
    plan.face_normals = generate && has_faces;
    plan.smooth_normals = generate && !has_faces;
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
    notes.active(Effect::shading, rate);
  } else {
    plan.source = ColorSource::interpolated;
    plan.smooth_normals = generate;
    plan_texturing(plan, has_faces && !sampled && !plan.outlines);  // otherwise colours may be extrapolated
    plan.scaled_colors = !layout.index && !layout.luminance && !plan.float_colors && !sampled && has_faces &&
                         !plan.textures_per_pixel;
    // Greys and palette entries are not linear in the colour: evaluate them per visible pixel. The same
    // applies if samples share a colour that is not merely stored.
    const bool shades_visible = layout.index || layout.luminance || plan.textures_per_pixel ||
                                (sampled && (plan.has_ops || plan.write_mask != 0xffffffffu));
    plan.deferred = shades_visible && !prevents_deferral(plan, layout);
    notes.active(Effect::shading,
                 plan.deferred ? EffectReason::interpolated_per_pixel : EffectReason::interpolated);
  }
  if (!generate) return;
  if (!has_faces) notes.skipped(Effect::generated_normals, EffectReason::no_faces);
  else
    notes.active(Effect::generated_normals,
                 plan.smooth_normals ? EffectReason::mean_normals : EffectReason::face_normals);
}

void note_depth(const DrawPlan& plan, const DrawState& state, const FrameBufferState& target,
                const EffectNotes& notes) {
  if (target.depth_format == DepthFormat::none)
    return notes.skipped(Effect::depth_test, EffectReason::no_depth_buffer);
  if (!state.depth.enabled) return notes.skipped(Effect::depth_test, EffectReason::disabled);
  if (!plan.uses_depth) return notes.skipped(Effect::depth_test, EffectReason::passes_and_writes_nothing);
  notes.active(Effect::depth_test);
  if (plan.depth_write) notes.active(Effect::depth_write);
  else notes.skipped(Effect::depth_write, EffectReason::disabled);
}

// Topology, culling, polygon modes and sizes.
void plan_elements(DrawPlan& plan, const RecordedDraw& draw) {
  const DrawState& state = draw.state;
  plan.topology = draw.mesh.topology();
  const bool has_faces = plan.topology == Topology::triangles;
  plan.point_size = state.point_size;
  plan.line_width = state.line_width;
  plan.keep_front =
      state.cull != Cull::front || !has_faces;  // points and lines are front-facing and never culled
  plan.keep_back = state.cull != Cull::back && has_faces;
  const PolygonMode modes[2] = {plan.keep_front ? state.front_mode : state.back_mode,
                                plan.keep_back ? state.back_mode : state.front_mode};
  for (int face = 0; face < 2 && has_faces; ++face) {
    plan.mode[face] = modes[face];
    plan.outlines |= modes[face] != PolygonMode::fill;
  }
  plan.front_is_clockwise = state.front_face == FrontFace::cw;
  plan.provoking_vertex_elsewhere =
      state.shading == Shading::flat && provoking_place(draw.mesh.primitive, state.provoking_vertex) < 0;
}

}  // namespace

PixelRect raster_rect(const Rect& rect, int frame_height) {
  // In 64 bits: x and y may be any int.
  const auto clamp = [](std::int64_t v) {
    return static_cast<int>(std::clamp<std::int64_t>(v, -(1 << 28), 1 << 28));
  };
  const std::int64_t top = std::int64_t{frame_height} - rect.y - rect.height;
  return {clamp(rect.x), clamp(top), clamp(std::int64_t{rect.x} + rect.width), clamp(top + rect.height)};
}

std::uint32_t write_mask(const std::array<bool, 4>& color_mask, std::uint32_t plane_mask,
                         const ColorLayout& layout) {
  std::uint32_t mask = 0;
  if (layout.index || layout.luminance) {
    mask = color_mask[0] ? layout.value_mask() : 0;
  } else {
    mask = (color_mask[0] ? layout.r_mask() : 0) | (color_mask[1] ? layout.g_mask() : 0) |
           (color_mask[2] ? layout.b_mask() : 0);
  }
  if (color_mask[3]) mask |= layout.alpha_mask();
  mask &= plane_mask;
  if (mask == 0) return 0;
  // Bits above the planes do not exist; a mask of all 32 bits saves reading the stored word.
  return mask == (layout.value_mask() | layout.alpha_mask()) ? 0xffffffffu : mask;
}

void DrawPlan::reset() {
  DrawPlan plan;
  plan.lights.swap(lights);
  plan.front.terms.swap(front.terms);
  plan.back.terms.swap(back.terms);
  plan.lights.clear();
  plan.front.terms.clear();
  plan.back.terms.clear();
  *this = std::move(plan);
}

void plan_draw(DrawPlan& plan, const RecordedDraw& draw, const FrameBufferState& target, bool capture_normals,
               const EffectNotes& notes) {
  const DrawState& state = draw.state;
  plan.reset();
  plan.write_mask = write_mask(state.color_mask, state.plane_mask, target.layout);
  if (draw.pixels) {
    plan_pixel_places(plan, *draw.pixels, target);
  } else {
    plan_transform(plan, draw, target);
    plan_elements(plan, draw);
    plan_faces(plan, draw, target.layout);
    if (state.shadow_on) notes.active(Effect::planar_shadow);
  }
  if (state.scissor) plan.rect = intersect(plan.rect, raster_rect(*state.scissor, target.format.height));

  const bool has_depth = state.depth.enabled && target.depth_format != DepthFormat::none;
  plan.depth_test = state.depth.test;
  plan.depth_write = state.depth.write;
  plan.uses_depth = has_depth && !(state.depth.test == Compare::always && !state.depth.write);
  note_depth(plan, state, target, notes);
  if (plan.write_mask != 0 && plan.write_mask != 0xffffffffu) notes.active(Effect::plane_masks);
  const FragmentPlan fragments =
      plan_fragments(state, target, plan.write_mask != 0, plan.only_indices(), notes);
  plan.ops = fragments.ops;
  plan.uses_stencil = fragments.uses_stencil;
  if (plan.uses_depth && plan.topology == Topology::triangles) {
    plan.offset_factor = state.polygon_offset.factor;
    plan.offset_units = state.polygon_offset.units;
  }
  if (plan.has_offset()) notes.active(Effect::polygon_offset);
  if (plan.outlines) notes.active(Effect::polygon_mode);
  plan.has_ops = fragments.needed || plan.has_offset() || plan.outlines;
  plan.float_colors =
      plan.has_ops && (!fragments.is_stencil_only || plan.has_offset() || plan.outlines || draw.pixels ||
                       plan.topology != Topology::triangles || target.format.samples > 1);
  if (target.format.samples > 1)
    notes.add({.effect = Effect::multisampling, .samples = target.format.samples});
  if (draw.pixels) {
    plan_pixel_colors(plan, *draw.pixels, notes);
  } else {
    const bool stores_colors = plan.write_mask != 0 && !plan.only_indices();
    plan.texture =
        plan_texture(draw,
                     {stores_colors, plan.ops.alpha_test ||
                                         (stores_colors && (plan.ops.blend || target.layout.alpha_bits > 0))},
                     notes);
    plan.float_colors |= plan.has_ops && plan.texture.use == TexturePlan::Use::texels;
    plan_color(plan, draw, target.layout, target.format.samples > 1, notes);
  }
  if (plan.texture.use == TexturePlan::Use::one_color)
    notes.active(Effect::texture,
                 plan.textures_per_pixel ? EffectReason::one_color_per_pixel : EffectReason::folded);
  plan.varyings = varying_layout(plan, capture_normals);
  if (plan.varyings.texcoord >= 0) plan.texture.texture.attribute = plan.varyings.texcoord;
  const bool writes_depth = plan.uses_depth && plan.depth_write;
  const bool writes_stencil = plan.uses_stencil && (plan.ops.faces[0].writes() || plan.ops.faces[1].writes());
  const bool never_seen = (has_depth && state.depth.test == Compare::never) ||
                          (plan.ops.alpha_test && plan.ops.alpha_func == Compare::never);
  plan.is_noop =
      plan.rect.empty() || (!writes_stencil && (never_seen || (plan.write_mask == 0 && !writes_depth)));
  if (plan.is_noop) notes.skipped(Effect::draw, EffectReason::no_pixel_can_change);
}

}  // namespace tessera::detail
