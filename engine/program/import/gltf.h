// Reads glTF 2 models.
#pragma once

#include <string>

#include "engine/program/import/byte_stream.h"
#include "engine/program/import/model.h"

namespace tessera::program {

/// Reads a .gltf or .glb file in the calling process; import_model() runs it in a child process.
/// - The default scene, or all root nodes, in world space. Joints pose skins, and default weights morph
///   targets.
/// - Coordinates and transforms are double until the origin of models far away is subtracted.
/// - Colour factors and vertex colours are linear in glTF. The curve of sRGB makes their product
///   display-referred, as texels are: 0.2159 becomes 128 of 255.
/// - Missing normals are flat, as glTF specifies.
/// - Draco and meshopt compression are decoded. Unsupported extensions of materials become warnings.
/// @throws Error, naming the file, for files that are empty, broken, of version 1, or that require an
///   extension that is not supported
Model import_gltf(const std::string& path, const ReportProgress& progress = {});

}  // namespace tessera::program
