// The vertices of a draw for OpenGL: one per element of the mesh's index list, none shared, so that each face
// may have its own normal.
#pragma once

#include <array>
#include <vector>

#include "tests/reference/scene.h"

namespace tessera::mesa {

struct Vertex {
  std::array<double, 4> position;
  std::array<float, 3> normal;
  std::array<float, 4> color;
  std::array<double, 2> texcoord;
};

/// Meshes without normals get the face normal (flat shading) or the area-weighted mean of the faces with a
/// corner at the same position; points and lines have no faces and get null normals. Draws without vertex
/// colours get the material's diffuse colour, which unlit draws show.
std::vector<Vertex> vertex_list(const reference::Mesh& mesh, const reference::Draw& draw);

}  // namespace tessera::mesa
