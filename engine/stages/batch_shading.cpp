#include "engine/stages/batch_shading.h"

#include <algorithm>
#include <iterator>

#include "engine/stages/vertex_varyings.h"
#include "shading/vertex_colors.h"

namespace tessera::detail {
namespace {

std::uint32_t packed_color_of(const GeometryDraw& draw, const ShadingBatch& batch, std::size_t i, int face) {
  if (draw.plan->is_index[face]) return quantize_index(*draw.layout, batch.field[kColorR][i]);
  return pack_color_or_index(*draw.layout, draw.palette_search, batch.field[kColorR][i],
                             batch.field[kColorG][i], batch.field[kColorB][i]);
}

/// Unlit draws: vertex colours, clamped like every result of the vertex stage.
void copy_vertex_colors(ShadingBatch& batch, std::size_t count) {
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < count; ++i)
      batch.field[kColorR + c][i] = std::min(std::max(batch.field[kVertexR + c][i], 0.0f), 1.0f);
}

/// Float colours of one face of a batch.
struct ColorOutput {
  float* first;
  std::size_t stride;  ///< floats from colour to colour
};
ColorOutput color_output(const GeometryDraw& draw, const ShadedPoints& points, int face) {
  const DrawPlan& plan = *draw.plan;
  if (points.triangles) return {draw.buffers->face_colors[face].data() + 4 * points.first, 4};
  return {varying(draw, points.first, plan.varyings.color[face]), varying_stride(plan)};
}

void store_indices(const GeometryDraw& draw, const ShadingBatch& batch, const ShadedPoints& points,
                   int face) {
  const auto [out, stride] = color_output(draw, points, face);
  for (std::size_t i = 0; i < points.count; ++i) out[i * stride] = batch.field[kColorR][i];
}

/// Alpha of point i, before texturing.
float alpha_of(const DrawPlan& plan, const ShadedPoints& points, std::size_t i, int face) {
  if (!plan.vertex_alpha) return plan.alpha[face];
  if (!plan.clamps_vertex_alpha) return points.alpha[i];
  return std::min(std::max(points.alpha[i], 0.0f), 1.0f);
}

/// Colours for fragment operations: r g b a per point.
void store_rgba(const GeometryDraw& draw, const ShadingBatch& batch, const ShadedPoints& points, int face) {
  const DrawPlan& plan = *draw.plan;
  auto [out, stride] = color_output(draw, points, face);
  for (std::size_t i = 0; i < points.count; ++i, out += stride) {
    for (int c = 0; c < 3; ++c) out[c] = batch.field[kColorR + c][i];
    out[3] = alpha_of(plan, points, i, face);
    if (plan.folds_texture())
      out[3] = texture_env_reference(plan.texture.texture, {0, 0, 0, out[3]}, plan.texture.texture.texel)[3];
  }
}

/// Applies a texture of one colour to clamped colours.
void fold_texture(const DrawTexture& texture, ShadingBatch& batch, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto color = texture_env_reference(
        texture, {batch.field[kColorR][i], batch.field[kColorG][i], batch.field[kColorB][i], 1},
        texture.texel);
    for (std::size_t c = 0; c < 3; ++c) batch.field[kColorR + c][i] = color[c];
  }
}

/// Stores the colours of a batch in the form that the tiles read.
void store_colors(const GeometryDraw& draw, ShadingBatch& batch, const ShadedPoints& points, int face,
                  InstructionSet isa) {
  const DrawPlan& plan = *draw.plan;
  if (plan.folds_texture() && !plan.is_index[face]) fold_texture(plan.texture.texture, batch, points.count);
  const bool is_interpolated = plan.source == ColorSource::interpolated;
  if (is_interpolated && plan.is_index[face]) return store_indices(draw, batch, points, face);
  if (plan.float_colors) return store_rgba(draw, batch, points, face);
  if (is_interpolated) {
    if (plan.scaled_colors) scale_colors(isa)(*draw.layout, batch, static_cast<int>(points.count));
    auto [out, stride] = color_output(draw, points, face);
    for (std::size_t i = 0; i < points.count; ++i, out += stride)
      for (int c = 0; c < 3; ++c) out[c] = batch.field[kColorR + c][i];
  } else if (!plan.is_index[face] && !draw.layout->index) {
    pack_vertex_colors(isa)(*draw.layout, batch, static_cast<int>(points.count),
                            draw.buffers->packed_colors[face].data() + points.first);
  } else {
    for (std::size_t i = 0; i < points.count; ++i)
      draw.buffers->packed_colors[face].data()[points.first + i] = packed_color_of(draw, batch, i, face);
  }
}

void light_batch(const GeometryDraw& draw, const LightingProgram& program, ShadingBatch& batch,
                 const ShadedPoints& points, int face, InstructionSet isa) {
  light_points(isa)(program, batch, static_cast<int>((points.count + 15) / 16 * 16));
  store_colors(draw, batch, points, face, isa);
}

}  // namespace

void clear_batch(ShadingBatch& batch) {
  for (auto& field : batch.field) std::fill(std::begin(field), std::end(field), 0.0f);
}

void shade_batch(const GeometryDraw& draw, ShadingBatch& batch, const ShadedPoints& points,
                 InstructionSet isa) {
  const DrawPlan& plan = *draw.plan;
  if (!plan.lit) {
    if (!plan.uses_color_indices) copy_vertex_colors(batch, points.count);
    store_colors(draw, batch, points, 0, isa);
    return;
  }
  if (plan.two_sided) {
    ShadingBatch back = batch;  // lighting modifies the normals of its batch
    light_batch(draw, plan.back, back, points, 1, isa);
  }
  light_batch(draw, plan.front, batch, points, 0, isa);
}

}  // namespace tessera::detail
