// Planar shadows: the projection of an object from a light onto a plane, in one colour.
#pragma once

#include "engine/record/recording.h"

namespace tessera::detail {

/// Replaces a draw with `shadow_on` by the draw of its shadow.
/// @throws Error  if there is no such light, or it casts no shadow on the plane
void apply_planar_shadow(RecordedDraw& draw);

}  // namespace tessera::detail
