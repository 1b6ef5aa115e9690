// Writers of the parts of a scene file.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/program/scene/json_value.h"
#include "engine/program/scene/scene.h"

namespace tessera::program {

json::Json numbers_json(std::span<const float> numbers);
json::Json color_json(const Color& color);
json::Json material_json(const Material& material);

/// Writes the textures of a scene as PNG files, one per picture.
/// @param path  of the scene file
/// @return the objects of the scene file's `textures`
/// @throws Error
std::vector<json::Json> write_textures(const Scene& scene, const std::string& path);

/// Returns a mesh with the vertices and attributes that a draw uses; nothing if it draws nothing.
/// @throws Error as write_scene()
std::optional<json::Json> mesh_json(const DrawCommand& draw, const Scene& scene);

/// Members of an object, with unique names.
class NamedList {
 public:
  /// @param name  a number is appended if another member has it
  /// @return the name of the member
  std::string add(const std::string& name, json::Json value);
  /// Returns the object; this list is empty afterwards.
  json::Json take();

 private:
  std::vector<std::pair<std::string, json::Json>> members_;
  std::set<std::string> names_;
  std::map<std::string, int> last_number_;  // numbers appended to the given names
};

/// Meshes, materials and frame of a scene file.
class DrawWriter {
 public:
  /// @param textures  objects of write_textures()
  DrawWriter(const Scene& scene, const std::vector<json::Json>& textures);

  void add(const Clear& clear);
  void add(const DrawCommand& draw);
  /// Adds textures, materials, meshes and frame to a scene file, and leaves this writer empty.
  void move_to(json::Json& file);

 private:
  std::string material_name(const DrawCommand& draw);

  const Scene& scene_;
  NamedList textures_, materials_, meshes_;
  std::map<const Texture*, std::string> texture_names_;
  std::map<std::string, std::string> names_of_materials_;  // by their text
  json::Json frame_ = json::Json::array();
};

}  // namespace tessera::program
