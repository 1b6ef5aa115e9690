// Planar shadows as ordinary draws.
#pragma once

#include <vector>

#include "tests/reference/scene.h"

namespace tessera::mesa {

/// Returns the draw itself, or the draw of its shadow: projected after the object's transform, unlit,
/// untextured, of one colour. The latter keeps `shadow_on`, so that the mesh's colours are ignored.
/// @param lights  current at the draw
reference::Draw as_drawn(const reference::Draw& draw, const std::vector<reference::Light>& lights);

/// Whether a draw uses the mesh's vertex colours.
bool has_vertex_colors(const reference::Draw& draw, const reference::Mesh& mesh);

}  // namespace tessera::mesa
