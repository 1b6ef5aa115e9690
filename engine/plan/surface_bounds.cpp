#include "engine/plan/surface_bounds.h"

#include <algorithm>
#include <cmath>

namespace tessera::detail {

std::optional<VertexBoxes> boxes_of_vertices(const MeshArrays& mesh, std::size_t first, std::size_t last,
                                             InstructionSet isa) {
  VertexBoxes boxes;
  bool is_finite = find_bounds(isa)(mesh.positions.from(first), last - first, boxes.positions);
  if (mesh.normals) is_finite &= find_bounds(isa)(mesh.normals.from(first), last - first, boxes.normals);
  return is_finite ? std::optional(boxes) : std::nullopt;
}

VectorBox map_box(const double* matrix, std::size_t columns, const FloatBox& box) {
  VectorBox mapped;
  for (std::size_t r = 0; r < 3; ++r) {
    const double* const row = matrix + columns * r;
    double magnitude = columns == 4 ? std::abs(row[3]) : 0;
    mapped.center[r] = columns == 4 ? row[3] : 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double low = box.low[k], high = box.high[k];
      mapped.center[r] += row[k] * ((low + high) / 2);
      mapped.half[r] += std::abs(row[k]) * ((high - low) / 2);
      magnitude += std::abs(row[k]) * std::max(std::abs(low), std::abs(high));
    }
    mapped.magnitude = std::max(mapped.magnitude, magnitude);
  }
  return mapped;
}

bool has_surface_bounds(const DrawPlan& plan, const MeshArrays& mesh) {
  const double* const last_row = plan.eye.eye_from_object + 12;
  const bool keeps_w = last_row[0] == 0 && last_row[1] == 0 && last_row[2] == 0 && last_row[3] == 1;
  return mesh.vertices > 0 && mesh.components == 3 && keeps_w;
}

bool lights_between_vertices(const DrawPlan& plan, const DrawState& state) {
  return state.shading == Shading::phong && plan.topology != Topology::points;
}

bool extrapolates(const DrawPlan& plan) {
  const bool draws_edges = plan.mode[0] == PolygonMode::line || plan.mode[1] == PolygonMode::line;
  return plan.topology == Topology::lines || draws_edges;
}

}  // namespace tessera::detail
