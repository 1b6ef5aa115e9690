// Planar shadows: the projection from a light onto a plane.
#pragma once

#include <optional>

#include "scene.h"

namespace tessera::reference {

/// Maps world space onto the plane; w is above 0 between the light and the plane.
/// @param plane  a, b, c, d of a x + b y + c z + d = 0
/// @return none for a plane without normal, a light in the plane, or a direction parallel to it
std::optional<Mat4> shadow_matrix(Vec4 plane, const Light& light);

}  // namespace tessera::reference
