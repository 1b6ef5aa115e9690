#include "engine/plan/light_facts.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/plan/surface_bounds.h"

namespace tessera::detail {
namespace {

constexpr std::size_t kSampledVertices = 8;
constexpr std::size_t kMinPartSize = 64;  ///< vertices or triangles
constexpr std::size_t kMaxParts = 256;

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

}  // namespace

void prove_light_reach(DrawPlan& plan, const RecordedDraw& draw, InstructionSet isa) {
  const MeshArrays& mesh = draw.mesh;
  if (plan.lights.empty() || !has_surface_bounds(plan, mesh)) return;
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
