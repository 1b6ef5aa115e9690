// Converts a scene that assimp has read to a Model.
#pragma once

#include <string_view>

#include <assimp/scene.h>

#include "engine/program/import/model.h"

namespace tessera::program {

inline constexpr std::string_view kHoldsNoTriangle = "holds no triangle";

/// Merges all nodes, in world space, into one mesh with one part per material. Missing normals are 0 0 0.
/// @param with_view   also converts cameras and lights
/// @param is_collada  assimp reports angles of cameras and spots differently for Collada
/// @throws Error for indices out of bounds, nodes nested too deeply, or a scene without triangles.
Model model_of(const aiScene& scene, bool with_view, bool is_collada);

}  // namespace tessera::program
