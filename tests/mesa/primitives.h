// Primitives as OpenGL draws them: which ones, their sides, sizes and modes.
#pragma once

#include <vector>

#include "context.h"
#include "vertex_list.h"

namespace tessera::mesa {

/// Sets front faces, culling, polygon modes, provoking vertex, and the sizes of points and lines.
void set_primitive_state(const Functions& gl, const reference::Draw& draw);

/// @param vertices  at least one
void draw_vertices(reference::PrimitiveType type, const std::vector<Vertex>& vertices);

}  // namespace tessera::mesa
