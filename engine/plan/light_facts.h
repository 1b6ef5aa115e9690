// Lights that add exactly nothing to a draw, proven from its vertices.
#pragma once

#include "engine/plan/draw_plan.h"

namespace tessera::detail {

/// Sets `plan.light_reach` from the positions and normals of the mesh. Reads a vertex or two if a light
/// reaches them, otherwise the whole mesh.
/// @pre `plan` has its lights, eye transform, topology and faces
/// @param isa  for the scan of the mesh
void prove_light_reach(DrawPlan& plan, const RecordedDraw& draw, InstructionSet isa);

}  // namespace tessera::detail
