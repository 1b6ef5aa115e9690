// The scalar twin of lighting.cpp and light_terms-inl.h, and their specification: one point at a time, the
// same steps in the same order.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "framebuffer/format.h"
#include "shading/lighting.h"
#include "shading/power_reference.h"

namespace tessera::detail {

struct PointReference {
  std::array<float, 3> normal{}, position{};
  Rgb vertex{};
};

namespace lighting_reference {

using Vec = std::array<float, 3>;

inline float dot(const Vec& a, const Vec& b) {
  return std::fma(a[0], b[0], std::fma(a[1], b[1], a[2] * b[2]));
}
inline Vec scaled(const Vec& v, float s) { return {v[0] * s, v[1] * s, v[2] * s}; }
inline float inverse_length(float squared) { return squared > 0 ? 1.0f / std::sqrt(squared) : 0.0f; }
/// Squared distance between a and s b.
inline float squared_distance(const Vec& a, const Vec& b, float s) {
  const Vec apart{std::fma(-b[0], s, a[0]), std::fma(-b[1], s, a[1]), std::fma(-b[2], s, a[2])};
  return dot(apart, apart);
}
/// Cosine of the angle between a and s b, both of length 1.
inline float cosine_of_units(const Vec& a, const Vec& b, float s) {
  return std::fma(-0.5f, squared_distance(a, b, s), 1.0f);
}
inline float clamp_finite(float amount) { return amount < kMaxFloat ? amount : kMaxFloat; }
inline float finite(float value) {
  return std::isnan(value) ? -kMaxFloat : std::clamp(value, -kMaxFloat, kMaxFloat);
}
inline void accumulate(Rgb& sum, float intensity, const Rgb& color) {
  for (std::size_t c = 0; c < 3; ++c) sum[c] = std::fma(intensity, color[c], sum[c]);
}

/// One light at a point.
struct Incidence {
  Vec to_light{};    // unit
  float factor = 1;  // att * spot
  bool facing = false;
  float n_dot_l = 0;  // 0 unless facing
};

inline bool cone_reaches(const LightTerm& term, const Vec& to_light, float cosine) {
  const bool is_inside = term.spot_chord_squared > 0 ? squared_distance(to_light, term.spot_direction,
                                                                        -1.0f) <= term.spot_chord_squared
                                                     : cosine >= term.spot_cosine;
  return is_inside && cosine > 0;
}

inline Incidence incidence_of(const LightTerm& term, const Vec& normal, const Vec& position) {
  Incidence light;
  light.to_light = term.position;
  bool reached = true;
  if (term.kind != LightKind::directional) {
    for (std::size_t k = 0; k < 3; ++k) light.to_light[k] -= position[k];
    const float squared = dot(light.to_light, light.to_light);
    const float distance = std::sqrt(squared);
    light.to_light = scaled(light.to_light, squared > 0 ? 1.0f / distance : 0.0f);
    if (is_spot(term.kind)) {
      const float cosine = 0.0f - dot(light.to_light, term.spot_direction);
      reached = cone_reaches(term, light.to_light, cosine);
      light.factor = reached ? power_of_reference(cosine, term.spot_power.exponent) : 0.0f;
    }
    if (term.kind == LightKind::attenuated_point || term.kind == LightKind::attenuated_spot) {
      const float denominator =
          std::fma(term.attenuation[2], clamp_finite(squared),
                   std::fma(term.attenuation[1], clamp_finite(distance), term.attenuation[0]));
      const float attenuation = denominator > 0 ? clamp_finite(1.0f / denominator) : 1.0e6f;
      light.factor = clamp_finite(light.factor * attenuation);
    }
  }
  const float n_dot_l = dot(normal, light.to_light);
  light.facing = reached && n_dot_l > 0;
  light.n_dot_l = light.facing ? clamp_finite(n_dot_l) : 0.0f;
  return light;
}

/// S.n, its square, or R.E.
inline float highlight_base(const LightTerm& term, const Incidence& light, const Vec& normal,
                            const Vec& view) {
  const bool is_local =
      term.highlight == HighlightKind::blinn_local || term.highlight == HighlightKind::phong_local;
  const bool is_phong =
      term.highlight == HighlightKind::phong_infinite || term.highlight == HighlightKind::phong_local;
  const Vec& to_light = light.to_light;
  const Vec eye = is_local ? view : Vec{0, 0, 1};
  const float n_dot_v = is_local ? dot(normal, view) : normal[2];
  const Vec half{to_light[0] + eye[0], to_light[1] + eye[1], to_light[2] + eye[2]};
  if (is_phong) {  // R = 2 (L.n) n - L
    const float twice = light.n_dot_l + light.n_dot_l;
    if (term.sharp) return cosine_of_units(half, normal, twice);
    return twice * n_dot_v - (is_local ? dot(to_light, view) : to_light[2]);
  }
  if (term.kind == LightKind::directional && !is_local)
    return term.sharp ? cosine_of_units(normal, term.half_vector, 1.0f) : dot(normal, term.half_vector);
  // S = normalize(L + E)
  const float squared = dot(half, half);
  const float sum = light.n_dot_l + n_dot_v;
  if (term.squared) {
    const float not_negative = sum > 0 ? sum : 0.0f;
    return squared > 0 ? not_negative * not_negative / squared : 0.0f;
  }
  const float inverse = inverse_length(squared);
  return term.sharp ? cosine_of_units(normal, half, inverse) : sum * inverse;
}

/// spec * att * spot
inline float highlight_of(const LightTerm& term, const Incidence& light, const Vec& normal, const Vec& view) {
  if (!light.facing || term.highlight == HighlightKind::none) return 0;
  const float base = highlight_base(term, light, normal, view);
  if (base <= term.highlight_floor) return 0;
  return clamp_finite(power_of_reference(base, term.highlight_power.exponent) * light.factor);
}

/// @param sums  d in red, s in green
inline float index_of(const LightingProgram& program, const Rgb& sums) {
  const auto [ambient, diffuse, specular] = program.indexes;
  const float d = finite(sums[0]);
  const float s = finite(sums[1]);
  const float index = std::fma(s, specular - ambient, std::fma(d * (1.0f - s), diffuse - ambient, ambient));
  return masked_index(index < specular ? index : specular, program.index_modulus);
}

}  // namespace lighting_reference

/// A program of indices returns the index in red; the rest is undefined.
inline Rgb light_point_reference(const LightingProgram& program, const PointReference& point) {
  using namespace lighting_reference;
  Vec normal = point.normal;
  const float length = program.renormalize ? inverse_length(dot(normal, normal)) : 1.0f;
  normal = scaled(normal, program.negate_normal ? 0.0f - length : length);
  const Vec view = scaled(point.position, 0.0f - inverse_length(dot(point.position, point.position)));

  Rgb color = program.base;
  Rgb tracked = program.tracked_base;
  for (const LightTerm& term : program.terms) {
    const Incidence light = incidence_of(term, normal, point.position);
    const float diffuse = clamp_finite(light.n_dot_l * light.factor);
    const float highlight = highlight_of(term, light, normal, view);
    accumulate(color, light.factor, term.ambient);
    accumulate(tracked, light.factor, term.tracked_ambient);
    accumulate(color, diffuse, term.diffuse);
    accumulate(color, highlight, term.specular);
    accumulate(tracked, diffuse, term.tracked_diffuse);
    accumulate(tracked, highlight, term.tracked_specular);
  }
  if (program.index) return {index_of(program, color), 0, 0};
  Rgb result{};
  for (std::size_t c = 0; c < 3; ++c) {
    const float sum =
        program.tracked ? std::fma(finite(tracked[c]), finite(point.vertex[c]), color[c]) : color[c];
    const float at_least_0 = sum > 0 ? sum : 0.0f;
    result[c] = at_least_0 < 1 ? at_least_0 : 1.0f;
  }
  return result;
}

}  // namespace tessera::detail
