// Normals that a model lacks, and triangles that are wound against theirs.
#pragma once

#include "engine/program/scene/mesh_data.h"

namespace tessera::program {

/// Edges that are sharper stay sharp, where normals have to be made.
constexpr double kCreaseDegrees = 60;

/// Fills in normals that are missing or of length 0: at each corner of a triangle, the mean, weighted by
/// area, over the triangles at the very same position whose planes are within an angle. Vertices on creases
/// are split. Indexed meshes.
void add_creased_normals(MeshData& mesh, double crease_degrees = kCreaseDegrees);

/// Winds triangles counter-clockwise seen from where their normals point.
void orient_by_normals(MeshData& mesh);

}  // namespace tessera::program
