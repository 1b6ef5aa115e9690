// Storing of a vertex's varyings in its record of DrawPlan::varyings.
#pragma once

#include <cstddef>

#include "engine/stages/geometry.h"
#include "shading/lighting.h"

namespace tessera::detail {

/// Floats from record to record.
inline std::size_t varying_stride(const DrawPlan& plan) {
  return static_cast<std::size_t>(plan.varyings.count);
}

/// Address of the varying at `offset` in the record of `vertex`.
inline float* varying(const GeometryDraw& draw, std::size_t vertex, int offset) {
  return draw.buffers->attributes.data() + vertex * varying_stride(*draw.plan) + offset;
}

/// Stores the inputs of per-pixel lighting, in eye space.
void store_lighting_inputs(const GeometryDraw& draw, const ShadingBatch& batch, std::size_t first,
                           std::size_t count);
/// Stores the inputs of the fragment stage that lighting does not store.
void store_stage_inputs(const GeometryDraw& draw, const ShadingBatch& batch, std::size_t first,
                        std::size_t count);
void store_texcoords(const GeometryDraw& draw, std::size_t first, std::size_t count);
/// Stores eye-space normals for captures, independent of shading.
void store_captured_normals(const GeometryDraw& draw, std::size_t first, std::size_t count,
                            InstructionSet isa);

}  // namespace tessera::detail
