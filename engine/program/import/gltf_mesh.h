// Vertices and primitives of glTF's meshes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/program/import/tinygltf_include.h"

#include "engine/program/import/gltf_accessor.h"
#include "engine/program/import/gltf_material.h"

namespace tessera::program {

/// A primitive of a mesh in its bind pose, with morph targets applied.
struct GltfPrimitive {
  Primitive primitive = Primitive::triangles;             ///< triangles, lines or points
  std::vector<std::uint32_t> indices;                     ///< a list: strips, fans and loops are split
  std::vector<std::array<double, 3>> positions, normals;  ///< normals: empty if there are none
  std::vector<std::array<double, 4>> colors;              ///< linear; empty if there are none
  std::vector<std::array<double, 2>> texcoords;           ///< the material's set, t downwards; or empty
  GltfValues joints, weights;                             ///< four or more influences per vertex; or empty
};

/// @param weights  of the morph targets
/// @throws Error for attributes that do not fit together and indices out of bounds
GltfPrimitive read_primitive(const GltfFile& file, const tinygltf::Model& gltf,
                             const tinygltf::Primitive& from, const std::vector<double>& weights,
                             const GltfMaterial& material);

}  // namespace tessera::program
