// Converts the scene of a model for the reference renderer.
#pragma once

#include "engine/program/scene/scene.h"
#include "tests/reference/scene.h"

namespace tessera::accuracy {

/// Every float is exact as a double. Covers what model_scene() makes: clears, and draws of meshes of
/// triangles with a material, without textures.
/// @pre the scene was made by model_scene()
reference::Scene reference_scene(const program::Scene& scene);

}  // namespace tessera::accuracy
