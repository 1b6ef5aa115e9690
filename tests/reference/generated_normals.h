// Generated normals for meshes without normals: the face normal for flat shading, the area-weighted mean for
// Gouraud and Phong. A face is a whole polygon, however it is split. Points and lines have no faces; their
// normals are null.
#pragma once

#include <cstddef>
#include <vector>

#include "scene.h"

namespace tessera::reference {

/// Unit normal of the counter-clockwise side of a polygon in object space: the normalized sum of its
/// triangles' area normals. Null for a degenerate polygon.
Vec3 face_normal(const Mesh& mesh, std::size_t primitive);

/// Per position: unit area-weighted mean of the normals of all faces with a corner at that exact position
/// (coordinates compare equal as doubles), whatever the corner's index.
std::vector<Vec3> mean_face_normals(const Mesh& mesh);

}  // namespace tessera::reference
