// Normals of meshes that have none.
#pragma once

#include <vector>

#include "engine/mesh_arrays.h"

namespace tessera {

/// For each vertex the area-weighted mean over the faces that have a vertex at the very same position, unit length (or 0),
/// in object space; 3 floats each.
std::vector<float> smooth_normals(const MeshArrays& mesh);
/// For each triangle its face's normal, unit length (or 0), in object space; 3 floats each.
std::vector<float> face_normals(const MeshArrays& mesh);

}  // namespace tessera
