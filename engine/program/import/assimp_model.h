// Converts a scene that assimp has read to a Model.
#pragma once

#include <assimp/scene.h>

#include "engine/program/import/model.h"

namespace tessera::program {

/// Merges all nodes, in world space, into one mesh with one part per material and kind of primitive.
/// - Missing normals are 0 0 0.
/// - Images of textures are named or copied, not decoded; see decode_images().
/// @param is_collada  assimp reports angles of cameras and spots differently for Collada
/// @throws Error for indices out of bounds, nodes nested too deeply, or a scene without anything to draw
Model model_of(const aiScene& scene, bool is_collada);

}  // namespace tessera::program
