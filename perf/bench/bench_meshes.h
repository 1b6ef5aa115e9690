// The meshes of the workloads: grids that fill the window, and spheres.
#pragma once

#include <span>

#include "engine/program/scene/mesh_data.h"

namespace tessera::bench {
using namespace program;

/// columns * rows squares of two triangles each, from -1 to 1 in x and y: in clip space the whole window.
/// Colours run across it, texture coordinates from 0 to `texture_repeats`.
///
/// @param depth   of all vertices, -1 .. 1
/// @param waves   how far depths leave that
MeshData window_grid(int columns, int rows, float depth = 0, float waves = 0, float texture_repeats = 1);

/// 2 * columns * rows triangles (those at the poles without an area), counter-clockwise from outside, with
/// unit normals.
MeshData sphere(int columns, int rows, float radius);

/// Indexed meshes of the same attributes as one.
MeshData merged(std::span<const MeshData> meshes);

}  // namespace tessera::bench
