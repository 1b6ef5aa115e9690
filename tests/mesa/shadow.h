// Planar shadows as ordinary draws.
#pragma once

#include <vector>

#include "tests/reference/scene.h"

namespace tessera::mesa {

/// The draw itself, or that of its shadow: projected after the object's transform, unlit, untextured, of one
/// colour. What a shadow is drawn with keeps `shadow_on`, by which its mesh's colours have no say.
/// @param lights  in force at the draw
reference::Draw as_drawn(const reference::Draw& draw, const std::vector<reference::Light>& lights);

/// Whether the mesh's own colours colour a draw.
bool has_vertex_colors(const reference::Draw& draw, const reference::Mesh& mesh);

}  // namespace tessera::mesa
