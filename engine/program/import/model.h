// Models from files: Wavefront OBJ with its MTL materials by tinyobjloader, everything else by assimp, in a
// child process.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/program/scene/mesh_data.h"

namespace tessera::program {

/// The triangles of one material: a range of the mesh's indices.
struct ModelPart {
  std::string material_name;  ///< empty: the file names none
  Material material;
  std::size_t first_index = 0, index_count = 0;
  bool uses_colors = false;  ///< of the vertices, in place of ambient and diffuse
};

/// A camera that a file brings along, for any size of the picture.
struct ModelCamera {
  Matrix view;
  bool is_orthographic = false;
  double half_width = 0, half_height = 0;  ///< of what it sees: world units, for a perspective at distance 1;
                                           ///< one may be 0: as the picture's aspect asks
  double near = 0, far = 0;                ///< 0: the file does not say
};

struct Model {
  MeshData mesh;                 ///< all parts, indexed; colours and texture coordinates if the file has some
  std::vector<ModelPart> parts;  ///< in the order of first use; never empty
  std::vector<std::string> warnings;  ///< a material file that is missing, ...; one line each
  std::vector<std::string> files;  ///< where those may be that it refers to (materials, buffers, textures),
                                   ///< as far as the importers understand it
  std::vector<ModelCamera> cameras;
  std::vector<Light> lights;  ///< world space
  std::optional<Color> ambient_light;
};

enum class ModelUse {
  mesh,    ///< as it is: OBJ files may lack normals, and be wound as they like
  display  ///< every corner gets a normal, and triangles are wound by theirs (model_normals.h)
};

/// Reads a model in a child process that may take 10 seconds and 1 GiB, and return 256 MiB. It is a fork of
/// this one: call it before other threads run.
/// @param should_continue  asked a few times a second; false ends the reading
/// @throws Error, naming the file and where possible the line, for a file that is missing, broken or without
/// a triangle, and for one that takes too long or too much; Cancelled if it was ended.
Model import_model(const std::string& path, ModelUse use = ModelUse::mesh,
                   const std::function<bool()>& should_continue = {});

/// The endings of the formats that are read, in lower case with their dots. @throws Error without the import
/// module.
std::vector<std::string> model_extensions();

/// Each part as a mesh of its own, without the vertices of the others.
std::vector<MeshData> split_into_parts(Model model);

}  // namespace tessera::program
