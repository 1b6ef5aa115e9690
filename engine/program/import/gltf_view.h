// Cameras, lights and names of other files of glTF 2 files, read from their JSON. Assimp keeps only one of
// the nodes that share a camera or light, and gives other angles; of other files it tells only the pictures
// of materials that are used, as URIs.
#pragma once

#include <string>

#include "engine/program/import/model.h"

namespace tessera::program {

/// Adds those of the default scene, and buffers and pictures that are files, to the model. Lights
/// (KHR_lights_punctual) are given in physical units:
///   diffuse = specular = color x intensity / pi       which a white surface sends back of them
///   attenuation 1 / d^2 of points and spots           d in metres
///   spot: the cutoff is the outer angle; the exponent halves the light where glTF's ramp between both angles
///   does
/// False, and nothing is added, if the file is none of glTF 2.
bool add_gltf_view(const std::string& path, Model& model);
/// The same from the file's bytes.
bool add_gltf_view_of_bytes(const std::string& bytes, Model& model);

}  // namespace tessera::program
