// Tessellates a rectangular patch of a parametric surface. All built-in meshes consist of such patches.
#pragma once

#include <cstdint>

#include "engine/program/scene/mesh_data.h"

namespace tessera::program {

struct SurfacePoint {
  Vec3 position;
  Vec3 normal;  ///< outward, unit length
};

/// Appends (columns + 1) x (rows + 1) vertices with texture coordinates s and t, and the triangles between
/// them.
/// - Each quad is split along the diagonal from its corner of lowest s and t.
/// - Triangles with two corners at one position (a row that collapses into a pole) are left out.
/// - The front is where s grows to the right and t upwards.
/// @param surface  returns the point at (i, j): s = i / columns, t = j / rows
template <class Surface>
void append_patch(MeshData& mesh, int columns, int rows, const Surface& surface) {
  const auto base = static_cast<std::uint32_t>(mesh.vertex_count());
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const SurfacePoint point = surface(i, j);
      for (const double x : {point.position.x, point.position.y, point.position.z})
        mesh.positions.push_back(static_cast<float>(x));
      for (const double x : {point.normal.x, point.normal.y, point.normal.z})
        mesh.normals.push_back(static_cast<float>(x));
      mesh.texcoords.push_back(static_cast<float>(static_cast<double>(i) / columns));
      mesh.texcoords.push_back(static_cast<float>(static_cast<double>(j) / rows));
    }

  const auto same_place = [&](std::uint32_t a, std::uint32_t b) {
    const float* p = &mesh.positions[3 * std::size_t{a}];
    const float* q = &mesh.positions[3 * std::size_t{b}];
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
  };
  const auto append_triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (!same_place(a, b) && !same_place(b, c) && !same_place(c, a))
      mesh.indices.insert(mesh.indices.end(), {a, b, c});
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const std::uint32_t corner = base +
                                   static_cast<std::uint32_t>(j) * static_cast<std::uint32_t>(columns + 1) +
                                   static_cast<std::uint32_t>(i);
      const std::uint32_t above = corner + static_cast<std::uint32_t>(columns) + 1;
      append_triangle(corner, corner + 1, above + 1);
      append_triangle(corner, above + 1, above);
    }
}

}  // namespace tessera::program
