#include <cstddef>
#include <cstdint>

#include "engine/stages/generated_normals.h"
#include "engine/stages/geometry.h"

namespace tessera::detail {
namespace {

/// Writes the vertex index of each corner of elements [first, last), the provoking vertex at
/// provoking_place().
void list_corners(const GeometryDraw& draw, std::size_t first, std::size_t last) {
  const MeshArrays& mesh = *draw.mesh;
  const auto each = static_cast<std::size_t>(mesh.topology());
  std::uint32_t* out = draw.buffers->indices.data() + each * first;
  for (std::size_t e = first; e < last; ++e) {
    const auto corners = element_corners(mesh.primitive, draw.provoking_vertex, mesh.corners, e);
    for (std::size_t k = 0; k < each; ++k) *out++ = static_cast<std::uint32_t>(mesh.vertex_at(corners[k]));
  }
}

/// Lists the boundary of each polygon: the corners of its first triangle, then the corner that each further
/// triangle adds. The start does not depend on the provoking vertex.
void list_boundaries(const GeometryDraw& draw, std::size_t first, std::size_t last) {
  const MeshArrays& mesh = *draw.mesh;
  const std::size_t each = mesh.triangles_per_polygon();
  const std::size_t first_polygon = (first + each - 1) / each;
  std::uint32_t* out = draw.buffers->boundary.data() + first_polygon * (each + 2);
  for (std::size_t begin = first_polygon * each; begin < last; begin += each) {
    for (const std::size_t corner :
         element_corners(mesh.primitive, ProvokingVertex::last, mesh.corners, begin))
      *out++ = static_cast<std::uint32_t>(mesh.vertex_at(corner));
    for (std::size_t t = begin + 1; t < begin + each; ++t)
      *out++ = static_cast<std::uint32_t>(mesh.vertex_at(added_corner(mesh.primitive, t)));
  }
}

}  // namespace

void assemble_elements(const GeometryDraw& draw, std::size_t first, std::size_t last) {
  if (draw.generates_indices()) list_corners(draw, first, last);
  if (draw.plan->outlines) list_boundaries(draw, first, last);
  if (draw.plan->face_normals) make_face_normals(*draw.mesh, first, last, draw.buffers->face_normals.data());
}

}  // namespace tessera::detail
