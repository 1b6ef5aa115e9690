#include "engine/plan/varying_layout.h"

#include "engine/plan/draw_plan.h"

namespace tessera::detail {
namespace {

/// Adds `floats` floats to the record, and returns their offset.
int append(VaryingLayout& layout, int floats) {
  const int offset = layout.count;
  layout.count += floats;
  return offset;
}

void add_lighting_inputs(VaryingLayout& layout, const DrawPlan& plan) {
  if (plan.needs_normal()) layout.normal = append(layout, 3);
  if (plan.needs_position()) layout.position = append(layout, 3);
  if (plan.uses_vertex_colors) layout.color[0] = layout.color[1] = append(layout, 3);
  layout.shading_count = layout.count;
  // Lighting does not read alpha: it is stored after the inputs of lighting.
  if (plan.float_colors && plan.vertex_alpha) layout.alpha[0] = layout.alpha[1] = append(layout, 1);
}

void add_colors(VaryingLayout& layout, const DrawPlan& plan) {
  if (plan.has_per_triangle_colors()) return;
  layout.color[0] = append(layout, plan.color_floats());
  layout.color[1] = plan.two_sided ? append(layout, plan.color_floats()) : layout.color[0];
  layout.shading_count = layout.count;
  for (int face = 0; face < 2; ++face)
    if (plan.float_colors && !plan.is_index[face]) layout.alpha[face] = layout.color[face] + 3;
}

void add_stage_inputs(VaryingLayout& layout, const FragmentValues& reads) {
  if (reads.eye) layout.stage_eye = layout.position >= 0 ? layout.position : append(layout, 3);
  if (reads.normal) layout.stage_normal = layout.normal >= 0 ? layout.normal : append(layout, 3);
  if (reads.extras > 0) layout.stage_extras = append(layout, reads.extras);
}

}  // namespace

VaryingLayout varying_layout(const DrawPlan& plan, bool capture_normals) {
  VaryingLayout layout;
  if (plan.source == ColorSource::per_pixel) add_lighting_inputs(layout, plan);
  if (plan.source == ColorSource::interpolated) add_colors(layout, plan);
  if (plan.textures_per_pixel && plan.texture.use == TexturePlan::Use::texels)
    layout.texcoord = append(layout, 2);
  if (capture_normals && plan.write_mask != 0 && !plan.pixel_rectangle)
    layout.captured_normal = append(layout, 3);
  if (plan.fragment_stage) add_stage_inputs(layout, plan.fragment_stage->stage.reads);
  return layout;
}

}  // namespace tessera::detail
