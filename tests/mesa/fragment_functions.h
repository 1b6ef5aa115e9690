// The per-fragment operations in OpenGL.
#pragma once

#include "context.h"

namespace tessera::mesa {

GLenum compare_function(reference::Compare test);

void set_enabled(GLenum capability, bool on);

void set_scissor(const std::optional<reference::Rect>& scissor);

void set_color_mask(const std::array<bool, 4>& mask);

/// Sets the state between shading and the colour buffer: scissor, alpha test, stencil, depth test, blend,
/// logic operation, and the masks, which must be of whole components.
void set_fragment_functions(const Functions& gl, const reference::FragmentState& state,
                            const reference::FrameBufferFormat& format);

/// Sets the depth range and the polygon offset for all polygon modes.
void set_window_depths(const reference::Draw& draw, reference::DepthFormat depth);

}  // namespace tessera::mesa
