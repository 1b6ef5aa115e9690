// The parts that a scene file is read in; used by the readers only.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "engine/program/import/model.h"
#include "engine/program/scene/json_value.h"
#include "engine/program/scene/scene.h"

namespace tessera::program {

SceneCamera read_camera(const json::Value& value);
/// The camera of a scene that names none.
SceneCamera default_camera();

LightList read_lights(const json::Value& value);

/// Models, images and, with their samplers, textures that were read, by their paths.
struct ModelCache {
  std::map<std::string, Model> models;
  std::map<std::string, std::shared_ptr<const Picture>> pictures;
  std::map<std::string, std::shared_ptr<const Texture>>
      textures;                           // of those written in the scene, by their texels
  std::set<std::string> files;            // paths of all that was read, and of what models refer to
  std::function<bool()> should_continue;  ///< of reading one
};
/// Appends every mesh of the file's `meshes`, and what the importer warns of.
void read_meshes(const json::Value& value, const std::string& base_folder, ModelCache& models, Scene& scene);

/// Appends what a row of pixels is made of: whole bytes, two hexadecimal digits each.
void read_hexadecimal_row(const json::Value& value, std::size_t bytes, std::vector<std::uint8_t>& row);

/// Appends every texture of the file's `textures`. Returns their names.
std::vector<std::string> read_textures(const json::Value& value, const std::string& base_folder,
                                       ModelCache& cache, Scene& scene);

using Materials = std::map<std::string, Material, std::less<>>;
Materials read_materials(const json::Value& value);

Compare read_compare(const json::Value& value);
/// What the fragments of a draw go through: polygon offset, alpha test, stencil, blending, logic operation.
void read_operations(const json::Object& object, const FrameBufferFormat& format, DrawState& state);
/// The same with scissor, depth test and masks; a number for `depth` is no depth test.
void read_fragment_state(const json::Object& object, const Scene& scene, DrawState& state);

BitmapCommand read_bitmap(const json::Value& value, const Scene& scene);
ImageCommand read_image(const json::Value& value, const Scene& scene, const std::string& base_folder,
                        ModelCache& cache);

/// @param scene  all but the frame has been read.
/// @param textures  their names
std::vector<SceneCommand> read_frame(const json::Value& value, const Scene& scene, const Materials& materials,
                                     const std::vector<std::string>& textures, const std::string& base_folder,
                                     ModelCache& cache);
/// One clear of what there is and one draw of every mesh.
std::vector<SceneCommand> default_frame(const Scene& scene);

}  // namespace tessera::program
