#include "planar_shadow.h"

#include <cmath>

namespace tessera::reference {

// M = (p.l) I - l p^T. A point x gets w = (p.l) x.w - (p.x) l.w. Between the light and the plane p.x is
// between p.l and 0, so w has the sign of p.l; M is negated if p.l is negative.
std::optional<Mat4> shadow_matrix(Vec4 plane, const Light& light) {
  constexpr double kNull = 1e-12;  // relative to the terms of p.l, against rounding
  const std::array<double, 4> p{plane.x, plane.y, plane.z, plane.w};
  const double scale = light.position.w != 0 ? 1 / light.position.w : 1;
  const std::array<double, 4> l{scale * light.position.x, scale * light.position.y, scale * light.position.z,
                                scale * light.position.w};
  double distance = 0;
  double terms = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    distance += p[i] * l[i];
    terms += std::abs(p[i] * l[i]);
  }
  if (length(xyz(plane)) == 0 || std::abs(distance) <= kNull * terms) return std::nullopt;
  Mat4 m;
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c)
      m.rows[r][c] = std::copysign(1.0, distance) * ((r == c ? distance : 0) - l[r] * p[c]);
  return m;
}

}  // namespace tessera::reference
