// Primitives as OpenGL draws them: which ones, their sides, sizes and modes.
#pragma once

#include <vector>

#include "context.h"
#include "vertex_list.h"

namespace tessera::mesa {

/// Sets front faces, culling, polygon modes, provoking vertex, and the sizes of points and lines.
void set_primitive_state(const Functions& gl, const reference::Draw& draw);

reference::Rect viewport_of(const reference::Draw& draw, const reference::FrameBufferFormat& format);

/// How many times as wide and high as the draw's a viewport is, with the same centre.
struct Growth {
  double x = 1, y = 1;
};

/// Mesa ends a line, in its whole width, where the line's middle leaves the viewport: for lines the viewport
/// is larger, so that they end out of sight. By powers of two, so that no vertex moves; by 1 for what has
/// points, which are dropped by their middles indeed.
Growth viewport_growth(reference::PrimitiveType type, const reference::Draw& draw,
                       const reference::Rect& viewport);

void set_viewport(const Functions& gl, const reference::Rect& viewport, Growth growth);

/// What brings clip space into the middle of a larger viewport.
reference::Mat4 shrinking(Growth growth);

/// @param vertices  at least one
void draw_vertices(reference::PrimitiveType type, const std::vector<Vertex>& vertices);

}  // namespace tessera::mesa
