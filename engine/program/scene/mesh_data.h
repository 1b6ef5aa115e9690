// A mesh that owns its numbers; tessera::Mesh borrows them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {

struct MeshData {
  std::string name;
  Primitive primitive = Primitive::triangles;
  std::vector<float> positions;  ///< x y z, or x y z w with position_components 4
  int position_components = 3;
  std::vector<float> normals;          ///< x y z for each vertex, or empty
  std::vector<float> colors;           ///< r g b a for each vertex, or empty
  std::vector<std::uint32_t> indices;  ///< of vertices, in the primitives' order; empty: vertices in order
  std::vector<float> color_indices;    ///< one for each vertex, or empty
  std::vector<float> texcoords;        ///< s t for each vertex, or empty

  std::size_t vertex_count() const {
    return positions.size() / static_cast<std::size_t>(position_components);
  }
  /// Those that its primitives are split into; of meshes of points and lines those.
  std::size_t triangle_count() const {
    return element_count(primitive, indices.empty() ? vertex_count() : indices.size());
  }
  /// Valid while this object lives and is not changed.
  Mesh view() const {
    return {.primitive = primitive,
            .positions = positions,
            .position_components = position_components,
            .normals = normals,
            .colors = colors,
            .indices = indices,
            .color_indices = color_indices,
            .texcoords = texcoords};
  }
};

}  // namespace tessera::program
