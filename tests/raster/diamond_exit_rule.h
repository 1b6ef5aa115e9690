// Literal implementation of the diamond-exit rule [GL 2.1, 3.4.1]: tests for each pixel whether the perturbed
// segment meets its open diamond and ends outside. In exact fractions whose numerators carry the e and e^2 of
// the perturbation.
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>
#include <utility>
#include <vector>

#include "raster/line_walk.h"

namespace tessera::test {
using namespace detail;

__extension__ using Wide = __int128;

// v[0] + v[1] e + v[2] e^2 with an infinitesimal e > 0.
struct Perturbed {
  std::array<Wide, 3> v{};
  Perturbed operator-(const Perturbed& o) const { return {{v[0] - o.v[0], v[1] - o.v[1], v[2] - o.v[2]}}; }
  Perturbed operator+(const Perturbed& o) const { return {{v[0] + o.v[0], v[1] + o.v[1], v[2] + o.v[2]}}; }
  Perturbed times(Wide k) const { return {{v[0] * k, v[1] * k, v[2] * k}}; }
  bool negative() const {
    if (v[0] != 0) return v[0] < 0;
    return v[1] != 0 ? v[1] < 0 : v[2] < 0;
  }
  friend bool operator<(const Perturbed& a, const Perturbed& b) { return (a - b).negative(); }
};
inline Perturbed whole(Wide n) { return {{n, 0, 0}}; }

struct PerturbedPoint {
  Perturbed x, y;
};
// Moves a point by (-e, -e^2), y up.
inline PerturbedPoint perturbed(LinePoint p) { return {{{p.x, -1, 0}}, {{p.y, 0, 1}}}; }

inline constexpr int kSigns[4][2] = {{1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

// Distance of a point from a pixel's centre along one of the four directions that bound a diamond.
inline Perturbed towards(const PerturbedPoint& p, int x, int y, const int (&sign)[2]) {
  return (p.x - whole(256 * x + 128)).times(sign[0]) + (p.y - whole(256 * y + 128)).times(sign[1]);
}
inline bool inside(const PerturbedPoint& p, int x, int y) {
  for (const auto& sign : kSigns)
    if (!(towards(p, x, y, sign) < whole(128))) return false;
  return true;
}

// True if a + t (b - a) is inside the diamond for some t in 0..1.
inline bool meets(const LinePoint& a, const LinePoint& b, int x, int y) {
  const PerturbedPoint from = perturbed(a);
  // Lower and upper bounds of t: numerators over positive denominators.
  struct Fraction {
    Perturbed numerator;
    Wide denominator;
  };
  std::vector<Fraction> above, below;
  for (const auto& sign : kSigns) {
    const Perturbed room = whole(128) - towards(from, x, y, sign);  // at t = 0
    const Wide speed = Wide{sign[0]} * (b.x - a.x) + Wide{sign[1]} * (b.y - a.y);
    if (speed == 0) {
      if (!(whole(0) < room)) return false;
    } else if (speed > 0) {
      below.push_back({room, speed});
    } else {
      above.push_back({room.times(-1), -speed});
    }
  }
  for (const Fraction& low : above) {
    if (!(low.numerator < whole(low.denominator))) return false;  // below 1
    for (const Fraction& high : below)
      if (!(low.numerator.times(high.denominator) < high.numerator.times(low.denominator))) return false;
  }
  for (const Fraction& high : below)
    if (!(whole(0) < high.numerator)) return false;
  return true;
}

/// Pixels of a line, in raster space, y down.
inline std::set<std::pair<int, int>> diamond_exit_pixels(const LinePoint& a, const LinePoint& b) {
  std::set<std::pair<int, int>> pixels;
  for (int y = (std::min(a.y, b.y) >> 8) - 1; y <= (std::max(a.y, b.y) >> 8) + 1; ++y)
    for (int x = (std::min(a.x, b.x) >> 8) - 1; x <= (std::max(a.x, b.x) >> 8) + 1; ++x)
      if (meets(a, b, x, y) && !inside(perturbed(b), x, y)) pixels.insert({x, y});
  return pixels;
}

}  // namespace tessera::test
