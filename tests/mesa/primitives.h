// Primitives in OpenGL: types, facing, sizes and polygon modes.
#pragma once

#include <vector>

#include "context.h"
#include "vertex_list.h"

namespace tessera::mesa {

/// Sets front faces, culling, polygon modes, provoking vertex, and the sizes of points and lines.
void set_primitive_state(const Functions& gl, const reference::Draw& draw);

reference::Rect viewport_of(const reference::Draw& draw, const reference::FrameBufferFormat& format);

/// Size of the enlarged viewport relative to the draw's, with the same centre.
struct Growth {
  double x = 1, y = 1;
};

/// Mesa ends a line, in its whole width, where its centre line leaves the viewport. For lines the viewport is
/// enlarged, so that they end outside the visible part. By powers of two, so that no vertex moves; by 1 for
/// meshes with points, which are correctly dropped by their centres.
Growth viewport_growth(reference::PrimitiveType type, const reference::Draw& draw,
                       const reference::Rect& viewport);

void set_viewport(const Functions& gl, const reference::Rect& viewport, Growth growth);

/// Maps clip space to the middle of an enlarged viewport.
reference::Mat4 shrinking(Growth growth);

/// @param vertices  at least one
void draw_vertices(reference::PrimitiveType type, const std::vector<Vertex>& vertices);

}  // namespace tessera::mesa
