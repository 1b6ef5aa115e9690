// Values of glTF's accessors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/program/import/tinygltf_include.h"

#include "engine/program/import/gltf_file.h"

namespace tessera::program {

/// Elements of an accessor as doubles, in order.
struct GltfValues {
  std::size_t components = 0;  ///< per element; 0: no elements
  std::vector<double> values;

  std::size_t count() const { return components == 0 ? 0 : values.size() / components; }
  const double* element(std::size_t i) const { return &values[i * components]; }
};

/// Reads all elements.
/// - Integers that are normalized become -1 to 1 or 0 to 1, as glTF defines.
/// - Sparse elements replace others; an accessor without a buffer view holds zeros.
/// @throws Error for numbers and ranges out of bounds
GltfValues read_accessor(const GltfFile& file, const tinygltf::Model& gltf, int accessor);

/// Reads indices of vertices.
/// @throws Error also for indices that are no unsigned integers
std::vector<std::uint32_t> read_indices(const GltfFile& file, const tinygltf::Model& gltf, int accessor);

}  // namespace tessera::program
