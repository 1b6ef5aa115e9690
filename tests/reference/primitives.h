// Primitive assembly: which vertices make up each point, line or polygon of a mesh, and which of them decides
// flat colours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene.h"

namespace tessera::reference {

/// One vertex: a point; two: a line; more: a polygon in winding order, which splits into the fan around its
/// first vertex.
struct Primitive {
  std::vector<std::uint32_t> vertices;  ///< numbers of Mesh::positions
  std::size_t provoking = 0;            ///< place in `vertices`
};

/// How many vertices a list of this type may have, in words; empty if `vertices` is such a number.
/// None at all is always allowed and draws nothing.
std::string wrong_vertex_count(PrimitiveType type, std::size_t vertices);

/// @pre the mesh's number of indices is right.
std::size_t primitive_count(const Mesh& mesh);
Primitive primitive(const Mesh& mesh, std::size_t index, ProvokingVertex convention);

}  // namespace tessera::reference
