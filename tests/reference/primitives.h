// Primitive assembly: the vertices of each point, line or polygon of a mesh, and its provoking vertex.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene.h"

namespace tessera::reference {

/// One vertex: a point. Two: a line. More: a polygon in winding order, split into the fan around its first
/// vertex.
struct Primitive {
  std::vector<std::uint32_t> vertices;  ///< indices into Mesh::positions
  std::size_t provoking = 0;            ///< index into `vertices`
};

/// Describes the permitted vertex counts for a list of this type; empty if `vertices` is valid. An empty list
/// is always valid and draws nothing.
std::string wrong_vertex_count(PrimitiveType type, std::size_t vertices);

/// @pre the mesh's number of indices is valid.
std::size_t primitive_count(const Mesh& mesh);
Primitive primitive(const Mesh& mesh, std::size_t index, ProvokingVertex convention);

}  // namespace tessera::reference
