// The built-in meshes of the scene format: y up, counter-clockwise as viewed from outside, with outward unit
// normals and texture coordinates.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "engine/program/scene/mesh_data.h"

namespace tessera::program {

inline constexpr int kMaxMeshDetail = 1024;
inline constexpr int kDefaultMeshDetail = 16;

inline constexpr std::array<std::string_view, 8> kBuiltinMeshNames{"teapot",   "sphere", "torus", "cube",
                                                                   "cylinder", "cone",   "quad",  "grid"};

/// @param name    one of kBuiltinMeshNames
/// @param detail  subdivisions: min_mesh_detail(name) .. kMaxMeshDetail
/// @throws Error for any other name or detail
MeshData builtin_mesh(std::string_view name, int detail = kDefaultMeshDetail);

/// Returns the lowest detail of a mesh: 2 for a sphere or a torus, whose triangles have no area with 1;
/// else 1.
int min_mesh_detail(std::string_view name);

/// Returns Martin Newell's teapot with detail x detail quads per patch, centred in the bounds of its
/// vertices; the longest side spans -1..1.
MeshData teapot_mesh(int detail);

}  // namespace tessera::program
