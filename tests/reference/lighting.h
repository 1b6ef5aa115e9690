// The lighting equations in eye space, in RGBA mode term by term, and in colour-index mode.
#pragma once

#include <vector>

#include "scene.h"

namespace tessera::reference {

/// A light as a camera sees it.
struct EyeLight {
  Vec4 ambient, diffuse, specular;
  bool directional = false;
  Vec3 position;         ///< eye space; unused if directional
  Vec3 direction;        ///< unit vector towards the light; unused unless directional
  bool is_spot = false;  ///< its cutoff is not 180
  Vec3 spot_direction;   ///< unit, or null if the scene gives a null one
  double cos_cutoff = -1;
  double spot_exponent = 0;
  std::array<double, 3> attenuation{1, 0, 0};
};

std::vector<EyeLight> lights_in_eye_space(const std::vector<Light>& lights, const Mat4& view_from_world);

/// What one lit point is lit with.
struct Surface {
  Vec3 position;  ///< eye space
  Vec3 normal;    ///< eye space, facing the lit side, used as it is
  Material material;
};

/// The colour of a lit point, clamped to 0..1; its alpha is that of the material's diffuse colour.
Vec4 lit_color(const Surface& surface, const LightModel& model, const std::vector<EyeLight>& lights);

/// The palette index of a lit point as a continuous value, not yet masked.
/// @param indexes  ambient, diffuse and specular index
double lit_index(const Surface& surface, const std::array<double, 3>& indexes, const LightModel& model,
                 const std::vector<EyeLight>& lights);

/// Clamps every component to 0..1; what is not a number counts as 0.
Vec4 clamp01(Vec4 color);

}  // namespace tessera::reference
