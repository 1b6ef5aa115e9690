// Normals of meshes that bring none: the face's for flat shading, the area-weighted mean for Gouraud and
// Phong. A face is a whole polygon, however it splits; points and lines have no faces and so no normals but
// null ones.
#pragma once

#include <cstddef>
#include <vector>

#include "scene.h"

namespace tessera::reference {

/// Unit normal of a polygon of the mesh, counter-clockwise side, object space: the sum over its triangles,
/// each as long as its area. The null vector for a degenerate polygon.
Vec3 face_normal(const Mesh& mesh, std::size_t primitive);

/// For each position the unit area-weighted mean of the normals of all faces that have a corner at the very
/// same position (coordinates compare equal as doubles), whatever index that corner has.
std::vector<Vec3> mean_face_normals(const Mesh& mesh);

}  // namespace tessera::reference
