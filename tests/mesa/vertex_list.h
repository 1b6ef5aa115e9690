// The vertices of a draw as OpenGL gets them: one for each number in the mesh's list, nothing shared, so that
// a face may have a normal of its own.
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

/// Meshes without normals get the face's (flat shading) or the area-weighted mean of the faces that meet at
/// the very same position; points and lines have no faces and get null normals. Draws without vertex colours
/// get the material's diffuse colour, which is what unlit ones show.
std::vector<Vertex> vertex_list(const reference::Mesh& mesh, const reference::Draw& draw);

}  // namespace tessera::mesa
