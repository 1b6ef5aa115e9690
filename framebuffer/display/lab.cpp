// CIELAB and OKLab.
#include <cmath>

#include "framebuffer/exact_functions.h"
#include "framebuffer/tessera/color.hpp"

namespace tessera {
namespace {

double cube_root(double x) {
  const double magnitude = std::abs(x);
  return magnitude > 1e-300 ? std::copysign(detail::nth_root<3>(magnitude), x) : 0;
}
ColorValues cube_roots(const ColorValues& v) { return {cube_root(v[0]), cube_root(v[1]), cube_root(v[2])}; }
double cube(double x) { return x * x * x; }

// [CIE 15, 8.2.1]: a cube root from (6/29)^3 on, its tangent below.
constexpr double kDelta = 6.0 / 29;
double lab_response(double t) {
  return t > kDelta * kDelta * kDelta ? detail::nth_root<3>(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
}
double lab_response_inverse(double f) { return f > kDelta ? cube(f) : 3 * kDelta * kDelta * (f - 4.0 / 29); }

// [Ottosson, A perceptual color space for image processing, 2020], with the matrices of 2021-01-25.
constexpr ColorMatrix kConesFromLight{{{{.4122214708, .5363325363, .0514459929},
                                        {.2119034982, .6806995451, .1073969566},
                                        {.0883024619, .2817188376, .6299787005}}}};
constexpr ColorMatrix kOklabFromRoots{{{{.2104542553, .7936177850, -.0040720468},
                                        {1.9779984951, -2.4285922050, .4505937099},
                                        {.0259040371, .7827717662, -.8086757660}}}};

}  // namespace

ColorValues lab_from_xyz(const ColorValues& xyz, Chromaticity white) {
  const ColorValues w = xyz_of(white);
  const double fx = lab_response(xyz[0] / w[0]);
  const double fy = lab_response(xyz[1] / w[1]);
  const double fz = lab_response(xyz[2] / w[2]);
  return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

ColorValues xyz_from_lab(const ColorValues& lab, Chromaticity white) {
  const ColorValues w = xyz_of(white);
  const double fy = (lab[0] + 16) / 116;
  return {w[0] * lab_response_inverse(fy + lab[1] / 500), w[1] * lab_response_inverse(fy),
          w[2] * lab_response_inverse(fy - lab[2] / 200)};
}

ColorValues oklab_from_light(const ColorValues& light) {
  return kOklabFromRoots * cube_roots(kConesFromLight * light);
}

ColorValues light_from_oklab(const ColorValues& oklab) {
  static const ColorMatrix roots_from_oklab = inverse(kOklabFromRoots);
  static const ColorMatrix light_from_cones = inverse(kConesFromLight);
  const ColorValues roots = roots_from_oklab * oklab;
  return light_from_cones * ColorValues{cube(roots[0]), cube(roots[1]), cube(roots[2])};
}

}  // namespace tessera
