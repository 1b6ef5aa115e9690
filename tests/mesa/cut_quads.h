// Quads that the view volume cuts.
#pragma once

#include <vector>

#include "tests/reference/scene.h"
#include "vertex_list.h"

namespace tessera::mesa {

/// Mesa splits quads from their first to their third vertex, but those that it has to cut, from the second to
/// the fourth. Smooth, filled quads of a draw that may be cut become triangles, split as the others: changes
/// `vertices`, and returns what they make.
reference::PrimitiveType split_cut_quads(const reference::Mesh& mesh, const reference::Draw& draw,
                                         const reference::Camera& camera, std::vector<Vertex>& vertices);

}  // namespace tessera::mesa
