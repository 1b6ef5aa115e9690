// Conversion of vertex colours in a batch to packed colours, or to levels for interpolation.
#pragma once

#include <cstdint>

#include "framebuffer/format.h"
#include "framebuffer/instruction_set.h"
#include "shading/lighting.h"

namespace tessera::detail {

/// Writes the packed colour of point i to packed[i] for i < count, as pack_color_or_index() with alpha 1.
/// @pre the layout has no palette
using PackVertexColors = void(const ColorLayout& layout, const ShadingBatch& batch, int count,
                              std::uint32_t* packed);
PackVertexColors* pack_vertex_colors(InstructionSet isa);

/// Scales the colours of the points i < count in place: from 0..1 to levels plus 1/2, so that truncation
/// rounds to the nearest level. The results keep a distance of 2^-12 from whole numbers. That is more than
/// the error of an interpolated colour, 256 * 12 * 2^-24, so no pixel leaves the range of the vertices.
using ScaleColors = void(const ColorLayout& layout, ShadingBatch& batch, int count);
ScaleColors* scale_colors(InstructionSet isa);

}  // namespace tessera::detail
