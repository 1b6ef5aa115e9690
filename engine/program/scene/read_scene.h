// Readers of the parts of a scene file.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/program/import/model.h"
#include "engine/program/scene/json_value.h"
#include "engine/program/scene/scene.h"

namespace tessera::program {

SceneCamera read_camera(const json::Value& value);
/// Returns the camera of a scene without one.
SceneCamera default_camera();

LightList read_lights(const json::Value& value);
Quality read_quality(const json::Value& value);

/// Contents of files, so that an animation reads each file once.
struct FileCache {
  std::map<std::string, Model> models;                             ///< by path
  std::map<std::string, std::shared_ptr<const Picture>> pictures;  ///< by path
  /// By path, or by JSON text if the texels are in the scene; and by sampler.
  std::map<std::string, std::shared_ptr<const Texture>> textures;
  ImportOptions import;  ///< for models
};
/// Appends every mesh of the file's `meshes`, and the importer's warnings.
void read_meshes(const json::Value& value, const std::string& base_folder, FileCache& models, Scene& scene);

/// Appends a row of pixels given as whole bytes of two hexadecimal digits.
void read_hexadecimal_row(const json::Value& value, std::size_t bytes, std::vector<std::uint8_t>& row);

/// Appends every texture of the file's `textures`.
/// @return their names
std::vector<std::string> read_textures(const json::Value& value, const std::string& base_folder,
                                       FileCache& cache, Scene& scene);

using Materials = std::map<std::string, Material, std::less<>>;
Materials read_materials(const json::Value& value);

/// Reads polygon offset, alpha test, stencil, blending and logic operation.
void read_operations(const json::Object& object, const FrameBufferFormat& format, DrawState& state);
/// Reads the values of read_operations(), and scissor, depth test and masks. A number for `depth` is ignored:
/// it is the depth of a bitmap or an image.
void read_fragment_state(const json::Object& object, const Scene& scene, DrawState& state);

BitmapCommand read_bitmap(const json::Value& value, const Scene& scene);
ImageCommand read_image(const json::Value& value, const Scene& scene, const std::string& base_folder,
                        FileCache& cache);

/// @param scene  the scene without its frame
/// @param textures  names of scene.textures
std::vector<SceneCommand> read_frame(const json::Value& value, const Scene& scene, const Materials& materials,
                                     const std::vector<std::string>& textures, const std::string& base_folder,
                                     FileCache& cache);
/// Returns a clear of all buffers and a draw of every mesh.
std::vector<SceneCommand> default_frame(const Scene& scene);

}  // namespace tessera::program
