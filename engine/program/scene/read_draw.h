// Names that draws refer to, and the reading of draws.
#pragma once

#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/program/scene/read_scene.h"

namespace tessera::program {

/// Names in the order of the scene, and their indices.
struct NameList {
  std::vector<std::string_view> names{};
  std::unordered_map<std::string_view, std::size_t> index_of{};

  void add(std::string_view name) {
    index_of.emplace(name, names.size());
    names.push_back(name);
  }
};

/// The objects that commands of a frame refer to.
struct FrameObjects {
  NameList meshes{};
  NameList materials{};
  NameList textures{};
  const FrameNames& defined;
  const Scene& scene;
  LightList lights;  ///< current lights
};

/// Reads a draw: of a mesh from a file without a material, the draws of its parts.
std::vector<Command> read_draw(const json::Value& value, const FrameObjects& objects);

}  // namespace tessera::program
