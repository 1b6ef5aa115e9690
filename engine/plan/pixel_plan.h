// The part of a draw's plan that is a bitmap's or an image's own.
#pragma once

#include <string>

#include "engine/plan/draw_plan.h"

namespace tessera::detail {

/// Where it goes, and at which depth.
void plan_pixel_places(DrawPlan& plan, const RecordedPixels& pixels, const FrameBufferState& target);
/// @param reasons  if given, receives what its colours are. @pre the plan knows its operations
void plan_pixel_colors(DrawPlan& plan, const RecordedPixels& pixels, std::string* reasons);

}  // namespace tessera::detail
