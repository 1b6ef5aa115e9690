// Texturing by GLSL programs.
#pragma once

#include "programs.h"

namespace tessera::mesa {

/// Whether a texture's colours depend on the level of detail, for which Mesa's own is too coarse.
bool asks_for_level(const reference::Texture& texture);

/// Whether a draw produces lines, whose level of detail is computed along their length.
bool draws_lines(const reference::Draw& draw, const reference::Mesh& mesh);

/// Sets the uniforms of the current program for the texture bound by Textures::use(); null: none.
void set_program_texture(const Programs& programs, const reference::Draw& draw, const reference::Mesh& mesh,
                         const reference::Texture* texture);

}  // namespace tessera::mesa
