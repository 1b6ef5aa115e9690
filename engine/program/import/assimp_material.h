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

#include <optional>
#include <string>

#include <assimp/material.h>

#include "engine/program/import/model.h"

namespace tessera::program {

Material material_of(const aiMaterial& from);

/// The image that supplies the colours of a material, and how its coordinates become those of the texture.
struct ColorTexture {
  std::string name;      ///< a file, or the name of an embedded image
  unsigned channel = 0;  ///< number of the mesh's set of texture coordinates
  TextureSampler sampler;
  aiUVTransform transform;  ///< scaling and rotation around (0.5, 0.5), then translation
};
std::optional<ColorTexture> color_texture_of(const aiMaterial& from);

/// Makes a part blend if the opacity of its material is below 1.
void set_alpha(const aiMaterial& from, ModelPart& part);

}  // namespace tessera::program
