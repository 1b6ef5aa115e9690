#include "engine/plan/light_threshold.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/plan/surface_bounds.h"

namespace tessera::detail {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Relative margin for the roundings of the kernel. Cosines of unit vectors may exceed 1 by 2^-21, and are
/// raised to a power of up to 2^14: by less than 2^-6 for a cone, and the same for a highlight.
constexpr double kRoundingMargin = 1 + 0x1p-4;
/// Margin of distances, relative to the magnitudes that they are computed from: see light_reach.cpp.
constexpr double kDistanceMargin = 0x1p-14;
/// Outside these magnitudes distances have no bounds: squares of floats might overflow or underflow.
constexpr double kMinMagnitude = 0x1p-50, kMaxMagnitude = 0x1p50;
/// Normals of unit vectors and interpolated ones between them: the excess is rounding.
constexpr double kLongestUnitNormal = 1 + 0x1p-16;

/// Largest length of a vector of the box.
double largest_length(const VectorBox& box) {
  double squared = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double largest = std::abs(box.center[k]) + box.half[k];
    squared += largest * largest;
  }
  return std::sqrt(squared);
}

/// Smallest distance of a point from the box, less the margin. Negative if there is no bound.
double smallest_distance(const VectorBox& box, const std::array<float, 3>& point) {
  double squared = 0, magnitude = box.magnitude;
  for (std::size_t k = 0; k < 3; ++k) {
    const double outside = std::max(std::abs(point[k] - box.center[k]) - box.half[k], 0.0);
    squared += outside * outside;
    magnitude = std::max(magnitude, std::abs(double{point[k]}) + box.magnitude);
  }
  if (!(magnitude > kMinMagnitude && magnitude < kMaxMagnitude)) return -1;
  return std::max(std::sqrt(squared) - kDistanceMargin * magnitude, 0.0);
}

double largest_attenuation(const EyeLight& light, const VectorBox& positions) {
  if (light.directional) return 1;
  const auto [constant, linear, quadratic] = light.attenuation;
  if (constant < 0 || linear < 0 || quadratic < 0) return kUnbounded;
  const double distance = smallest_distance(positions, light.position);
  if (distance < 0) return kUnbounded;
  const double denominator = constant + linear * distance + quadratic * distance * distance;
  return denominator > 0 ? 1 / denominator : kUnbounded;
}

/// Null if a component is not finite.
std::optional<Rgb> largest_vertex_color(const MeshArrays& mesh) {
  Rgb largest{};
  for (std::size_t i = 0; i < mesh.vertices; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const float component = std::abs(mesh.color(i, c));
      if (!std::isfinite(component)) return std::nullopt;
      largest[c] = std::max(largest[c], component);
    }
  return largest;
}

/// Whether colours of vertices are interpolated beyond them: then a bound at the vertices bounds no pixel.
bool extrapolates_colors(const DrawPlan& plan, const DrawState& state, bool has_samples) {
  const bool interpolates = state.shading == Shading::gouraud && plan.topology != Topology::points;
  return interpolates && (has_samples || extrapolates(plan));
}

}  // namespace

ContributionBounds::ContributionBounds(const DrawPlan& plan, const RecordedDraw& draw, bool has_samples,
                                       InstructionSet isa) {
  const MeshArrays& mesh = draw.mesh;
  const DrawState& state = draw.state;
  if (plan.lights.empty() || !has_surface_bounds(plan, mesh)) return;
  if (lights_between_vertices(plan, state) && extrapolates(plan)) return;
  if (extrapolates_colors(plan, state, has_samples)) return;
  const std::optional<VertexBoxes> boxes = boxes_of_vertices(mesh, 0, mesh.vertices, isa);
  if (!boxes) return;
  positions_ = map_box(plan.eye.eye_from_object, 4, boxes->positions);
  if (!state.normalize && !renormalizes_normals(draw)) {
    if (!mesh.normals) return;  // generated normals have any length after the transform
    max_normal_ = largest_length(map_box(plan.eye.normal_matrix, 3, boxes->normals));
  }
  if (mesh.has_colors()) {
    const std::optional<Rgb> color = largest_vertex_color(mesh);
    if (!color) return;
    max_vertex_color_ = *color;
  }
  is_bounded_ = std::isfinite(max_normal_);
}

double ContributionBounds::of(const EyeLight& light, LightReach reach, const ReflectedColors& colors) const {
  if (reach == LightReach::outside_cone) return 0;
  if (!is_bounded_) return kUnbounded;
  const auto reflected = [&](bool is_tracked, const Rgb& of_light, const Rgb& of_material) {
    const Rgb& factor = is_tracked ? max_vertex_color_ : of_material;
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c)
      largest = std::max(largest, std::abs(double{of_light[c]} * double{factor[c]}));
    return largest;
  };
  double sum = 0;
  if (!light.directional) sum += reflected(colors.tracked.ambient, light.ambient, colors.ambient);
  if (reach != LightReach::behind) {
    sum += max_normal_ * reflected(colors.tracked.diffuse, light.diffuse, colors.diffuse);
    const double specular = reflected(colors.tracked.specular, light.specular, colors.specular);
    const bool is_highlight_bounded = max_normal_ <= kLongestUnitNormal || colors.shininess == 0;
    if (specular > 0) sum += is_highlight_bounded ? specular : kUnbounded;
  }
  if (sum == 0) return 0;
  return kRoundingMargin * sum * largest_attenuation(light, positions_);
}

void leave_out_weak_lights(DrawPlan& plan, int face, const ReflectedColors& colors,
                           const ContributionBounds& bounds, float threshold) {
  struct Candidate {
    double bound;
    std::size_t light;
  };
  std::vector<LightReach>& reach = plan.light_reach[face];
  reach.resize(plan.lights.size(), LightReach::unknown);
  std::vector<Candidate> candidates;
  for (std::size_t light = 0; light < plan.lights.size(); ++light) {
    const double bound = bounds.of(plan.lights[light], reach[light], colors);
    if (bound > 0 && bound < threshold) candidates.push_back({bound, light});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.bound < b.bound; });
  double sum = 0;
  for (const Candidate& candidate : candidates) {
    sum += candidate.bound;
    if (!(sum < threshold)) break;
    reach[candidate.light] = LightReach::below_threshold;
  }
}

}  // namespace tessera::detail
