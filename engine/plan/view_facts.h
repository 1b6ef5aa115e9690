// Facts about where a draw lies: whether its vertices show that it is outside the view volume or its
// rectangle of pixels.
#pragma once

#include "engine/plan/draw_plan.h"

namespace tessera::detail {

/// Whether all vertices of filled triangles lie beyond one plane of the view volume, or beyond one side of
/// DrawPlan::rect. Such a draw covers no pixel.
/// - Tests a few vertices first: draws that are visible cost next to nothing.
/// - False for meshes with w components, and if a position is not finite.
///
/// @pre transform, rect and elements of the draw are planned
bool is_outside_view(const DrawPlan& plan, const MeshArrays& mesh, InstructionSet isa);

}  // namespace tessera::detail
