// Section 5 of the specification in long double: colour of a lit point, term by term. Where rounding decides
// between the two sides of a discontinuity (the edge of a cone, the terminator of a highlight), both sides
// are right, so sums are intervals.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "engine/tessera/tessera.hpp"

namespace tessera::test {

using Real = long double;
using Real3 = std::array<Real, 3>;

inline Real dot(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Real3 operator+(const Real3& a, const Real3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Real3 operator-(const Real3& a, const Real3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Real3 operator*(const Real3& a, Real s) { return {a[0] * s, a[1] * s, a[2] * s}; }
inline Real length(const Real3& v) { return std::sqrt(dot(v, v)); }
/// normalize(0) = 0.
inline Real3 normalized(const Real3& v) { return length(v) > 0 ? v * (1 / length(v)) : Real3{0, 0, 0}; }
template <class Number>
Real3 real3(const std::array<Number, 3>& v) {
  return {Real{v[0]}, Real{v[1]}, Real{v[2]}};
}
inline Real3 real3(const Color& c) { return {c.r, c.g, c.b}; }

struct RealRange {
  Real low = 0, high = 0;
};
/// factor * range for a factor of either sign.
inline RealRange operator*(Real factor, const RealRange& r) {
  return {std::min(factor * r.low, factor * r.high), std::max(factor * r.low, factor * r.high)};
}
inline RealRange operator+(const RealRange& a, const RealRange& b) {
  return {a.low + b.low, a.high + b.high};
}

/// A light in eye space; directions have length 1.
struct RealLight {
  Real3 ambient{};
  Real3 diffuse{};
  Real3 specular{};
  bool directional = true;
  Real3 position{};
  Real3 spot_direction{};
  Real spot_exponent = 0;
  Real spot_cutoff = 180;
  Real3 attenuation{1, 0, 0};
};
/// Transforms a light from world to eye space. `view` must be rigid.
inline RealLight real_light(const Light& l, const Matrix& view = {}) {
  const auto in_eye_space = [&](const Real3& v, Real w) {
    Real3 s;
    for (std::size_t i = 0; i < 3; ++i)
      s[i] = dot({view.m[4 * i], view.m[4 * i + 1], view.m[4 * i + 2]}, v) + view.m[4 * i + 3] * w;
    return s;
  };
  const Real3 xyz = in_eye_space({l.position[0], l.position[1], l.position[2]}, l.position[3]);
  RealLight r{real3(l.ambient), real3(l.diffuse), real3(l.specular)};
  r.directional = l.position[3] == 0;
  r.position = r.directional ? normalized(xyz) : xyz * (1 / Real{l.position[3]});
  r.spot_direction = normalized(in_eye_space(real3(l.spot_direction), 0));
  r.spot_exponent = l.spot_exponent;
  r.spot_cutoff = l.spot_cutoff;
  r.attenuation = {l.attenuation_constant, l.attenuation_linear, l.attenuation_quadratic};
  return r;
}

struct RealPoint {
  Real3 normal{};
  Real3 position{};
};

/// x^0 = 1 for every x.
inline Real real_power(Real x, Real y) {
  if (y == 0) return 1;
  return x > 0 ? std::pow(x, y) : 0;
}

/// Contribution of one light at one point. `slack` is the tolerance of the implementation's cosines.
struct LightAtPoint {
  Real att = 1;
  Real n_dot_l = 0;
  Real spot_cosine = 1;
  Real highlight_base = 0;
  Real half_length = 2;  ///< |L + E|, for Blinn's model
  RealRange spot{1, 1};
  RealRange highlight{0, 0};

  LightAtPoint(const RealLight& light, const RealPoint& point, bool local_viewer, SpecularModel kind,
               Real shininess, Real slack) {
    const Real3 offset = light.directional ? light.position : light.position - point.position;
    const Real distance = length(offset);
    const Real3 l = light.directional ? light.position : normalized(offset);
    if (distance == 0) slack = 0;  // No rounding there: L is 0.
    if (!light.directional) {
      const Real denominator =
          light.attenuation[0] + light.attenuation[1] * distance + light.attenuation[2] * distance * distance;
      att = denominator > 0 ? 1 / denominator : 1e6L;
    }
    if (light.spot_cutoff != 180) {
      spot_cosine = -dot(l, light.spot_direction);
      const Real edge =
          light.spot_cutoff == 90 ? 0 : std::cos(light.spot_cutoff * std::numbers::pi_v<Real> / 180);
      const Real inside = real_power(spot_cosine, light.spot_exponent);
      const bool surely = spot_cosine >= edge + slack && spot_cosine > slack;
      const bool maybe = spot_cosine >= edge - slack && spot_cosine > -slack;
      spot = {surely ? inside : 0, maybe ? inside : 0};
    }
    n_dot_l = dot(point.normal, l);
    const Real3 e = local_viewer ? normalized(point.position * -1) : Real3{0, 0, 1};
    const Real3 half = l + e;
    half_length = length(half);
    if (kind == SpecularModel::blinn) highlight_base = dot(normalized(half), point.normal);
    else highlight_base = dot(point.normal * (2 * n_dot_l) - l, e);
    const Real shine = real_power(highlight_base, shininess);
    const Real reach = slack * std::max<Real>(length(point.normal), 1);
    highlight = {n_dot_l > reach ? shine : 0, n_dot_l > -reach && (slack > 0 || n_dot_l > 0) ? shine : 0};
  }
};

/// Colour of a point on a front (or back) face, clamped to 0..1.
inline std::array<RealRange, 3> lit_color(const Material& material, std::span<const Light> lights,
                                          const LightModel& model, RealPoint point, Real slack,
                                          bool front = true, const Matrix& view = {}) {
  if (!front) point.normal = point.normal * -1;
  std::array<RealRange, 3> sum;
  const Real3 emission = real3(material.emission);
  const Real3 scene = real3(model.ambient);
  const Real3 ambient = real3(material.ambient);
  const Real3 diffuse = real3(material.diffuse);
  const Real3 specular = real3(material.specular);
  for (std::size_t c = 0; c < 3; ++c) sum[c].low = sum[c].high = emission[c] + scene[c] * ambient[c];
  for (const Light& given : lights) {
    const RealLight light = real_light(given, view);
    const LightAtPoint at(light, point, model.local_viewer, model.specular, material.shininess, slack);
    for (std::size_t c = 0; c < 3; ++c) {
      const Real even =
          light.ambient[c] * ambient[c] + std::max<Real>(at.n_dot_l, 0) * light.diffuse[c] * diffuse[c];
      const Real shine = light.specular[c] * specular[c];
      // The four combinations: inside the cone or not, with highlight or without.
      RealRange all{};
      bool first = true;
      for (const Real s : {at.spot.low, at.spot.high})
        for (const Real h : {at.highlight.low, at.highlight.high}) {
          const Real term = at.att * s * (even + h * shine);
          all = first ? RealRange{term, term} : RealRange{std::min(all.low, term), std::max(all.high, term)};
          first = false;
        }
      sum[c] = sum[c] + all;
    }
  }
  for (RealRange& s : sum) s = {std::clamp<Real>(s.low, 0, 1), std::clamp<Real>(s.high, 0, 1)};
  return sum;
}

}  // namespace tessera::test
