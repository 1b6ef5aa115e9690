// The per-fragment operations as OpenGL's.
#pragma once

#include "context.h"

namespace tessera::mesa {

GLenum compare_function(reference::Compare test);

void set_enabled(GLenum capability, bool on);

void set_scissor(const std::optional<reference::Rect>& scissor);

/// Sets everything between shading and the colour mask for one draw: scissor, alpha test, stencil, depth with its range and
/// offset, blend, logic operation.
void set_fragment_functions(const Functions& gl, const reference::Draw& draw, reference::DepthFormat depth);

}  // namespace tessera::mesa
