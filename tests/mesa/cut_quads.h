// Quads that the view volume clips.
#pragma once

#include <vector>

#include "tests/reference/scene.h"
#include "vertex_list.h"

namespace tessera::mesa {

/// Mesa splits quads from their first to their third vertex, but clipped ones from the second to the fourth.
/// Smooth, filled quads of a draw that may be clipped become triangles, split like unclipped quads: changes
/// `vertices` and returns their primitive type.
reference::PrimitiveType split_cut_quads(const reference::Mesh& mesh, const reference::Draw& draw,
                                         const reference::Camera& camera, std::vector<Vertex>& vertices);

}  // namespace tessera::mesa
