// Cameras and lights of files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <assimp/camera.h>
#include <assimp/light.h>
#include <assimp/matrix4x4.h>

#include "engine/import/model.h"

namespace tessera {

/// What is to be known about a format, because assimp means other things by the same words.
struct FormatFacts {
  bool is_gltf = false;
  bool is_collada = false;
};

/// None for a camera without direction or angle.
/// @param world  of the camera's node
std::optional<ModelCamera> camera_of(const aiCamera& camera, const aiMatrix4x4& world, const FormatFacts& format);

/// Adds a light to the model; those that give no light or are of a kind that Tessera has not are left out, the latter with a warning.
/// Lights of glTF 2 (KHR_lights_punctual) are given in physical units:
///   diffuse = specular = colour x intensity / pi      which a white surface sends back of them
///   attenuation 1 / d^2 of points and spots           in metres
///   spot: the cutoff is the outer angle; the exponent halves the light where glTF's ramp between both angles does
/// Those of other formats shine with their colour, scaled to at most 1, and their attenuation never brightens.
void add_light(const aiLight& light, const aiMatrix4x4& world, const FormatFacts& format, Model& model);

}  // namespace tessera
