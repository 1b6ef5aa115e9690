// Readers of the parts of a scene file.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/program/import/model.h"
#include "engine/program/scene/file_model.h"
#include "engine/program/scene/json_value.h"
#include "engine/program/scene/scene.h"

namespace tessera::program {

Quality read_quality(const json::Value& value);

/// Contents of files, so that an animation reads each file once.
struct FileCache {
  std::map<std::string, FileModel> models;                         ///< by path
  std::map<std::string, FileMesh> meshes;                          ///< by path
  std::map<std::string, std::shared_ptr<const Picture>> pictures;  ///< by path
  /// By path, or by JSON text if the texels are in the scene; and by sampler.
  std::map<std::string, std::shared_ptr<const Texture>> textures;
  ImportOptions import;  ///< for models
};
/// Names of meshes, by how the frame draws them. A mesh may be in both sets.
struct MeshUses {
  std::set<std::string> alone;           ///< in draws with a material, or with shadow_on
  std::set<std::string> with_materials;  ///< in draws that use the materials of a model file
};
/// @param frame  empty: the default frame, which draws all meshes with their materials
MeshUses mesh_uses(const std::optional<json::Value>& frame, const std::vector<std::string>& meshes);

/// Draws of the parts of meshes that come from files, by the mesh's index.
using FileDraws = std::map<std::size_t, std::vector<DrawCommand>>;
/// Appends every mesh of the file's `meshes`, then the further parts of those from files with their textures,
/// and the importer's warnings.
FileDraws read_meshes(const json::Value& value, const MeshUses& uses, const std::string& base_folder,
                      FileCache& cache, Scene& scene);

/// @param aspect  of the picture, for cameras of model files
SceneCamera read_camera(const json::Value& value, const std::string& base_folder, double aspect,
                        FileCache& cache);
/// Returns the camera of a scene without one.
SceneCamera default_camera();

LightList read_lights(const json::Value& value, const std::string& base_folder, FileCache& cache);

/// Appends a row of pixels given as whole bytes of two hexadecimal digits.
void read_hexadecimal_row(const json::Value& value, std::size_t bytes, std::vector<std::uint8_t>& row);

/// Appends every texture of the file's `textures`.
/// @return their names
std::vector<std::string> read_textures(const json::Value& value, const std::string& base_folder,
                                       FileCache& cache, Scene& scene);

using Materials = std::map<std::string, Material, std::less<>>;
Materials read_materials(const json::Value& value);

inline constexpr std::int64_t kMaxUint32 = std::numeric_limits<std::uint32_t>::max();

/// Reads four of true and false, for red, green, blue and alpha.
std::array<bool, 4> read_color_mask(const json::Value& value, const FrameBufferFormat& format);

/// Reads polygon offset, alpha test, stencil, blending and logic operation.
void read_operations(const json::Object& object, const FrameBufferFormat& format, DrawState& state);
/// Reads the values of read_operations(), and scissor, depth test and masks. A number for `depth` is ignored:
/// it is the depth of a bitmap or an image.
void read_fragment_state(const json::Object& object, const Scene& scene, DrawState& state);

BitmapCommand read_bitmap(const json::Value& value, const Scene& scene);
ImageCommand read_image(const json::Value& value, const Scene& scene, const std::string& base_folder,
                        FileCache& cache);

/// Objects that the commands of a frame refer to.
struct FrameNames {
  std::vector<std::string> meshes;    ///< names of the first of scene.meshes
  std::vector<std::string> textures;  ///< names of the first of scene.textures
  Materials materials;
  FileDraws file_draws;
};
/// @param scene  the scene without its frame
std::vector<SceneCommand> read_frame(const json::Value& value, const Scene& scene, const FrameNames& names,
                                     const std::string& base_folder, FileCache& cache);
/// Returns a clear of all buffers and a draw of every named mesh.
std::vector<SceneCommand> default_frame(const Scene& scene, const FrameNames& names);

}  // namespace tessera::program
