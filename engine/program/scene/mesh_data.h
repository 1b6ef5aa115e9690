// A mesh that owns its arrays; tessera::Mesh borrows them.
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
  std::vector<float> positions;        ///< per vertex x y z, or x y z w with position_components 4
  int position_components = 3;         ///< 3 or 4
  std::vector<float> normals;          ///< per vertex x y z, or empty
  std::vector<float> colors;           ///< per vertex r g b a, or empty
  std::vector<std::uint32_t> indices;  ///< vertex indices; empty: vertices in order
  std::vector<float> color_indices;    ///< per vertex, or empty
  std::vector<float> texcoords;        ///< per vertex s t, or empty

  std::size_t vertex_count() const {
    return positions.size() / static_cast<std::size_t>(position_components);
  }
  /// Number of triangles that the primitives are split into; for points and lines, the number of these.
  std::size_t triangle_count() const {
    return element_count(primitive, indices.empty() ? vertex_count() : indices.size());
  }
  /// The view is valid until this object is changed or destroyed.
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
