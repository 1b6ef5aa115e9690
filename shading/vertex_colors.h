// What the colours of a batch of vertices are carried as: stored words, or levels to interpolate.
#pragma once

#include <cstdint>

#include "framebuffer/format.h"
#include "framebuffer/instruction_set.h"
#include "shading/lighting.h"

namespace tessera::detail {

/// packed[i]: the packed color of point i, for i < count: as pack_color_or_index() of a layout without a
/// palette, at full alpha. Beyond `count` nothing is written.
using PackVertexColors = void(const ColorLayout& layout, const ShadingBatch& batch, int count,
                              std::uint32_t* packed);
PackVertexColors* pack_vertex_colors(InstructionSet isa);

/// Colours of 0..1 of the points i < count into the layout's levels with the half that rounds, in place, so
/// that cutting off leaves the level; at least 2^-12 away from where that would be another one: an
/// interpolated colour is off by less than 12 * 2^-24 of 256, and no pixel leaves the range of its triangle's
/// vertices.
using ScaleColors = void(const ColorLayout& layout, ShadingBatch& batch, int count);
ScaleColors* scale_colors(InstructionSet isa);

}  // namespace tessera::detail
