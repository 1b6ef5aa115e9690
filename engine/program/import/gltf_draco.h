// Primitives compressed by KHR_draco_mesh_compression.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/program/import/tinygltf_include.h"

#include "engine/program/import/gltf_accessor.h"

namespace tessera::program {

struct DracoPrimitive {
  std::vector<std::uint32_t> indices;
  std::map<std::string, GltfValues> attributes;
};

/// @return nothing for a primitive that is not compressed
/// @throws Error for data that cannot be decoded
std::optional<DracoPrimitive> decode_draco(const GltfFile& file, const tinygltf::Primitive& primitive);

}  // namespace tessera::program
