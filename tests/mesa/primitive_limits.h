// Primitives of a draw that Mesa cannot render as specified.
#pragma once

#include <optional>
#include <string>

#include "tests/reference/scene.h"

namespace tessera::mesa {

/// @param draw  as returned by as_drawn()
/// @param camera  current at the draw
/// @return the first reason found; none if Mesa can render the draw
std::optional<std::string> primitive_limit(const reference::Draw& draw, const reference::Scene& scene,
                                           const reference::Camera& camera);

}  // namespace tessera::mesa
