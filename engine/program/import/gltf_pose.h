// Transforms of glTF's nodes, skins and morph targets, in double.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "engine/program/import/tinygltf_include.h"

#include "engine/program/import/gltf_accessor.h"

namespace tessera::program {

/// Columns of a 4 x 4 matrix, in order, as glTF stores them.
using GltfMatrix = std::array<double, 16>;

GltfMatrix product(const GltfMatrix& left, const GltfMatrix& right);
std::array<double, 3> transformed_point(const GltfMatrix& m, const double* point);
/// The inverse transpose of the upper 3 x 3, times the determinant, which keeps it finite.
std::array<double, 3> transformed_normal(const GltfMatrix& m, const double* normal);
double determinant(const GltfMatrix& m);

/// World transforms of the nodes of the default scene, or of all root nodes.
struct GltfWorld {
  std::vector<GltfMatrix> matrices;  ///< per node
  std::vector<std::size_t> nodes;    ///< those of the scene, parents before children
};
/// @throws Error for nodes that are missing, nested too deeply, or reached twice
GltfWorld gltf_world(const tinygltf::Model& gltf);

/// Matrices of the joints of a skin: from the bind pose to the world.
std::vector<GltfMatrix> joint_matrices(const GltfFile& file, const tinygltf::Model& gltf,
                                       const GltfWorld& world, int skin);

}  // namespace tessera::program
