// Facts about the vertex data of a mesh. Scans end at the first vertex that lacks the property, so that
// meshes without it cost next to nothing.
//
// Vertices with a value that is not finite are dropped if their draw reads the value. A fact that makes a
// draw ignore an attribute therefore requires that all of its values are finite.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "engine/record/mesh_arrays.h"

namespace tessera::detail {

/// r g b a of all vertices, if they are equal and finite. @pre the mesh has vertices and colours
std::optional<std::array<float, 4>> equal_color(const MeshArrays& mesh);

/// Alpha of all vertices, if it is equal and all colours are finite. @pre the mesh has vertices and colours
std::optional<float> equal_alpha(const MeshArrays& mesh);

/// x y z of all normals, if they are equal and finite. @pre the mesh has vertices and normals
std::optional<std::array<float, 3>> equal_normal(const MeshArrays& mesh);

}  // namespace tessera::detail
