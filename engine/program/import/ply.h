// Reads PLY models, binary and text.
#pragma once

#include <string>

#include "engine/program/import/byte_stream.h"
#include "engine/program/import/model.h"

namespace tessera::program {

class ModelFile;

/// Reads a model in the calling process, without limits of time and memory; import_model() runs it in a child
/// process.
/// - One part: triangles of the elements `face` and `tristrips`; if there are none, lines of the element
///   `edge`; if there are none, a point for each vertex whose position is finite.
/// - Vertices have normals (nx ny nz), colors (red green blue alpha; r g b a; diffuse_red ...; integers of
///   their full range, those of 32 bits levels of 255, or floats) and texture coordinates (s t; u v;
///   texture_u texture_v), if the file gives them.
/// - Colors of faces replace those of vertices, and texture coordinates of faces' corners likewise.
/// - Other elements and properties are skipped.
/// - Lines and points without normals are unlit.
/// - For ModelUse::mesh, missing normals of triangles are generated.
/// @throws Error, naming the file and the line or byte, for a file that is missing or malformed, or that
///   holds no vertex
Model import_ply(const std::string& path, ModelUse use, const ReportProgress& progress = {});

/// import_ply() for an open file.
Model read_ply(ModelFile& file, ModelUse use, const ReportProgress& progress = {});

}  // namespace tessera::program
