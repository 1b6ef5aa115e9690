#include "engine/stages/vertex_varyings.h"

#include <algorithm>
#include <cmath>

#include "engine/stages/batch_shading.h"

namespace tessera::detail {

void store_lighting_inputs(const GeometryDraw& draw, const ShadingBatch& batch, std::size_t first,
                           std::size_t count) {
  const VaryingLayout& layout = draw.plan->varyings;
  const std::size_t stride = varying_stride(*draw.plan);
  const auto store = [&](int offset, int field) {
    if (offset < 0) return;
    float* const out = varying(draw, first, offset);
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < count; ++i)
        out[i * stride + static_cast<std::size_t>(c)] = batch.field[field + c][i];
  };
  store(layout.normal, kNormalX);
  store(layout.position, kPositionX);
  store(layout.color[0], kVertexR);
  if (layout.alpha[0] < 0) return;
  float* const out = varying(draw, first, layout.alpha[0]);
  load_vertex_alpha(
      draw, count, [first](std::size_t i) { return first + i; },
      [&](std::size_t i, float alpha) { out[i * stride] = alpha; });  // clamped at the pixel, like the colour
}

void store_stage_inputs(const GeometryDraw& draw, const ShadingBatch& batch, std::size_t first,
                        std::size_t count) {
  const VaryingLayout& layout = draw.plan->varyings;
  const std::size_t stride = varying_stride(*draw.plan);
  const auto store = [&](int offset, int components, const auto& value) {
    if (offset < 0) return;
    float* out = varying(draw, first, offset);
    for (std::size_t i = 0; i < count; ++i, out += stride)
      for (int c = 0; c < components; ++c) out[c] = value(i, c);
  };
  const auto field = [&](int of) {
    return [&batch, of](std::size_t i, int c) { return batch.field[of + c][i]; };
  };
  if (layout.stage_eye != layout.position) store(layout.stage_eye, 3, field(kPositionX));
  if (layout.stage_normal != layout.normal) store(layout.stage_normal, 3, field(kNormalX));
  if (layout.stage_extras < 0) return;
  const auto extras = static_cast<std::size_t>(draw.plan->vertex_stage->extras);
  const float* const staged = draw.buffers->staged.extras.data() + first * extras;
  store(layout.stage_extras, draw.plan->fragment_stage->stage.reads.extras,
        [&](std::size_t i, int c) { return staged[i * extras + static_cast<std::size_t>(c)]; });
}

void store_texcoords(const GeometryDraw& draw, std::size_t first, std::size_t count) {
  const std::size_t stride = varying_stride(*draw.plan);
  const StridedFloats texcoords = draw.texcoords();
  float* out = varying(draw, first, draw.plan->varyings.texcoord);
  for (std::size_t i = 0; i < count; ++i, out += stride) std::copy_n(texcoords.at(first + i), 2, out);
}

void store_captured_normals(const GeometryDraw& draw, std::size_t first, std::size_t count,
                            InstructionSet isa) {
  float eye[3][kVertexBatch];
  if (draw.writes().normal) {
    const float* const staged = draw.buffers->staged.normals.data() + 3 * first;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < 3; ++c) eye[c][i] = staged[3 * i + c];
  } else {
    eye_normals(isa)(draw.plan->captured_eye, draw.vertex_normals().from(first), count, eye[0], eye[1],
                     eye[2]);
  }
  const std::size_t stride = varying_stride(*draw.plan);
  float* out = varying(draw, first, draw.plan->varyings.captured_normal);
  for (std::size_t i = 0; i < count; ++i, out += stride) {
    const bool is_finite = std::isfinite(eye[0][i]) && std::isfinite(eye[1][i]) && std::isfinite(eye[2][i]);
    // A capture drops no primitive.
    for (std::size_t c = 0; c < 3; ++c) out[c] = is_finite ? eye[c][i] : 0;
  }
}

}  // namespace tessera::detail
