// Proofs that a light adds exactly nothing to a surface, from bounds of its points and normals.
//
// The kernel adds nothing for a light where
//   - n.L <= 0: neither diffuse nor specular light; the ambient part remains
//   - the point is outside the light's cone: no part at all
// The proofs bound n.L and the distance from the cone over boxes, in doubles. They ask for margins that
// exceed every rounding of the kernel, which works with floats: positions, normals, their interpolation and
// L.
#pragma once

#include <array>
#include <cstdint>

#include "shading/lighting.h"

namespace tessera::detail {

/// Vectors within `half` of `center`, per component. @pre all values are finite
struct VectorBox {
  std::array<double, 3> center{}, half{};
  /// Upper bound of the magnitudes of all terms that were summed to compute a vector of the box.
  double magnitude = 0;
};

/// Bounds of the points of a surface in eye space. Normals have any length.
struct SurfaceBounds {
  VectorBox positions, normals;
};

/// Whether n.L < 0 for every normal and position of the bounds.
/// @param back  for normals turned round
bool is_light_behind(const EyeLight& light, const SurfaceBounds& bounds, bool back);

/// Whether every position of the box is outside the cone of a light. False for lights without a cone, and for
/// directional lights, whose cone is planned with their colours.
bool is_outside_cone(const EyeLight& light, const VectorBox& positions);

}  // namespace tessera::detail
