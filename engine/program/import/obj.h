// Reads Wavefront OBJ models and their MTL materials.
#pragma once

#include <string>

#include "engine/program/import/model.h"

namespace tessera::program {

/// Reads a model in the calling process, without limits of time and memory; import_model() runs it in a child
/// process.
/// - The mesh has one part per material, in the order of first use.
/// - Corners with the same position, normal and texture coordinates share a vertex.
/// - Normals and texture coordinates are used only if every corner has them.
/// - Missing material files and unsupported properties become warnings.
/// @throws Error, naming the file and if possible the line, for a file that is missing, malformed or without
///   triangles
Model import_obj(const std::string& path);

}  // namespace tessera::program
