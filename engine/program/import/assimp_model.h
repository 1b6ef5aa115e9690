// What becomes of a scene that assimp read.
#pragma once

#include <string_view>

#include <assimp/scene.h>

#include "engine/program/import/model.h"

namespace tessera::program {

inline constexpr std::string_view kHoldsNoTriangle = "holds no triangle";

/// All nodes of a scene, in world space, as one mesh, a part for each material; normals that are missing are
/// 0 0 0, and `files` are names, from the folder of the model.
/// @param with_view   also cameras and lights
/// @param is_collada  angles mean something else there
/// @throws Error for indices out of bounds, nodes nested too deeply, and where no triangle is left.
Model model_of(const aiScene& scene, bool with_view, bool is_collada);

}  // namespace tessera::program
