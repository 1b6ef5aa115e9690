// Conversion of public matrices to and from GLM.
#pragma once

#include <glm/mat4x4.hpp>

#include "engine/tessera/tessera.hpp"

namespace tessera::detail {

glm::dmat4 to_glm(const Matrix& matrix);
Matrix from_glm(const glm::dmat4& matrix);

/// Scales very long and very short vectors by a power of two, so that their squared length is in the range of
/// doubles.
glm::dvec3 scaled_to_safe_range(const glm::dvec3& v);

}  // namespace tessera::detail
