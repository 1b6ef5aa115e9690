// Normals of meshes that bring none: the face's for flat shading, the area-weighted mean for Gouraud and Phong.
#pragma once

#include <cstddef>
#include <vector>

#include "scene.h"

namespace tessera::reference {

/// The corners of a triangle in object space, divided by their w.
std::array<Vec3, 3> triangle_corners(const Mesh& mesh, std::size_t triangle);

/// Unit normal of a triangle, counter-clockwise side, object space; the null vector for a degenerate triangle.
Vec3 face_normal(const Mesh& mesh, std::size_t triangle);

/// For each position the unit area-weighted mean of the normals of all faces that have a corner at the very same position
/// (coordinates compare equal as doubles), whatever index that corner has.
std::vector<Vec3> mean_face_normals(const Mesh& mesh);

}  // namespace tessera::reference
