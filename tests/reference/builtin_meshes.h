// The built-in meshes by their definitions: y up, wound counter-clockwise as viewed from outside, with
// outward unit normals.
#pragma once

#include <string>

#include "scene.h"

namespace tessera::reference {

/// @param name    teapot | sphere | torus | cube | cylinder | cone | quad | grid
/// @param detail  subdivisions, at least 1
/// @throws std::runtime_error for any other name or detail, or if the teapot's patches cannot be read.
Mesh builtin_mesh(const std::string& name, int detail);

/// Sets the file of the teapot's patches. Default: the macro TESSERA_TEAPOT_PATCHES.
void set_teapot_patches(const std::string& path);
/// Sets the content of that file instead.
void set_teapot_patches_text(const std::string& text);

/// The 32 bicubic patches at detail x detail quads each.
Mesh teapot_mesh(int detail);

/// Vertex of a patch of quads.
struct SurfacePoint {
  Vec3 position;
  Vec3 normal;
};

/// Appends a patch of columns x rows quads, each split along the diagonal from its corner with the lowest s
/// and t. Triangles without area (at a collapsed row) are omitted.
///
/// @param surface  called with (s, t), s = i / columns, t = j / rows; counter-clockwise if s grows to the
///     right and t upwards.
template <class Surface>
void append_quads(Mesh& mesh, int columns, int rows, const Surface& surface) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const SurfacePoint point = surface(static_cast<double>(i) / columns, static_cast<double>(j) / rows);
      mesh.positions.push_back({point.position.x, point.position.y, point.position.z, 1});
      mesh.normals.push_back(point.normal);
      mesh.texcoords.push_back({static_cast<double>(i) / columns, static_cast<double>(j) / rows});
    }
  const auto corner = [&](int i, int j) { return base + static_cast<std::uint32_t>(j * (columns + 1) + i); };
  const auto append_triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Vec3 pa = xyz(mesh.positions[a]);
    const Vec3 pb = xyz(mesh.positions[b]);
    const Vec3 pc = xyz(mesh.positions[c]);
    constexpr double kNoArea = 1e-14;
    if (length(cross(pb - pa, pc - pa)) > kNoArea) mesh.indices.insert(mesh.indices.end(), {a, b, c});
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      append_triangle(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1));
      append_triangle(corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
    }
}

}  // namespace tessera::reference
