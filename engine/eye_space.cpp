#include "engine/eye_space.h"

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "engine/matrix.h"

namespace tessera {
namespace {

Rgb rgb(const Color& c) { return {c.r, c.g, c.b}; }

std::array<float, 3> unit(const glm::dvec3& v) {
  const glm::dvec3 m = measurable(v);
  const double length = glm::length(m);
  const glm::dvec3 n = length > 0 ? m / length : glm::dvec3(0);
  return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
}

double largest_of(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// Squares of distances are floats. A light from 2^62 on stands nearer, by a power of two and in the same direction, and is attenuated as where it was.
void move_within_reach(EyeLight& light, const glm::dvec3& at) {
  constexpr int kFarthest = 62;
  const double distance = largest_of(at);
  const int exponent = std::isfinite(distance) && distance > 0 ? std::max(std::ilogb(distance) - (kFarthest - 1), 0) : 0;
  for (int c = 0; c < 3; ++c) light.position[static_cast<std::size_t>(c)] = static_cast<float>(std::scalbn(at[c], -exponent));
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
    move_within_reach(e, view * glm::dvec4(glm::dvec3(p[0], p[1], p[2]) / double{p[3]}, 1.0));
  }
  const auto& d = light.spot_direction;
  e.spot_direction = unit(glm::dmat3(view) * glm::dvec3(d[0], d[1], d[2]));
  e.spot_exponent = light.spot_exponent;
  e.spot_cutoff = light.spot_cutoff;
  return e;
}

}  // namespace tessera
