// Models that a scene file names: their draws, camera and lights.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/program/import/model.h"
#include "engine/program/scene/json_value.h"
#include "engine/program/scene/scene.h"

namespace tessera::program {

/// A model, split into what its draws use.
struct FileModel {
  Model model;  ///< for display; without the pixels of its images
  std::vector<std::shared_ptr<const Texture>> textures;
  std::vector<MeshData> meshes;  ///< one per part
  /// One per part, in the coordinates of the file: parts that blend come last. `mesh` is an index into
  /// `meshes`.
  std::vector<DrawCommand> draws;
};

/// The mesh of a model file alone.
struct FileMesh {
  MeshData mesh;
  std::vector<std::string> warnings;
};

struct FileCache;

/// Returns the model of a file, read once per scene file.
/// @param file  the path, relative to the folder
/// @throws Error, naming the JSON pointer
const FileModel& file_model(const json::Value& file, const std::string& base_folder, FileCache& cache);

/// Returns the mesh of a file alone, in the coordinates of the file: its triangles, or its lines or points if
/// it has no triangle. Meshes without normals get those that each draw generates.
/// @throws Error, naming the JSON pointer
const FileMesh& file_mesh(const json::Value& file, const std::string& base_folder, FileCache& cache);

/// Returns the camera of a model file, in the coordinates of the file.
/// @throws Error, naming the JSON pointer, if no camera of the file shows the model
SceneCamera file_camera(const json::Value& file, const std::string& base_folder, double aspect,
                        FileCache& cache);

/// Returns the lights of a model file, in the coordinates of the file.
/// @throws Error, naming the JSON pointer, if the file has none
LightList file_lights(const json::Value& file, const std::string& base_folder, FileCache& cache);

/// Values that a draw of the scene states itself; they outrank those of the file.
struct GivenState {
  bool texture = false, lighting = false, color_material = false, cull = false, depth = false,
       alpha_test = false, blend = false;
};

/// Combines a draw of the scene with a draw of the file.
/// @param can_blend  false for index buffers, which neither blend nor test alpha
DrawCommand with_file_state(const DrawCommand& draw, const DrawCommand& of_file, const GivenState& given,
                            bool can_blend);

}  // namespace tessera::program
