// Texturing by programs.
#pragma once

#include "programs.h"

namespace tessera::mesa {

/// Whether the level of detail decides about a texture's colours: Mesa's own is too rough then.
bool asks_for_level(const reference::Texture& texture);

/// Whether a draw makes lines, whose level of detail is that along their length.
bool draws_lines(const reference::Draw& draw, const reference::Mesh& mesh);

/// Tells the program in use of the texture, which Textures::use() has bound; null: none.
void set_program_texture(const Programs& programs, const reference::Draw& draw, const reference::Mesh& mesh,
                         const reference::Texture* texture);

}  // namespace tessera::mesa
