// Lighting equations in eye space: term by term in RGBA mode, and in colour-index mode.
#pragma once

#include <vector>

#include "scene.h"

namespace tessera::reference {

/// A light in eye space.
struct EyeLight {
  Vec4 ambient;
  Vec4 diffuse;
  Vec4 specular;
  bool directional = false;
  Vec3 position;         ///< eye space; unused if directional
  Vec3 direction;        ///< unit vector towards the light; unused unless directional
  bool is_spot = false;  ///< false for a cutoff of 180
  Vec3 spot_direction;   ///< unit; null if the scene's direction is null
  double cos_cutoff = -1;
  double spot_exponent = 0;
  std::array<double, 3> attenuation{1, 0, 0};
};

std::vector<EyeLight> lights_in_eye_space(const std::vector<Light>& lights, const Mat4& view_from_world);

/// Inputs of lighting at one point.
struct Surface {
  Vec3 position;  ///< eye space
  Vec3 normal;    ///< eye space, facing the lit side, not normalized here
  Material material;
};

/// Colour of a lit point, clamped to 0..1. Its alpha is that of the material's diffuse colour.
Vec4 lit_color(const Surface& surface, const LightModel& model, const std::vector<EyeLight>& lights);

/// Continuous palette index of a lit point, before masking.
/// @param indexes  ambient, diffuse and specular index
double lit_index(const Surface& surface, const std::array<double, 3>& indexes, const LightModel& model,
                 const std::vector<EyeLight>& lights);

/// Clamps every component to 0..1; NaN becomes 0.
Vec4 clamp01(Vec4 color);

}  // namespace tessera::reference
