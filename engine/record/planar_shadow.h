// Planar shadows: an object's projection from a light onto a plane, in one colour.
#pragma once

#include "engine/record/recording.h"

namespace tessera::detail {

/// Turns a draw with `shadow_on` into that of the shadow. Throws Error for a light that is not there, or one
/// that casts none on the plane.
void apply_planar_shadow(RecordedDraw& draw);

}  // namespace tessera::detail
