// Colour spaces and colour differences of FLIP (Andersson and others, FLIP: A Difference Evaluator for
// Alternating Images, High Performance Graphics 2020), in double precision.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "framebuffer/srgb.h"

namespace tessera::program {

using Vector3 = std::array<double, 3>;
using Matrix3 = std::array<Vector3, 3>;  // rows

constexpr Vector3 operator*(const Matrix3& m, const Vector3& v) {
  Vector3 product{};
  for (std::size_t i = 0; i < 3; ++i) product[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return product;
}

constexpr Matrix3 inverse(const Matrix3& m) {
  const auto cofactor = [&m](std::size_t i, std::size_t j) {
    const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    return m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
  };
  const double determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  Matrix3 result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[j][i] = cofactor(i, j) / determinant;
  return result;
}

/// Linear sRGB to CIE XYZ over the white point (NVIDIA's constants for D65). Each row sums to 1.
inline constexpr Matrix3 kXyzFromRgb{{{10135552.0 / 23359437, 8788810.0 / 23359437, 4435075.0 / 23359437},
                                      {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                      {1425312.0 / 80288307, 8788810.0 / 80288307, 70074185.0 / 80288307}}};
inline constexpr Matrix3 kRgbFromXyz = inverse(kXyzFromRgb);

/// Linear light of an sRGB level of 255.
inline double linear_from_level(int level) { return detail::linear_from_srgb(level / 255.0); }

/// Luminance and the opponent axes red-green and blue-yellow: (y, x - y, y - z), with XYZ over white.
/// - YCxCz is (116 y - 16, 500 (x - y), 200 (y - z)). FLIP's filters are linear and their weights sum to 1,
///   so factors and offsets are left out.
constexpr Vector3 opponent_from_rgb(const Vector3& rgb) {
  const Vector3 xyz = kXyzFromRgb * rgb;
  return {xyz[1], xyz[0] - xyz[1], xyz[1] - xyz[2]};
}
/// Linear sRGB, clamped to 0 .. 1.
inline Vector3 rgb_from_opponent(const Vector3& opponent) {
  const double y = opponent[0];
  Vector3 rgb = kRgbFromXyz * Vector3{y + opponent[1], y, y - opponent[2]};
  for (double& component : rgb) component = std::clamp(component, 0.0, 1.0);
  return rgb;
}

/// CIELAB (CIE 15) of linear sRGB, with a and b scaled for the Hunt effect: a, b times 0.01 L.
inline Vector3 hunt_lab_from_rgb(const Vector3& rgb) {
  constexpr double kDelta = 6.0 / 29;
  const auto f = [](double t) {
    return t > kDelta * kDelta * kDelta ? detail::nth_root<3>(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
  };
  const Vector3 xyz = kXyzFromRgb * rgb;
  const double fx = f(xyz[0]), fy = f(xyz[1]), fz = f(xyz[2]);
  const double lightness = 116 * fy - 16;
  const double hunt = 0.01 * lightness;
  return {lightness, hunt * (500 * (fx - fy)), hunt * (200 * (fy - fz))};
}

/// HyAB distance to the power 0.7. HyAB: Abasi and others, Color Research and Application 45, 2020.
inline double powered_hyab(const Vector3& a, const Vector3& b) {
  const double da = a[1] - b[1], db = a[2] - b[2];
  const double hyab = std::abs(a[0] - b[0]) + std::sqrt(da * da + db * db);
  const double fifth_root = detail::nth_root<5>(hyab);
  return fifth_root * fifth_root * fifth_root * std::sqrt(fifth_root);  // 3.5 / 5 = 0.7
}

/// Maps a powered HyAB distance to 0 .. 1: 0 .. 0.4 of the largest to 0 .. 0.95, the rest to 0.95 .. 1.
/// @param largest  distance of green and blue
inline double color_error(double distance, double largest) {
  constexpr double kCut = 0.4, kCutError = 0.95;
  const double cut = kCut * largest;
  if (distance < cut) return kCutError / cut * distance;
  return kCutError + (distance - cut) / (largest - cut) * (1 - kCutError);
}

/// color_error^(1 - feature_error), both 0 .. 1.
inline double combined_error(double color_error, double feature_error) {
  return color_error > 0 ? detail::exponential((1 - feature_error) * detail::natural_log(color_error)) : 0;
}

}  // namespace tessera::program
