// Transforms of lights and vertices into eye space, where lighting happens.
#pragma once

#include <glm/mat4x4.hpp>

#include "engine/tessera/tessera.hpp"
#include "raster/eye_transform.h"
#include "shading/lighting.h"

namespace tessera::detail {

/// Without alpha, which lighting does not use.
inline Rgb rgb(const Color& c) { return {c.r, c.g, c.b}; }

/// A light in eye space.
/// - Distances are limited so that the squared distance to points within 2^62 of the eye is a finite float.
/// - The view may be a projection: positions are divided by w after it (w = 0 counts as 1). Directional
///   lights stay directional.
EyeLight eye_light(const Light& light, const glm::dmat4& view);

/// Normals are transformed by the inverse transpose; `lengths` selects their lengths.
EyeTransform eye_transform(const glm::dmat4& eye_from_object, const NormalLengths& lengths);

}  // namespace tessera::detail
