#include "engine/plan/light_facts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "raster/vertex_bounds.h"
#include "shading/light_reach.h"

namespace tessera::detail {
namespace {

constexpr std::size_t kSampledVertices = 8;
constexpr std::size_t kMinPartSize = 64;  ///< vertices or triangles
constexpr std::size_t kMaxParts = 256;

/// Maps a box of object space by the first three rows of a matrix.
/// @param columns  of the matrix, in its rows: 3, or 4 with a translation
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

FloatBox box_of(StridedFloats values, std::size_t vertex) {
  const float* const value = values.at(vertex);
  return {{value[0], value[1], value[2]}, {value[0], value[1], value[2]}};
}

/// Proofs about vertices of a draw, and about the points between them.
class LightProofs {
 public:
  LightProofs(const DrawPlan& plan, const MeshArrays& mesh) : plan_(plan), mesh_(mesh) {}

  SurfaceBounds bounds_of(const FloatBox& positions, const FloatBox& normals) const {
    return {.positions = map_box(plan_.eye.eye_from_object, 4, positions),
            .normals = mesh_.normals ? map_box(plan_.eye.normal_matrix, 3, normals) : VectorBox{}};
  }
  SurfaceBounds bounds_of_vertex(std::size_t vertex) const {
    return bounds_of(box_of(mesh_.positions, vertex),
                     mesh_.normals ? box_of(mesh_.normals, vertex) : FloatBox{});
  }
  /// Whether the light reaches none of the points.
  bool misses(const LightCandidate& candidate, const SurfaceBounds& bounds) const {
    const EyeLight& light = plan_.lights[candidate.light];
    if (candidate.reach == LightReach::outside_cone) return is_outside_cone(light, bounds.positions);
    return mesh_.normals && is_light_behind(light, bounds, candidate.face == 1);
  }

 private:
  const DrawPlan& plan_;
  const MeshArrays& mesh_;
};

/// Candidates that miss vertex 0.
void find_candidates(const LightProofs& proofs, DrawPlan& plan) {
  const SurfaceBounds bounds = proofs.bounds_of_vertex(0);
  plan.light_candidates.clear();
  for (std::size_t light = 0; light < plan.lights.size(); ++light)
    for (int face = 0; face < (plan.two_sided ? 2 : 1); ++face)
      for (const LightReach reach : {LightReach::outside_cone, LightReach::behind}) {
        const LightCandidate candidate{light, face, reach};
        if (proofs.misses(candidate, bounds)) plan.light_candidates.push_back(candidate);
      }
}

/// Keeps the candidates that also miss some vertices from all over the mesh.
void sample_vertices(const LightProofs& proofs, std::size_t vertices, DrawPlan& plan) {
  for (std::size_t s = 1; s < kSampledVertices && !plan.light_candidates.empty(); ++s) {
    const SurfaceBounds bounds = proofs.bounds_of_vertex(s * (vertices - 1) / (kSampledVertices - 1));
    std::erase_if(plan.light_candidates,
                  [&](const LightCandidate& candidate) { return !proofs.misses(candidate, bounds); });
  }
}

/// Boxes of the positions and normals of some vertices.
struct VertexBoxes {
  FloatBox positions, normals;

