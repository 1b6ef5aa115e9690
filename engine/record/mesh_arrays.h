// A mesh as the stages read it: pointers and strides, checked. The memory is the caller's.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/record/primitive_assembly.h"
#include "engine/tessera/tessera.hpp"
#include "raster/vertex_transform.h"

namespace tessera::detail {

class WorkerPool;

struct MeshArrays {
  Primitive primitive = Primitive::triangles;
  std::size_t vertices = 0;
  std::size_t corners = 0;   ///< indices, or vertices where there are none
  std::size_t elements = 0;  ///< points, lines or triangles: what primitives are split into
  StridedFloats positions;
  int components = 3;                         ///< of a position
  StridedFloats normals;                      ///< or none
  StridedFloats colors;                       ///< or none
  const std::uint8_t* color_bytes = nullptr;  ///< or none
  std::size_t color_stride = 0;               ///< bytes
  StridedFloats color_indices;                ///< or none
  StridedFloats texcoords;                    ///< or none
  const std::uint32_t* indices = nullptr;     ///< null: 16 bits, or vertices in order
  const std::uint16_t* indices16 = nullptr;

  bool indexed() const { return indices != nullptr || indices16 != nullptr; }
  std::size_t triangles_per_polygon() const { return triangles_of_polygon(primitive, elements); }
  Topology topology() const { return topology_of(primitive); }
  bool has_colors() const { return colors || color_bytes != nullptr; }
  /// The vertex at a corner, counted along the indices.
  std::size_t vertex_at(std::size_t corner) const {
    return indices ? indices[corner] : indices16 ? indices16[corner] : corner;
  }
  /// Component c of a vertex's colour.
  float color(std::size_t vertex, std::size_t c) const {
    return color_bytes ? static_cast<float>(color_bytes[vertex * color_stride + c]) / 255.0f
                       : colors.at(vertex)[c];
  }
};

/// Checks a mesh but for what its indices are, which are many. Throws Error for arrays that do not fit
/// together, and strides and pointers that floats cannot have.
MeshArrays check_mesh(const Mesh& mesh);

/// Throws Error that names the first index that is out of bounds, if there is one.
/// @param workers  look through many together; null: the caller alone does
void check_indices(const MeshArrays& mesh, WorkerPool* workers);

}  // namespace tessera::detail
