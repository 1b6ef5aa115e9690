// Materials of OBJ models: finds MTL files, and turns their materials into those of the engine.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/program/import/model.h"
#include "engine/program/import/mtl_file.h"
#include "engine/program/import/obj_file.h"

namespace tessera::program {

/// A material of an OBJ model, for the parts of the model.
struct ObjMaterial {
  std::string name;
  Material material;
  std::optional<std::size_t> texture;  ///< index into Model::textures
  std::array<float, 2> texcoord_scale{1, 1};
  std::array<float, 2> texcoord_offset{0, 0};
  ModelAlpha alpha = ModelAlpha::opaque;
};

/// Reads the material files that an OBJ file names, and converts the materials that it uses.
/// - Adds images, textures and warnings to the model, at most 20 warnings.
/// @param path  the OBJ file; material files are relative to its folder
/// @return for each of ObjFile::material_names; absent: no material file defines it
/// @throws Error with file and line for a malformed material file; a missing one is a warning
std::vector<std::optional<ObjMaterial>> obj_materials(const ObjFile& file, const std::string& path,
                                                      Model& model);

/// The opacity of a material.
/// - `d` decides if it is given. Otherwise it is 1 - Tr by the format; but MeshLab and others write d as Tr.
/// - Tr is d if, of the file's materials without d, some have Tr 1 and none has Tr 0: by the format, parts of
///   the model would be invisible and none opaque.
/// @param file  all materials of the MTL file
float alpha_of(const MtlMaterial& material, const std::vector<MtlMaterial>& file);

/// The engine's material. What the file does not give:
/// - Kd: white with map_Kd, else Material's default. Black with map_Kd is also white.
/// - Ka: the diffuse colour.
/// - Ks: black, as with an illum below 2. Without Ns, or with Ns 0, there is no highlight either: it would
///   cover the whole material.
Material material_of(const MtlMaterial& from, float alpha);

/// Two possible meanings of the name of a material file:
/// - backslashes separate folders, as on Windows, except before spaces;
/// - every backslash escapes the next character.
std::array<std::string, 2> possible_paths(const std::string& name);

}  // namespace tessera::program