  void include(const VertexBoxes& other) {
    positions.include(other.positions);
    normals.include(other.normals);
  }
};

/// Null if a value is not finite.
std::optional<VertexBoxes> boxes_of_vertices(const MeshArrays& mesh, std::size_t first, std::size_t last,
                                             InstructionSet isa) {
  VertexBoxes boxes;
  bool is_finite = find_bounds(isa)(mesh.positions.from(first), last - first, boxes.positions);
  if (mesh.normals) is_finite &= find_bounds(isa)(mesh.normals.from(first), last - first, boxes.normals);
  return is_finite ? std::optional(boxes) : std::nullopt;
}

/// Boxes of the vertices of elements [first, last). @pre first < last
VertexBoxes boxes_of_elements(const MeshArrays& mesh, std::size_t first, std::size_t last) {
  std::optional<VertexBoxes> boxes;
  for (std::size_t element = first; element < last; ++element)
    for (const std::size_t corner :
         element_corners(mesh.primitive, ProvokingVertex::last, mesh.corners, element)) {
      const std::size_t vertex = mesh.vertex_at(corner);
      const VertexBoxes at{box_of(mesh.positions, vertex),
                           mesh.normals ? box_of(mesh.normals, vertex) : FloatBox{}};
      if (boxes) boxes->include(at);
      else boxes = at;
    }
  return *boxes;
}

/// Splits the draw into parts, and drops candidates that one of the parts does not prove.
/// @param between  lit between vertices: parts are triangles, whose points are inside of the boxes of their
///                 vertices; otherwise vertices
void keep_proven_by_all_parts(const LightProofs& proofs, const MeshArrays& mesh, bool between,
                              InstructionSet isa, DrawPlan& plan) {
  const std::size_t count = between ? mesh.elements : mesh.vertices;
  const std::size_t each = std::max(kMinPartSize, (count + kMaxParts - 1) / kMaxParts);
  for (std::size_t first = 0; first < count && !plan.light_candidates.empty(); first += each) {
    const std::size_t last = std::min(count, first + each);
    const VertexBoxes boxes =
        between ? boxes_of_elements(mesh, first, last) : *boxes_of_vertices(mesh, first, last, isa);
    const SurfaceBounds part = proofs.bounds_of(boxes.positions, boxes.normals);
    std::erase_if(plan.light_candidates,
                  [&](const LightCandidate& candidate) { return !proofs.misses(candidate, part); });
  }
}

void set_reach(DrawPlan& plan, const LightCandidate& proven) {
  std::vector<LightReach>& reach = plan.light_reach[proven.face];
  reach.resize(plan.lights.size(), LightReach::unknown);
  if (reach[proven.light] != LightReach::outside_cone) reach[proven.light] = proven.reach;
}

/// Whether a draw is lit at points between its vertices.
bool lights_between_vertices(const DrawPlan& plan, const DrawState& state) {
  return state.shading == Shading::phong && plan.topology != Topology::points;
}

/// Whether values between vertices leave the range of the vertices: lines extrapolate beyond their ends. With
/// several samples a pixel's centre may lie outside of its triangle, but its values are clamped.
bool extrapolates(const DrawPlan& plan) {
  const bool draws_edges = plan.mode[0] == PolygonMode::line || plan.mode[1] == PolygonMode::line;
  return plan.topology == Topology::lines || draws_edges;
}

}  // namespace

void prove_light_reach(DrawPlan& plan, const RecordedDraw& draw, InstructionSet isa) {
  const MeshArrays& mesh = draw.mesh;
  const double* const last_row = plan.eye.eye_from_object + 12;
  const bool keeps_w = last_row[0] == 0 && last_row[1] == 0 && last_row[2] == 0 && last_row[3] == 1;
  if (plan.lights.empty() || mesh.vertices == 0 || mesh.components != 3 || !keeps_w) return;
  const bool lights_between = lights_between_vertices(plan, draw.state);
  if (lights_between && extrapolates(plan)) return;

  const LightProofs proofs(plan, mesh);
  find_candidates(proofs, plan);
  sample_vertices(proofs, mesh.vertices, plan);
  if (plan.light_candidates.empty()) return;
  const std::optional<VertexBoxes> boxes = boxes_of_vertices(mesh, 0, mesh.vertices, isa);
  if (!boxes) return;
  const SurfaceBounds whole = proofs.bounds_of(boxes->positions, boxes->normals);
  std::erase_if(plan.light_candidates, [&](const LightCandidate& candidate) {
    const bool is_proven = proofs.misses(candidate, whole);
    if (is_proven) set_reach(plan, candidate);
    return is_proven;
  });
  keep_proven_by_all_parts(proofs, mesh, lights_between, isa, plan);
  for (const LightCandidate& candidate : plan.light_candidates) set_reach(plan, candidate);
}

}  // namespace tessera::detail
