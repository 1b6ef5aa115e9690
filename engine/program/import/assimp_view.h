// Converts cameras and lights that assimp has read; those of glTF 2 come from gltf_view.h.
#pragma once

#include <optional>

#include <assimp/camera.h>
#include <assimp/light.h>
#include <assimp/matrix4x4.h>

#include "engine/program/import/model.h"

namespace tessera::program {

/// Returns nothing for a camera without a direction or an angle of view.
/// @param world  transform of the camera's node
std::optional<ModelCamera> camera_of(const aiCamera& camera, const aiMatrix4x4& world, bool is_collada);

/// Adds a light to the model.
/// - Black lights are left out; so are unsupported kinds, with a warning.
/// - Colours are scaled to at most 1.
/// - The constant attenuation is at least 1, so that attenuation never brightens.
void add_light(const aiLight& light, const aiMatrix4x4& world, bool is_collada, Model& model);

}  // namespace tessera::program
