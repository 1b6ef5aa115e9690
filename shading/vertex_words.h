// Stored words of the colours of a batch of vertices.
#pragma once

#include <cstdint>

#include "framebuffer/format.h"
#include "framebuffer/instruction_set.h"
#include "shading/lighting.h"

namespace tessera {

/// words[i] of the colour of point i, for i < count: as color_word() of a layout without a palette, at full alpha. Beyond `count` nothing is written.
using VertexWords = void(const ColorLayout& layout, const ShadingBatch& batch, int count, std::uint32_t* words);
VertexWords* vertex_words(Isa isa);

}  // namespace tessera
