// Materials of files as Phong's terms. Physically based ones (glTF 2), with base colour b, metalness m and
// roughness r, become
//   diffuse   = ambient = b
//   specular  = (0.04 (1 - m) + b m) / (1 + 4 r^2)     what mirrors in all directions is spread by roughness
//   shininess = 2 / r^4 - 2, within 1 .. 1024          Blinn's exponent of that roughness (alpha = r^2)
//   emission  = the emissive factor; none where a picture says how much of it shines where
// With KHR_materials_pbrSpecularGlossiness, diffuse and specular are given, and r = 1 - glossiness; what is
// unlit only emits b. Ambient colours that a format does not know (black, or what assimp's readers put there)
// are the diffuse ones.
#pragma once

#include <string>
#include <vector>

#include <assimp/material.h>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {

Material material_of(const aiMaterial& from);

/// Whether its colours are meant to come from a picture.
bool has_color_texture(const aiMaterial& from);
/// The names of all its pictures, whatever they are for.
std::vector<std::string> textures_of(const aiMaterial& from);
/// Whether something is meant to be seen through it.
bool is_transparent(const aiMaterial& from);

}  // namespace tessera::program
