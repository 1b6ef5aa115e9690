// Generates missing normals of a model, and matches the winding of triangles to their normals.
#pragma once

#include <cstdint>
#include <span>

#include "engine/program/import/byte_stream.h"
#include "engine/program/import/model.h"

namespace tessera::program {

/// Edges sharper than this stay sharp in generated normals: an angle between the normals of two faces.
/// - It lies between those of common shapes, so that rounded coordinates do not decide: the sides of prisms
///   with 6, 7, 8 and 9 sides meet at 60, 51.4, 45 and 40 degrees, chamfered edges at 45, the faces of an
///   icosahedron at 41.8, those of a dodecahedron at 63.4.
constexpr double kCreaseDegrees = 48;

/// Fills in normals that are missing or of length 0. Indexed triangles only.
/// - The normal of a corner is the area-weighted mean over the triangles of its group at exactly the same
///   position. If they cancel out, it is the normal of its triangle.
/// - In group 0, only triangles count whose planes differ by at most the crease angle.
/// - Vertices between different normals are split.
/// - Time and memory grow with the number of corners; it takes about 8 bytes per corner besides the mesh.
/// @param groups  smoothing group of each triangle; empty: all are in group 0
void add_creased_normals(MeshData& mesh, double crease_degrees = kCreaseDegrees,
                         std::span<const std::uint32_t> groups = {}, const ReportProgress& progress = {});

/// Does so for the triangles of a model. Lines and points get normals of length 0.
void add_creased_normals(Model& model, double crease_degrees = kCreaseDegrees,
                         const ReportProgress& progress = {});

/// Winds triangles counter-clockwise when viewed from the side their normals point to, except those of parts
/// that are not double-sided: there the winding tells the faces apart.
void orient_by_normals(Model& model);

/// add_creased_normals() and orient_by_normals() for the triangles of a model. Its lines and points stay as
/// they are.
void complete_normals(Model& model, const ReportProgress& progress = {});

/// Whether a normal is of length 0 or not finite, and is therefore generated.
bool is_missing_normal(const float* normal);

}  // namespace tessera::program
