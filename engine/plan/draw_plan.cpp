#include "engine/plan/draw_plan.h"

#include <algorithm>

#include <glm/mat4x4.hpp>

#include "engine/plan/alpha_facts.h"
#include "engine/plan/color_plan.h"
#include "engine/plan/eye_space.h"
#include "engine/plan/fragment_plan.h"
#include "engine/plan/pixel_plan.h"
#include "engine/plan/vertex_facts.h"
#include "engine/plan/view_facts.h"
#include "engine/record/matrix.h"
#include "raster/fixed_point.h"
#include "shading/fragment_scalar.h"

namespace tessera::detail {
namespace {

NormalLengths normal_lengths(const RecordedDraw& draw) {
  if (draw.state.normalize) return kUnitNormals;
  return renormalizes_normals(draw) ? kNormalizableNormals : kUnscaledNormals;
}

void plan_transform(DrawPlan& plan, const RecordedDraw& draw, const FrameBufferState& target) {
  const FrameBufferFormat& format = target.format;
  const Camera& camera = draw.scene_state->camera;
  const glm::dmat4 eye_from_object = to_glm(camera.view) * to_glm(draw.state.transform);
  const Matrix clip = from_glm(to_glm(camera.projection) * eye_from_object);
  std::copy(clip.m.begin(), clip.m.end(), plan.transform.clip_from_object);
  plan.eye = eye_transform(eye_from_object, normal_lengths(draw));
  const bool has_normalizable_normals = draw.state.normalize || renormalizes_normals(draw);
  plan.captured_eye =
      has_normalizable_normals ? plan.eye : eye_transform(eye_from_object, kNormalizableNormals);

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

void plan_depth(DrawPlan& plan, const DrawState& state, const FrameBufferState& target) {
  plan.depth_test = state.depth.test;
  plan.depth_write = state.depth.write;
  const bool has_depth = state.depth.enabled && target.depth_format != DepthFormat::none;
  const bool has_effect = state.depth.test != Compare::always || state.depth.write;
  plan.uses_depth = has_depth && has_effect;
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

/// Plans topology, culling, polygon modes and sizes.
void plan_elements(DrawPlan& plan, const RecordedDraw& draw) {
  const DrawState& state = draw.state;
  plan.topology = draw.mesh.topology();
  const bool has_faces = plan.topology == Topology::triangles;
  plan.affine = draw.scene_state->quality.interpolation == InterpolationCap::affine;
  plan.point_size = state.point_size;
  plan.line_width = state.line_width;
  // Points and lines are front-facing and never culled.
  plan.keep_front = state.cull != Cull::front || !has_faces;
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

/// Takes over the user stages of a draw.
void plan_stages(DrawPlan& plan, const RecordedDraw& draw) {
  const DrawState& state = draw.state;
  if (state.vertex_stage) plan.vertex_stage = &*state.vertex_stage;
  if (!state.fragment_stage) return;
  const FragmentStage& stage = *state.fragment_stage;
  const bool tests_alpha = state.alpha_test && state.alpha_test->func != Compare::always;
  const bool has_effect_on_tests = stage.discards || stage.writes_depth || tests_alpha;
  if (plan.write_mask == 0 && !has_effect_on_tests) return;
  plan.fragment_stage = TileFragmentStage{.stage = stage, .runs_before_tests = has_effect_on_tests};
}

/// Sets the inputs of the stages, and notes the stages. @pre the layout of the varyings is known
void finish_stages(DrawPlan& plan, const RecordedDraw& draw, const EffectNotes& notes) {
  if (plan.vertex_stage != nullptr)
    notes.add({.effect = Effect::vertex_stage,
               .reason = EffectReason::each_vertex,
               .name = plan.vertex_stage->name});
  if (!draw.state.fragment_stage) return;
  const std::string_view name = draw.state.fragment_stage->name;
  EffectNote note{.effect = Effect::fragment_stage, .name = name};
  if (!plan.fragment_stage) {
    note.active = false;
    note.reason = EffectReason::no_color_stored;
    return notes.add(note);
  }
  plan.fragment_stage->eye = plan.varyings.stage_eye;
  plan.fragment_stage->normal = plan.varyings.stage_normal;
  plan.fragment_stage->extras = plan.varyings.stage_extras;
  note.reason = plan.fragment_stage->runs_before_tests ? EffectReason::before_tests
                : plan.deferred                        ? EffectReason::per_pixel
                                                       : EffectReason::per_fragment;
  notes.add(note);
}

/// Plans the fragment operations and the polygon offset.
/// @param alpha  alpha of all fragments, if it is known
void plan_operations(DrawPlan& plan, const RecordedDraw& draw, const FrameBufferState& target,
                     const std::optional<EqualAlpha>& alpha, const EffectNotes& notes) {
  const DrawState& state = draw.state;
  if (plan.write_mask != 0 && plan.write_mask != 0xffffffffu) notes.active(Effect::plane_masks);
  const FragmentPlan fragments =
      plan_fragments(state, target, plan.write_mask != 0, plan.only_indices(), alpha, notes);
  plan.ops = fragments.ops;
  plan.uses_stencil = fragments.uses_stencil;
  if (plan.uses_depth && plan.topology == Topology::triangles) {
    plan.offset_factor = state.polygon_offset.factor;
    plan.offset_units = state.polygon_offset.units;
  }
  if (plan.has_offset()) notes.active(Effect::polygon_offset);
  if (plan.outlines) notes.active(Effect::polygon_mode);
  const bool has_other_ops = fragments.needed || plan.has_offset() || plan.outlines;
  plan.has_only_stage = plan.fragment_stage && !has_other_ops;
  plan.has_ops = has_other_ops || plan.fragment_stage.has_value();
  const bool has_samples = target.format.samples > 1;
  const bool fills_triangles = plan.topology == Topology::triangles && !plan.outlines && !draw.pixels;
  const bool only_tests_stencil =
      fragments.is_stencil_only && !fragments.is_elided && !plan.has_offset() && !plan.fragment_stage;
  plan.float_colors = plan.has_ops && !(only_tests_stencil && fills_triangles && !has_samples);
  plan.unit_colors = fragments.is_elided && !plan.float_colors;
  plan.can_defer_dither =
      fragments.only_dithers && fills_triangles && !has_samples && !plan.has_offset() && !plan.fragment_stage;
  if (plan.fragment_stage) {
    const TileFragmentStage& stage = *plan.fragment_stage;
    plan.stage_needs_fragments = stage.runs_before_tests || (has_samples && stage.stage.reads.depth);
  }
  if (has_samples) notes.add({.effect = Effect::multisampling, .samples = target.format.samples});
}

/// Plans the texture and the colours of a mesh.
void plan_shading(DrawPlan& plan, const RecordedDraw& draw, const FrameBufferState& target,
                  const PlanOptions& options, const EffectNotes& notes) {
  const bool stores_colors = plan.needs_colors() && !plan.only_indices();
  const bool blends_or_stores_alpha = stores_colors && (plan.ops.blend || target.layout.alpha_bits > 0);
  const bool is_read = plan.fragment_stage && plan.fragment_stage->stage.reads.color;
  const bool needs_alpha = plan.ops.alpha_test || blends_or_stores_alpha || is_read;
  if (!plan.fragment_stage || is_read)
    plan.texture = plan_texture(draw, {.colors = stores_colors, .alpha = needs_alpha}, notes);
  plan.float_colors |= plan.has_ops && plan.texture.use == TexturePlan::Use::texels;
  plan_color(plan, draw, target.layout,
             {.sampled = target.format.samples > 1, .elide = options.elide, .isa = options.isa}, notes);
}

/// An alpha that is the same at all vertices is not interpolated for the fragment stage: interpolation keeps
/// a constant exactly.
void fold_stage_alpha(DrawPlan& plan, const MeshArrays& mesh) {
  if (!plan.fragment_stage || !plan.vertex_alpha || mesh.vertices == 0) return;
  const std::optional<float> alpha = equal_alpha(mesh);
  if (!alpha) return;
  plan.vertex_alpha = false;
  plan.alpha[0] = plan.alpha[1] = clamp_unit(*alpha);
}

/// Whether a triangle that fails the depth test at every pixel changes nothing, and its depths are those of
/// its plane, so that tiles may leave it out.
bool may_skip_hidden(const DrawPlan& plan, const FrameBufferState& target) {
  const bool keeps_nearer = plan.depth_test == Compare::less || plan.depth_test == Compare::lequal;
  const bool fills_triangles =
      plan.topology == Topology::triangles && !plan.outlines && !plan.pixel_rectangle;
  const bool has_own_depth =
      plan.has_offset() || (plan.fragment_stage && plan.fragment_stage->stage.writes_depth);
  return plan.uses_depth && keeps_nearer && fills_triangles && !plan.uses_stencil && !has_own_depth &&
         target.format.samples == 1;
}

/// The field that leaves a draw without pixels.
std::string_view cause_of_empty_rect(const RecordedDraw& draw) {
  if (draw.state.scissor) return "scissor";
  if (!draw.pixels) return "viewport";
  return draw.pixels->rectangle.channels == 0 ? "bitmap" : "image";
}

/// The field that keeps a draw from changing any colour.
std::string_view cause_of_empty_mask(const DrawState& state) {
  const std::array<bool, 4>& mask = state.color_mask;
  if (std::none_of(mask.begin(), mask.end(), [](bool is_on) { return is_on; })) return "color_mask";
  return state.blend ? "blend" : "plane_mask";
}

/// Whether the state alone keeps a draw from changing any buffer.
bool is_noop_by_state(const DrawPlan& plan, const DrawState& state) {
  if (plan.rect.empty()) return true;
  if (state.alpha_test && state.alpha_test->func == Compare::never) return true;
  if (plan.uses_stencil && (plan.ops.faces[0].writes() || plan.ops.faces[1].writes())) return false;
  if (plan.uses_depth && plan.depth_test == Compare::never) return true;
  return !plan.touches_color && !(plan.uses_depth && plan.depth_write);
}

/// The field that keeps a draw from changing any buffer. Empty if a buffer may change.
std::string_view cause_of_no_change(const DrawPlan& plan, const RecordedDraw& draw) {
  if (plan.rect.empty()) return cause_of_empty_rect(draw);
  const bool fails_alpha_test = plan.ops.alpha_test && plan.ops.alpha_func == Compare::never;
  if (fails_alpha_test) return "alpha_test";
  if (plan.uses_stencil && (plan.ops.faces[0].writes() || plan.ops.faces[1].writes())) return {};
  if (plan.uses_depth && plan.depth_test == Compare::never) return "depth.test";
  const bool writes = plan.write_mask != 0 || (plan.uses_depth && plan.depth_write);
  return writes ? std::string_view() : cause_of_empty_mask(draw.state);
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

std::uint32_t plane_mask(const DrawState& state, const FrameBufferState& target) {
  if (!target.diffusion) return state.plane_mask;
  return (state.plane_mask & target.stored_layout.value_mask()) != 0 ? ~0u : 0;
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
  plan.light_candidates.swap(light_candidates);
  for (int face = 0; face < 2; ++face) {
    plan.light_reach[face].swap(light_reach[face]);
    plan.light_reach[face].clear();
  }
  plan.front.terms.swap(front.terms);
  plan.back.terms.swap(back.terms);
  plan.lights.clear();
  plan.front.terms.clear();
  plan.back.terms.clear();
  *this = std::move(plan);
}

void plan_draw(DrawPlan& plan, const RecordedDraw& draw, const FrameBufferState& target,
               const PlanOptions& asked_options, const EffectNotes& notes) {
  const DrawState& state = draw.state;
  plan.reset();
  plan.write_mask = write_mask(state.color_mask, plane_mask(state, target), target.layout);
  plan.touches_color = plan.write_mask != 0;
  plan_stages(plan, draw);
  // A stage may change what the data of the mesh prove.
  PlanOptions options = asked_options;
  options.elide &= plan.vertex_stage == nullptr;
  std::optional<EqualAlpha> alpha;
  const bool alpha_matters = state.alpha_test || state.blend;
  if (options.elide && alpha_matters && !plan.fragment_stage) alpha = equal_fragment_alpha(draw);
  if (alpha && plan.write_mask != 0 && keeps_stored_colors(state, target, alpha->value)) {
    plan.write_mask = 0;
    notes.skipped(Effect::blending, EffectReason::alpha_is_zero, alpha->cause);
  }
  if (draw.pixels) {
    plan_pixel_places(plan, *draw.pixels, target);
  } else {
    plan_transform(plan, draw, target);
    plan_elements(plan, draw);
    plan_faces(plan, draw, target.layout);
    if (state.shadow_on) notes.active(Effect::planar_shadow);
  }
  if (state.scissor) plan.rect = intersect(plan.rect, raster_rect(*state.scissor, target.format.height));
  plan_depth(plan, state, target);
  note_depth(plan, state, target, notes);
  plan_operations(plan, draw, target, alpha, notes);
  plan.is_noop = is_noop_by_state(plan, state);
  plan.skips_hidden = asked_options.elide && may_skip_hidden(plan, target);
  if (options.elide && !plan.is_noop && !draw.pixels && is_outside_view(plan, draw.mesh, options.isa)) {
    plan.is_left_out = true;
    return notes.skipped(Effect::draw, EffectReason::outside_view);
  }
  if (draw.pixels) plan_pixel_colors(plan, *draw.pixels, notes);
  else plan_shading(plan, draw, target, options, notes);
  if (options.elide) fold_stage_alpha(plan, draw.mesh);
  if (plan.texture.use == TexturePlan::Use::one_color)
    notes.active(Effect::texture,
                 plan.textures_per_pixel ? EffectReason::one_color_per_pixel : EffectReason::folded);
  plan.varyings = varying_layout(plan, options.capture_normals);
  if (plan.varyings.texcoord >= 0) plan.texture.texture.attribute = plan.varyings.texcoord;
  finish_stages(plan, draw, notes);
  if (plan.affine && plan.varyings.count > 0) notes.active(Effect::interpolation, EffectReason::affine);
  const std::string_view cause = cause_of_no_change(plan, draw);
  if (cause.empty()) return;
  plan.is_left_out = !plan.is_noop;
  notes.skipped(Effect::draw, EffectReason::no_pixel_can_change, cause);
}

}  // namespace tessera::detail
