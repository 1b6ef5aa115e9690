#include "engine/plan/eye_space.h"

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "engine/record/matrix.h"

namespace tessera::detail {
namespace {

std::array<float, 3> unit(const glm::dvec3& v) {
  const glm::dvec3 m = scaled_to_safe_range(v);
  const double length = glm::length(m);
  const glm::dvec3 n = length > 0 ? m / length : glm::dvec3(0);
  return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
}

double max_abs(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// Squared distances are floats. A light at 2^62 or farther is moved nearer by a power of two, in the same
// direction; its attenuation is that of the original distance.
void bring_within_float_range(EyeLight& light, const glm::dvec3& at) {
  constexpr int kMaxDistanceExponent = 62;
  const double distance = max_abs(at);
  const int exponent = std::isfinite(distance) && distance > 0
                           ? std::max(std::ilogb(distance) - (kMaxDistanceExponent - 1), 0)
                           : 0;
  for (int c = 0; c < 3; ++c)
    light.position[static_cast<std::size_t>(c)] = static_cast<float>(std::scalbn(at[c], -exponent));
  light.attenuation[1] = std::scalbn(light.attenuation[1], exponent);
  light.attenuation[2] = std::scalbn(light.attenuation[2], 2 * exponent);
}

}  // namespace

EyeLight eye_light(const Light& light, const glm::dmat4& view) {
  EyeLight e;
  e.ambient = rgb(light.ambient);
  e.diffuse = rgb(light.diffuse);
  e.specular = rgb(light.specular);
  const auto& p = light.position;
  e.directional = p[3] == 0;
  e.attenuation = {light.attenuation_constant, light.attenuation_linear, light.attenuation_quadratic};
  if (e.directional) {
    e.position = unit(glm::dmat3(view) * glm::dvec3(p[0], p[1], p[2]));
  } else {
    const glm::dvec4 at = view * glm::dvec4(glm::dvec3(p[0], p[1], p[2]) / double{p[3]}, 1.0);
    bring_within_float_range(e, glm::dvec3(at) / (at.w != 0 ? at.w : 1.0));
  }
  const auto& d = light.spot_direction;
  e.spot_direction = unit(glm::dmat3(view) * glm::dvec3(d[0], d[1], d[2]));
  e.spot_exponent = light.spot_exponent;
  e.spot_cutoff = light.spot_cutoff;
  return e;
}

// The inverse transpose is the matrix of cofactors divided by the determinant; a singular matrix keeps the
// cofactors. Powers of two are factored out, so that no product leaves the range of doubles, and multiplied
// back if lengths matter. They change no bit.
EyeTransform eye_transform(const glm::dmat4& eye_from_object, const NormalLengths& lengths) {
  const auto exponent_of = [](const glm::dmat3& m) {
    const double largest = std::max({max_abs(m[0]), max_abs(m[1]), max_abs(m[2])});
    return largest > 0 && std::isfinite(largest) ? std::ilogb(largest) : 0;
  };
  const auto scale_by = [](glm::dmat3& m, int exponent) {
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 3; ++row) m[column][row] = std::scalbn(m[column][row], exponent);
  };
  glm::dmat3 m(eye_from_object);
  const int exponent = exponent_of(m);
  scale_by(m, -exponent);
  glm::dmat3 normal(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  const double determinant = glm::dot(m[0], normal[0]);
  const bool singular = !std::isnormal(determinant);
  if (singular) normal *= determinant < 0 ? -1.0 : 1.0;
  else normal *= 1 / determinant;
  const bool lengths_matter = lengths.shortest == 0;
  if (!lengths_matter) scale_by(normal, -exponent_of(normal));
  else scale_by(normal, singular ? 2 * exponent : -exponent);

  EyeTransform eye;
  std::copy_n(from_glm(eye_from_object).m.begin(), 16, eye.eye_from_object);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) eye.normal_matrix[3 * row + column] = normal[column][row];
  eye.normal_lengths = lengths;
  return eye;
}

}  // namespace tessera::detail
