// Materials of glTF.
#pragma once

#include <optional>
#include <vector>

#include "engine/program/import/tinygltf_include.h"

#include "engine/program/import/model.h"

namespace tessera::program {

/// The texture of a material, with the transform of its coordinates [KHR_texture_transform]:
/// s' = x . (s, t, 1), t' = y . (s, t, 1), t downwards.
struct GltfTexture {
  ModelTexture texture;
  int coordinates = 0;  ///< number of the set: TEXCOORD_0, ...
  double x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
};

struct GltfMaterial {
  ModelPart part;                 ///< without a range of indices and without a texture
  double base[4] = {1, 1, 1, 1};  ///< linear; vertex colours are factors of it
  std::optional<GltfTexture> texture{};
};

/// Materials in the order of the file; the default one is last.
/// @throws Error for textures and images out of bounds
std::vector<GltfMaterial> gltf_materials(const tinygltf::Model& gltf, std::size_t image_count);

/// A linear value as the display-referred one that Material and vertex colours have: the curve of sRGB.
float display_referred(double linear);

}  // namespace tessera::program
