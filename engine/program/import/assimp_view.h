// Cameras and lights as assimp gives them: of every format but glTF 2 (gltf_view.h).
#pragma once

#include <optional>

#include <assimp/camera.h>
#include <assimp/light.h>
#include <assimp/matrix4x4.h>

#include "engine/program/import/model.h"

namespace tessera::program {

/// None for a camera without direction or angle.
/// @param world  of the camera's node
std::optional<ModelCamera> camera_of(const aiCamera& camera, const aiMatrix4x4& world, bool is_collada);

/// Adds a light to the model; those that give no light or are of a kind that Tessera has not are left out,
/// the latter with a warning. They shine with their colour, scaled to at most 1, and their attenuation never
/// brightens.
void add_light(const aiLight& light, const aiMatrix4x4& world, bool is_collada, Model& model);

}  // namespace tessera::program
