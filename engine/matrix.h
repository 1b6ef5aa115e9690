// The public matrices, as GLM has them.
#pragma once

#include <glm/mat4x4.hpp>

#include "engine/tessera/tessera.hpp"

namespace tessera {

glm::dmat4 to_glm(const Matrix& matrix);
Matrix from_glm(const glm::dmat4& matrix);

}  // namespace tessera
