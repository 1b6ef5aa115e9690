// A validated mesh: pointers and strides into the memory of the caller.
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
  std::size_t corners = 0;   ///< number of indices, or of vertices without indices
  std::size_t elements = 0;  ///< points, lines or triangles after splitting
  StridedFloats positions;
  int components = 3;                         ///< per position: 3 or 4
  StridedFloats normals;                      ///< optional
  StridedFloats colors;                       ///< optional
  const std::uint8_t* color_bytes = nullptr;  ///< optional
  std::size_t color_stride = 0;               ///< bytes
  StridedFloats color_indices;                ///< optional
  StridedFloats texcoords;                    ///< optional
  const std::uint32_t* indices = nullptr;     ///< null: 16 bits, or vertices in order
  const std::uint16_t* indices16 = nullptr;

  bool indexed() const { return indices != nullptr || indices16 != nullptr; }
  std::size_t triangles_per_polygon() const { return triangles_of_polygon(primitive, elements); }
  Topology topology() const { return topology_of(primitive); }
  bool has_colors() const { return colors || color_bytes != nullptr; }
  /// The vertex at a corner of the index list.
  std::size_t vertex_at(std::size_t corner) const {
    if (indices) return indices[corner];
    return indices16 ? indices16[corner] : corner;
  }
  /// Component c of a vertex's colour.
  float color(std::size_t vertex, std::size_t c) const {
    return color_bytes ? static_cast<float>(color_bytes[vertex * color_stride + c]) / 255.0f
                       : colors.at(vertex)[c];
  }
};

/// Validates everything except the values of indices. Throws Error for arrays that do not fit together, and
/// for misaligned pointers and strides.
MeshArrays check_mesh(const Mesh& mesh);

/// Throws Error for the first index that is out of bounds.
/// @param workers  share the work for many indices; null: the calling thread alone
void check_indices(const MeshArrays& mesh, WorkerPool* workers);

}  // namespace tessera::detail
