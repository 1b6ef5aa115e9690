// The part of a draw's plan that is a bitmap's or an image's own.
#pragma once

#include "engine/plan/draw_plan.h"

namespace tessera::detail {

/// Where it goes, and at which depth.
void plan_pixel_places(DrawPlan& plan, const RecordedPixels& pixels, const FrameBufferState& target);
/// @pre the plan has its operations
/// @param notes  receives the source of the colours
void plan_pixel_colors(DrawPlan& plan, const RecordedPixels& pixels, const EffectNotes& notes);

}  // namespace tessera::detail
