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
  std::size_t corners = 0;   ///< number of indices, or of vertices if there are no indices
  std::size_t elements = 0;  ///< number of points, lines, or triangles after splitting
  StridedFloats positions;
  int components = 3;  ///< components of a position: 3 or 4

  // Attributes; null if the mesh lacks them.
  StridedFloats normals;
  StridedFloats colors;                       ///< null also if colours are bytes
  const std::uint8_t* color_bytes = nullptr;  ///< null also if colours are floats
  std::size_t color_stride = 0;               ///< bytes between vertices of color_bytes
  StridedFloats color_indices;
  StridedFloats texcoords;
  /// Attributes that a vertex stage makes.
  bool stage_makes_normals = false, stage_makes_colors = false, stage_makes_texcoords = false;

  // Indices of 32 or 16 bits; both null: vertices in order.
  const std::uint32_t* indices = nullptr;
  const std::uint16_t* indices16 = nullptr;

  bool indexed() const { return indices != nullptr || indices16 != nullptr; }
  std::size_t triangles_per_polygon() const { return triangles_of_polygon(primitive, elements); }
  Topology topology() const { return topology_of(primitive); }
  bool has_normals() const { return normals || stage_makes_normals; }
  bool has_colors() const { return colors || color_bytes != nullptr || stage_makes_colors; }
  bool has_texcoords() const { return texcoords || stage_makes_texcoords; }
  /// Number of the vertex at a corner.
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

/// Validates everything except the values of indices.
/// @throws Error  for arrays that do not fit together, and for misaligned pointers and strides
MeshArrays check_mesh(const Mesh& mesh);

/// Validates the values of indices.
/// @param workers  validate large meshes in parallel; null: serial
/// @throws Error  names the first index that is out of bounds
void check_indices(const MeshArrays& mesh, WorkerPool* workers);

}  // namespace tessera::detail
