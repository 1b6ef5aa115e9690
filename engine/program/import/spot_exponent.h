// Conversions of the cone angles of spot lights.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera::program {

inline constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

/// Returns the exponent for which cos(t)^exponent is 1/2 at the angle t where glTF's ramp,
/// ((cos t - cos outer) / (cos inner - cos outer))^2, is 1/2; 0 if there is none. Angles in radians.
inline float spot_exponent_from_cone(double inner, double outer) {
  constexpr double kMaxExponent = 16384;
  const double cosine = std::cos(outer) + std::sqrt(0.5) * (std::cos(inner) - std::cos(outer));
  if (!(cosine > 0 && cosine < 1)) return 0;
  return static_cast<float>(std::min(std::log(0.5) / std::log(cosine), kMaxExponent));
}

}  // namespace tessera::program
