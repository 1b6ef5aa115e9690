// The parts of a glTF file: JSON, buffers, images.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/program/import/model.h"

namespace tessera::program {

struct GltfFile {
  std::string path;
  nlohmann::json json;
  std::vector<std::string> buffers;       ///< bytes of each buffer
  std::vector<std::string> buffer_views;  ///< decoded bytes of compressed views; empty: plain
  std::vector<std::string> warnings;

  /// The bytes of a buffer view.
  /// @throws Error for numbers and ranges out of bounds
  std::span<const char> view(std::size_t number) const;
};

/// Reads a .gltf or .glb file with its buffers.
/// @throws Error, naming the file; see import_gltf()
GltfFile read_gltf_file(const std::string& path);

/// The images of a file: names of files, or bytes of embedded ones.
/// @throws Error for images that have neither
std::vector<ModelImage> gltf_images(const GltfFile& file);

}  // namespace tessera::program
