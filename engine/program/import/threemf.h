// Reads 3MF models.
#pragma once

#include <string>

#include "engine/program/import/byte_stream.h"
#include "engine/program/import/model.h"
#include "engine/program/import/threemf_package.h"

namespace tessera::program {

/// Reads a .3mf file in the calling process: the items of its build, in world space. Units are not scaled.
/// - Read are the core specification, the materials extension (colours, textures, composites and the first
///   layer of multiple properties) and the production extension (several model parts).
/// - Without properties, triangles have the default material. Normals are missing: 3MF has none.
/// - Properties that are not defined, and images that are missing, become warnings.
/// @throws Error, without the file's name, for files that are broken or hold no triangle
Model read_threemf(const std::string& path, const ReportProgress& progress = {});

/// read_threemf() for the parts of a package.
Model read_threemf_parts(const threemf::ReadPart& read, const ReportProgress& progress = {});

}  // namespace tessera::program
