// Conversion of a batch's vertex colors to packed colors, or to levels for interpolation.
#pragma once

#include <cstdint>

#include "framebuffer/format.h"
#include "framebuffer/instruction_set.h"
#include "shading/lighting.h"

namespace tessera::detail {

/// Writes the packed color of point i to packed[i] for i < count, as pack_color_or_index() at full alpha.
/// @pre the layout has no palette
using PackVertexColors = void(const ColorLayout& layout, const ShadingBatch& batch, int count,
                              std::uint32_t* packed);
PackVertexColors* pack_vertex_colors(InstructionSet isa);

/// Scales colors 0..1 of the points i < count to levels, in place, with the half that rounds added, so that
/// truncation yields the level. The values keep 2^-12 away from the borders of levels: an interpolated color
/// is off by less than 12 * 2^-24 of 256, so no pixel leaves the range of its triangle's vertices.
using ScaleColors = void(const ColorLayout& layout, ShadingBatch& batch, int count);
ScaleColors* scale_colors(InstructionSet isa);

}  // namespace tessera::detail
