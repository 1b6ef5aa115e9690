// Physically based materials in the terms of Phong's model.
#pragma once

#include <algorithm>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {

inline constexpr float kDielectricReflectance = 0.04f;  ///< glass and plastics, at normal incidence

/// Share of the specular reflection that roughness leaves.
inline float roughness_attenuation(float roughness) { return 1 / (1 + 4 * roughness * roughness); }

/// Blinn's exponent for a roughness: 2 / r^4 - 2, clamped to 1 to 1024.
inline float blinn_exponent(float roughness) {
  const float alpha = roughness * roughness;
  return alpha > 0 ? std::clamp(2 / (alpha * alpha) - 2, 1.0f, 1024.0f) : 1024.0f;
}

/// Base colour b, metalness m, roughness r:
///   diffuse = ambient = b, specular = (0.04 (1 - m) + b m) / (1 + 4 r^2)
inline Material metallic_material(const Color& base, float metalness, float roughness) {
  const auto reflectance = [&](float b) {
    return (kDielectricReflectance * (1 - metalness) + b * metalness) * roughness_attenuation(roughness);
  };
  return {.ambient = base,
          .diffuse = base,
          .specular = {reflectance(base.r), reflectance(base.g), reflectance(base.b), 1},
          .shininess = blinn_exponent(roughness)};
}

inline Material glossy_material(const Color& diffuse, const Color& specular, float glossiness) {
  const float roughness = 1 - glossiness, share = roughness_attenuation(roughness);
  return {.ambient = diffuse,
          .diffuse = diffuse,
          .specular = {specular.r * share, specular.g * share, specular.b * share, 1},
          .shininess = blinn_exponent(roughness)};
}

}  // namespace tessera::program
