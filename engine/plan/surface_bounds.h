// Bounds of the points and normals of a draw in eye space, from its vertices.
#pragma once

#include <optional>

#include "engine/plan/draw_plan.h"
#include "raster/vertex_bounds.h"
#include "shading/light_reach.h"

namespace tessera::detail {

/// Boxes of the positions and normals of some vertices, object space.
struct VertexBoxes {
  FloatBox positions, normals;

  void include(const VertexBoxes& other) {
    positions.include(other.positions);
    normals.include(other.normals);
  }
};

/// Null if a value is not finite.
std::optional<VertexBoxes> boxes_of_vertices(const MeshArrays& mesh, std::size_t first, std::size_t last,
                                             InstructionSet isa);

/// Maps a box of object space by the first three rows of a matrix.
/// @param columns  of the matrix, in its rows: 3, or 4 with a translation
VectorBox map_box(const double* matrix, std::size_t columns, const FloatBox& box);

/// Whether boxes of vertices bound the points of a draw: it has vertices, and no w but 1 in eye space.
bool has_surface_bounds(const DrawPlan& plan, const MeshArrays& mesh);

/// Whether a draw is lit at points between its vertices.
bool lights_between_vertices(const DrawPlan& plan, const DrawState& state);

/// Whether values between vertices leave the range of the vertices: lines extrapolate beyond their ends. With
/// several samples a pixel's centre may lie outside of its triangle, but its values are clamped.
bool extrapolates(const DrawPlan& plan);

}  // namespace tessera::detail
