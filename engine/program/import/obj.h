// Reads Wavefront OBJ models and their MTL materials.
#pragma once

#include <string>

#include "engine/program/import/byte_stream.h"
#include "engine/program/import/model.h"

namespace tessera::program {

/// Reads a model in the calling process, without limits of time and memory; import_model() runs it in a child
/// process.
/// - One part per material and primitive: first triangles, then lines, then points, each in the order of
///   first use. Lines and points are unlit.
/// - Corners with the same position, normal and texture coordinates share a vertex.
/// - Corners without a normal, or with one of length 0, get a generated one: that of the face where smoothing
///   is off, else the mean within the smoothing group. In files without smoothing groups, edges sharper than
///   kCreaseDegrees stay sharp.
/// - Corners without texture coordinates get 0, 0 if others have some.
/// - Vertex colours are factors of Kd.
/// - Images are named, not decoded.
/// - Missing material files and unsupported properties become warnings.
///
/// For ModelUse::mesh:
/// - Triangles only, with the texture coordinates and vertex colours of the file.
/// - No normals if the file has none, so that each draw generates those that its shading needs.
///
/// For ModelUse::display:
/// - Every corner of a triangle has a normal.
/// - Models that are far from the origin for their size are moved to it (Model::origin).
/// - A file of vertices alone is a point cloud.
///
/// @throws Error, naming the file and if possible the line, for a file that is missing, malformed, or without
///   anything to draw
Model import_obj(const std::string& path, ModelUse use, const ReportProgress& progress = {});

}  // namespace tessera::program
