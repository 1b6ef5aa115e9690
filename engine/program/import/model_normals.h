// Generates missing normals of a model, and matches the winding of triangles to their normals.
#pragma once

#include "engine/program/import/model.h"

namespace tessera::program {

/// Edges sharper than this stay sharp in generated normals.
constexpr double kCreaseDegrees = 60;

/// Fills in normals that are missing or of length 0. Indexed meshes only.
/// - The normal of a corner is the area-weighted mean over the triangles at exactly the same position whose
///   planes differ by at most the crease angle.
/// - Vertices on creases are split.
void add_creased_normals(MeshData& mesh, double crease_degrees = kCreaseDegrees);

/// Does so for the triangles of a model. Lines and points get normals of length 0.
void add_creased_normals(Model& model, double crease_degrees = kCreaseDegrees);

/// Winds triangles counter-clockwise when viewed from the side their normals point to, except those of parts
/// that are not double-sided: there the winding tells the faces apart.
void orient_by_normals(Model& model);

}  // namespace tessera::program
