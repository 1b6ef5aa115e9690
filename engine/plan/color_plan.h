// Colours of a draw: what they are computed from, and how often: per draw, vertex, triangle or pixel.
#pragma once

#include "engine/plan/draw_plan.h"

namespace tessera::detail {

/// Plans two-sided lighting, and the faces whose colours are indices.
void plan_faces(DrawPlan& plan, const RecordedDraw& draw, const ColorLayout& layout);

struct ColorOptions {
  bool sampled = false;  ///< several samples per pixel
  bool elide = true;     ///< leave out what the vertex data make unnecessary
  InstructionSet isa = InstructionSet::scalar;
};

/// Plans the colours of a mesh. @pre plan_faces(); the fragment operations and the texture are planned
/// @param notes  receives lighting, shading and colour inputs
void plan_color(DrawPlan& plan, const RecordedDraw& draw, const ColorLayout& layout,
                const ColorOptions& options, const EffectNotes& notes);

}  // namespace tessera::detail
