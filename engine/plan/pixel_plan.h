// The parts of a DrawPlan that are special to bitmaps and images.
#pragma once

#include "engine/plan/draw_plan.h"

namespace tessera::detail {

/// Plans which pixels are covered, and their depth.
void plan_pixel_places(DrawPlan& plan, const RecordedPixels& pixels, const FrameBufferState& target);
/// Plans the colours.
/// @pre the fragment operations are planned
/// @param notes  receives the source of the colours
void plan_pixel_colors(DrawPlan& plan, const RecordedPixels& pixels, const EffectNotes& notes);

}  // namespace tessera::detail
