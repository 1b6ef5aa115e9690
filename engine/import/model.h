// Models from files: today Wavefront OBJ with its MTL materials.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/scene/mesh_data.h"

namespace tessera {

/// The triangles of one material: a range of the mesh's indices.
struct ModelPart {
  std::string material_name;             ///< empty: the file names none
  Material material;
  std::size_t first_index = 0, index_count = 0;
};

struct Model {
  MeshData mesh;                         ///< all parts, indexed; normals and colours if the file has them at every corner
  std::vector<ModelPart> parts;          ///< in the order of first use; never empty
  std::vector<std::string> warnings;     ///< a material file that is missing, ...; one line each
};

/// By the file's ending.
bool is_model_file(const std::string& path);

/// @throws Error, naming the file and where possible the line, for a file that is missing, broken or without a triangle.
Model import_model(const std::string& path);

/// One part as a mesh of its own, without the vertices of the others.
MeshData part_mesh(const Model& model, std::size_t part);

/// Fills in normals: the area-weighted mean over the faces whose vertices have the very same position. The parts of a model
/// then stay smooth across their seams, which normals made for each draw could not know of.
void add_smooth_normals(MeshData& mesh);

}  // namespace tessera
