// Converts materials of model files to the terms of Phong's model. Physically based materials (glTF 2) with
// base colour b, metalness m and roughness r become
//   diffuse   = ambient = b
//   specular  = (0.04 (1 - m) + b m) / (1 + 4 r^2)     roughness spreads the reflection
//   shininess = 2 / r^4 - 2, clamped to 1 .. 1024      Blinn's exponent for that roughness (alpha = r^2)
//   emission  = the emissive factor; black if a texture modulates it
// KHR_materials_pbrSpecularGlossiness gives diffuse and specular directly, and r = 1 - glossiness. Unlit
// materials only emit b. Ambient colours that a format lacks (black, or assimp's placeholder) are set to the
// diffuse colour.
#pragma once

#include <assimp/material.h>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {

Material material_of(const aiMaterial& from);

/// Returns whether a texture supplies the material's colours.
bool has_color_texture(const aiMaterial& from);
/// Returns whether the material is meant to be translucent.
bool is_transparent(const aiMaterial& from);

}  // namespace tessera::program
