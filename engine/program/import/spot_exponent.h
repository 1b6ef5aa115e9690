// Spots whose light falls off between two angles, as an exponent.
#pragma once

#include <algorithm>
#include <cmath>

namespace tessera::program {

/// glTF's ramp, the square of (cos t - cos outer) / (cos inner - cos outer), is 1/2 at some angle t;
/// cos(t)^exponent is too. Angles in radians. 0 where there is no such exponent.
inline float spot_exponent_from_cone(double inner, double outer) {
  constexpr double kMaxExponent = 16384;
  const double cosine = std::cos(outer) + std::sqrt(0.5) * (std::cos(inner) - std::cos(outer));
  if (!(cosine > 0 && cosine < 1)) return 0;
  return static_cast<float>(std::min(std::log(0.5) / std::log(cosine), kMaxExponent));
}

}  // namespace tessera::program
