// What Mesa cannot follow of the primitives of a draw.
#pragma once

#include <optional>
#include <string>

#include "tests/reference/scene.h"

namespace tessera::mesa {

/// @param draw  as as_drawn() gives it
/// @param camera  in force at the draw
/// @return the first reason found; nothing if Mesa can follow
std::optional<std::string> primitive_limit(const reference::Draw& draw, const reference::Scene& scene,
                                           const reference::Camera& camera);

}  // namespace tessera::mesa
