// Meshes of the workloads: full-window grids and spheres.
#pragma once

#include <span>

#include "engine/program/scene/mesh_data.h"

namespace tessera::bench {
using namespace program;

/// Grid of columns x rows squares, two triangles each, over the whole window: -1 to 1 in clip space.
/// - Colours run from 0 to 1 across the window, texture coordinates from 0 to `texture_repeats`.
///
/// @param depth  z of all vertices, -1 to 1
/// @param waves  amplitude of a wave added to z
MeshData window_grid(int columns, int rows, float depth = 0, float waves = 0, float texture_repeats = 1);

/// 2 * columns * rows triangles with unit normals, counter-clockwise from outside. In each square at a pole,
/// one triangle is degenerate.
MeshData sphere(int columns, int rows, float radius);

/// Concatenates indexed meshes that have the same attributes.
MeshData merged(std::span<const MeshData> meshes);

}  // namespace tessera::bench
