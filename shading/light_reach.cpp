#include "shading/light_reach.h"

#include <algorithm>
#include <cmath>

#include "framebuffer/trigonometry.h"

namespace tessera::detail {
namespace {

using Vec = std::array<double, 3>;

/// Relative margin of a product of a normal and a direction. A normal or position is a float of relative
/// error 2^-24, interpolation multiplies that by less than 2^4, and L and n.L have six roundings of floats.
constexpr double kMargin = 0x1p-16;
/// Relative margin of the sums of doubles that transform a box.
constexpr double kTransformMargin = 0x1p-40;
/// Outside these magnitudes boxes prove nothing: products of floats might overflow or underflow.
constexpr double kMinMagnitude = 0x1p-50, kMaxMagnitude = 0x1p50;
/// Degrees by which a cone is widened. Exceeds the rounding of its cosine, which is coarsest at kNarrowCone.
constexpr double kConeMargin = 0.01;

double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vec& v) { return std::sqrt(dot(v, v)); }
Vec to_doubles(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }
Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec operator*(const Vec& v, double s) { return {v[0] * s, v[1] * s, v[2] * s}; }

double largest_component(const Vec& v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

/// Largest a.b for a in the box and b within `half` of `center`.
double largest_dot(const VectorBox& box, const Vec& center, const Vec& half) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += box.center[k] * center[k] + std::abs(box.center[k]) * half[k] + box.half[k] * std::abs(center[k]) +
           box.half[k] * half[k];
  return sum;
}

/// Smallest v.(x - origin) for x in the box.
double smallest_distance(const VectorBox& box, const Vec& origin, const Vec& v) {
  double sum = dot(box.center - origin, v);
  for (std::size_t k = 0; k < 3; ++k) sum -= box.half[k] * std::abs(v[k]);
  return sum;
}

/// The point of the box with the smallest product with v.
Vec lowest_corner(const VectorBox& box, const Vec& v) {
  Vec corner = box.center;
  for (std::size_t k = 0; k < 3; ++k) corner[k] += v[k] > 0 ? -box.half[k] : box.half[k];
  return corner;
}

bool is_in_range(double magnitude) { return magnitude > kMinMagnitude && magnitude < kMaxMagnitude; }

}  // namespace

bool is_light_behind(const EyeLight& light, const SurfaceBounds& bounds, bool back) {
  VectorBox normals = bounds.normals;
  if (!is_in_range(normals.magnitude)) return false;
  if (back) normals.center = normals.center * -1;
  Vec to_light = to_doubles(light.position);
  Vec spread{};
  double reach = 1;  // bounds L and the terms that it is computed from
  if (!light.directional) {
    reach = largest_component(to_light) + bounds.positions.magnitude;
    if (!is_in_range(reach)) return false;
    to_light = to_light - bounds.positions.center;
    spread = bounds.positions.half;
  }
  double longest_normal = 0;
  for (std::size_t k = 0; k < 3; ++k) longest_normal += std::abs(normals.center[k]) + normals.half[k];
  const double margin = kMargin * longest_normal + kTransformMargin * normals.magnitude;
  return largest_dot(normals, to_light, spread) < -4 * margin * reach;
}

bool is_outside_cone(const EyeLight& light, const VectorBox& positions) {
  if (light.directional || light.spot_cutoff == 180) return false;
  const Vec apex = to_doubles(light.position);
  Vec axis = to_doubles(light.spot_direction);
  const double axis_length = length(axis);
  const double reach = largest_component(apex) + positions.magnitude;
  if (axis_length == 0 || !is_in_range(reach)) return false;
  axis = axis * (1 / axis_length);
  const double margin = 4 * kMargin * reach;
  // The cone is in front of the plane through the apex.
  if (smallest_distance(positions, apex, axis * -1) > margin) return true;
  const double cutoff = std::max(double{light.spot_cutoff}, double{kNarrowCone}) + kConeMargin;
  if (cutoff >= 90) return false;
  // Every plane that touches the cone along a line separates it from the half-space outside. For a unit
  // vector e perpendicular to the axis, the plane's normal is cos(cutoff) e - sin(cutoff) axis.
  const auto [sine, cosine] = sine_cosine(cutoff);
  Vec towards = positions.center - apex;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const Vec across = towards - axis * dot(towards, axis);
    const double across_length = length(across);
    if (!(across_length > 0)) return false;
    const Vec e = across * (1 / across_length);
    const Vec normal = e * cosine - axis * sine;
    if (smallest_distance(positions, apex, normal) > margin) return true;
    towards = lowest_corner(positions, normal) - apex;  // the point that is nearest to the cone, or inside
  }
  return false;
}

}  // namespace tessera::detail
