// The scalar twin of lighting.cpp and its specification: one point at a time, the same steps in the same
// order.
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

/// A program of indices returns the index in red; the rest is undefined.
inline Rgb light_point_reference(const LightingProgram& program, const PointReference& point) {
  using Vec = std::array<float, 3>;
  const auto dot = [](const Vec& a, const Vec& b) {
    return std::fma(a[0], b[0], std::fma(a[1], b[1], a[2] * b[2]));
  };
  const auto scaled = [](const Vec& v, float s) { return Vec{v[0] * s, v[1] * s, v[2] * s}; };
  const auto inverse_length = [](float squared) { return squared > 0 ? 1.0f / std::sqrt(squared) : 0.0f; };
  const auto squared_distance = [&](const Vec& a, const Vec& b, float s) {  // between a and s b
    const Vec apart{std::fma(-b[0], s, a[0]), std::fma(-b[1], s, a[1]), std::fma(-b[2], s, a[2])};
    return dot(apart, apart);
  };
  const auto cosine_of_units = [&](const Vec& a, const Vec& b, float s) {
    return std::fma(-0.5f, squared_distance(a, b, s), 1.0f);
  };
  const auto clamp_finite = [](float amount) { return amount < kMaxFloat ? amount : kMaxFloat; };
  const auto finite = [](float value) {
    return std::isnan(value) ? -kMaxFloat : std::clamp(value, -kMaxFloat, kMaxFloat);
  };
  const auto accumulate = [](Rgb& sum, float intensity, const Rgb& color) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] = std::fma(intensity, color[c], sum[c]);
  };

  Vec normal = point.normal;
  const float length = program.renormalize ? inverse_length(dot(normal, normal)) : 1.0f;
  normal = scaled(normal, program.negate_normal ? 0.0f - length : length);
  const Vec view = scaled(point.position, 0.0f - inverse_length(dot(point.position, point.position)));

  Rgb color = program.base, tracked = program.tracked_base;
  for (const LightTerm& term : program.terms) {
    Vec to_light = term.position;
    float factor = 1;
    bool reached = true;
    if (term.kind != LightKind::directional) {
      for (std::size_t k = 0; k < 3; ++k) to_light[k] -= point.position[k];
      const float squared = dot(to_light, to_light), distance = std::sqrt(squared);
      to_light = scaled(to_light, squared > 0 ? 1.0f / distance : 0.0f);
      if (is_spot(term.kind)) {
        const float cosine = 0.0f - dot(to_light, term.spot_direction);
        reached = (term.spot_chord_squared > 0
                       ? squared_distance(to_light, term.spot_direction, -1.0f) <= term.spot_chord_squared
                       : cosine >= term.spot_cosine) &&
                  cosine > 0;
        factor = reached ? power_of_reference(cosine, term.spot_power.exponent) : 0.0f;
      }
      if (term.kind == LightKind::attenuated_point || term.kind == LightKind::attenuated_spot) {
        const float denominator =
            std::fma(term.attenuation[2], clamp_finite(squared),
                     std::fma(term.attenuation[1], clamp_finite(distance), term.attenuation[0]));
        factor = clamp_finite(factor * (denominator > 0 ? clamp_finite(1.0f / denominator) : 1.0e6f));
      }
    }
    const float incidence = dot(normal, to_light);
    const bool facing = reached && incidence > 0;
    const float n_dot_l = facing ? clamp_finite(incidence) : 0.0f, diffuse = clamp_finite(n_dot_l * factor);
    float highlight = 0;
    if (facing && term.highlight != HighlightKind::none) {
      const bool local =
          term.highlight == HighlightKind::blinn_local || term.highlight == HighlightKind::phong_local;
      const Vec eye = local ? view : Vec{0, 0, 1};
      const float n_dot_v = local ? dot(normal, view) : normal[2];
      const Vec half{to_light[0] + eye[0], to_light[1] + eye[1], to_light[2] + eye[2]};
      float base;
      if (term.highlight == HighlightKind::phong_infinite || term.highlight == HighlightKind::phong_local) {
        const float twice = n_dot_l + n_dot_l;  // R = 2 (L.n) n - L
        base = term.sharp ? cosine_of_units(half, normal, twice)
                          : twice * n_dot_v - (local ? dot(to_light, view) : to_light[2]);
      } else if (term.kind == LightKind::directional && !local) {
        base = term.sharp ? cosine_of_units(normal, term.half_vector, 1.0f) : dot(normal, term.half_vector);
      } else {  // S = normalize(L + E)
        const float squared = dot(half, half), inverse = inverse_length(squared), sum = n_dot_l + n_dot_v,
                    kept = sum > 0 ? sum : 0.0f;
        base = term.squared ? (squared > 0 ? kept * kept / squared : 0.0f)
               : term.sharp ? cosine_of_units(normal, half, inverse)
                            : sum * inverse;
      }
      highlight = base <= term.highlight_floor
                      ? 0.0f
                      : clamp_finite(power_of_reference(base, term.highlight_power.exponent) * factor);
    }
    accumulate(color, factor, term.ambient);
    accumulate(tracked, factor, term.tracked_ambient);
    accumulate(color, diffuse, term.diffuse);
    accumulate(color, highlight, term.specular);
    accumulate(tracked, diffuse, term.tracked_diffuse);
    accumulate(tracked, highlight, term.tracked_specular);
  }
  if (program.index) {
    const auto [ambient, diffuse, specular] = program.indexes;
    const float d = finite(color[0]), s = finite(color[1]);
    const float sum = std::fma(s, specular - ambient, std::fma(d * (1.0f - s), diffuse - ambient, ambient));
    return {masked_index(sum < specular ? sum : specular, program.index_modulus), 0, 0};
  }
  Rgb result{};
  for (std::size_t c = 0; c < 3; ++c) {
    const float sum =
        program.tracked ? std::fma(finite(tracked[c]), finite(point.vertex[c]), color[c]) : color[c];
    const float low = sum > 0 ? sum : 0.0f;
    result[c] = low < 1 ? low : 1.0f;
  }
  return result;
}

}  // namespace tessera::detail
