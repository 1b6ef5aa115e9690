// Reads cameras and lights of glTF 2 files from their JSON. assimp keeps only one of the nodes that share a
// camera or a light, and does not preserve their angles.
#pragma once

#include <string>

#include "engine/program/import/model.h"

namespace tessera::program {

/// Adds cameras and lights of the default scene to the model.
/// Lights (KHR_lights_punctual) are in physical units and become display-referred, as materials do: the
/// product of two such values is about that of the product of their light, because sRGB's curve is nearly a
/// power of 1 / 2.2.
///   diffuse = specular = srgb(color * intensity / pi)   light that a white surface reflects
///   attenuation 1 / d of points and spots               d in metres: (1 / d^2)^(1 / 2.2) = 1 / d^0.91
///   spot cutoff = outer cone angle
///   spot exponent: both falloffs are 1/2 at the same angle (spot_exponent.h)
/// @return false, with nothing added, if the file is not glTF 2
bool add_gltf_view_of_bytes(const std::string& bytes, Model& model);

}  // namespace tessera::program
