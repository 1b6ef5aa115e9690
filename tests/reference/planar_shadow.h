// Planar shadows: the projection from a light onto a plane.
#pragma once

#include <optional>

#include "scene.h"

namespace tessera::reference {

/// Maps world space onto the plane, with w above 0 for what lies between the light and the plane.
/// @param plane  a, b, c, d of a x + b y + c z + d = 0
/// @return none if there is no such projection: a plane without normal, a light in it, a direction along it
std::optional<Mat4> shadow_matrix(Vec4 plane, const Light& light);

}  // namespace tessera::reference
