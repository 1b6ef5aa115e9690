// The public matrices, as GLM has them.
#pragma once

#include <glm/mat4x4.hpp>

#include "engine/tessera/tessera.hpp"

namespace tessera::detail {

glm::dmat4 to_glm(const Matrix& matrix);
Matrix from_glm(const glm::dmat4& matrix);

/// The same direction, its square within a double's range: very long and very short vectors are scaled by a
/// power of two.
glm::dvec3 scaled_to_safe_range(const glm::dvec3& v);

}  // namespace tessera::detail
