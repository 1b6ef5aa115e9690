// The built-in meshes of the scene format: y up, wound counter-clockwise seen from outside, with outward unit
// normals.
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
/// @throws Error for any other name or detail.
MeshData builtin_mesh(std::string_view name, int detail = kDefaultMeshDetail);

/// A sphere or a torus needs 2: with 1 no triangle of it has an area.
int min_mesh_detail(std::string_view name);

/// Martin Newell's teapot at detail x detail quads a patch, centred in the bounds of its vertices; the
/// longest side spans -1..1.
MeshData teapot_mesh(int detail);

}  // namespace tessera::program
