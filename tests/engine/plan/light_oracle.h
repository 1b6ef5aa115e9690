// Where a draw is lit, and what a light adds there: double precision, from the arrays of the scene and the
// formulas of the lighting equation. Shares no code with the engine.
#pragma once

#include <vector>

#include "tests/reference/lighting.h"
#include "tests/reference/scene.h"

namespace tessera::test {

/// A point in eye space at which the colour of a face is evaluated.
struct LitPoint {
  reference::Vec3 position;
  reference::Vec3 normal;  ///< towards the lit side
};

/// Points at which a draw is lit, from the fragments that its primitives produce inside of the scissor,
/// before any test: per face, [0] front, [1] back under two-sided lighting.
/// - Phong: the centre of each fragment's pixel
/// - Gouraud: all corners of each primitive with a fragment
/// - Flat: its provoking corner
struct LitPoints {
  std::vector<LitPoint> face[2];
};
/// @pre the mesh has no vertex colours, and the scene has one camera
LitPoints lit_points(const reference::Scene& scene, const reference::Draw& draw);

/// Contribution of one light to a surface at a point.
struct LightAtPoint {
  reference::Vec3 ambient;  ///< times attenuation and spot
  reference::Vec3 diffuse_and_specular;
  // Degrees by which the light misses the point, for either reason; at most 0 if it does not.
  double behind_by = 0;   ///< angle between n and L, less 90; 0 if an ambient part reaches the point
  double outside_by = 0;  ///< angle to the axis of the cone, less its cutoff; 0 without a cone
};

/// Evaluates one light on many points of one material.
class LightOracle {
 public:
  LightOracle(const reference::EyeLight& light, double cutoff_degrees, const reference::Material& material,
              const reference::LightModel& model);

  LightAtPoint at(const LitPoint& point) const;
  bool is_directional() const { return light_.directional; }
  /// Whether the light has an ambient part that depends on the point.
  bool has_varying_ambient() const;

 private:
  reference::EyeLight light_;
  double cutoff_;                                 // degrees
  reference::Vec3 ambient_, diffuse_, specular_;  // colours of the light times those of the material
  double shininess_;
  reference::LightModel model_;
};

}  // namespace tessera::test
