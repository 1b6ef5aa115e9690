// What carries a draw's lights and vertices into eye space, where lighting happens.
#pragma once

#include <glm/mat4x4.hpp>

#include "engine/tessera/tessera.hpp"
#include "raster/vertex_transform.h"
#include "shading/lighting.h"

namespace tessera::detail {

/// A light however far away: its squared distance from what is within 2^62 of the eye is a float. Its
/// position is xyz/w after the view, too, which may project (w = 0 counts as 1); a directional light is one
/// under every view.
EyeLight eye_light(const Light& light, const glm::dmat4& view);

/// For normals by the inverse transpose, of the lengths that the draw wants.
EyeTransform eye_transform(const glm::dmat4& eye_from_object, const NormalLengths& lengths);

}  // namespace tessera::detail
