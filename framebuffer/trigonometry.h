// Sines, cosines and arc tangents in degrees, in double, by a fixed sequence of operations that IEEE 754
// rounds exactly, so that results do not depend on the host's mathematics library.
#pragma once

#include <cmath>
#include <initializer_list>

namespace tessera::detail {

struct SineCosine {
  double sine, cosine;
};

/// Takes any finite angle. Error below 1e-15; exact for multiples of 90.
inline SineCosine sine_cosine(double degrees) {
  const double turn = std::remainder(degrees, 360.0);  // exact
  const double quarter = std::floor(turn / 90.0 + 0.5);
  const double x = (turn - quarter * 90.0) * (3.14159265358979323846 / 180.0);  // within 45 degrees
  const double s = x * x;
  // Taylor series to x^17 and x^18: the next terms are below 2^-60.
  double sine = 1.0 / 355687428096000.0;
  for (const double c : {-1.0 / 1307674368000.0, 1.0 / 6227020800.0, -1.0 / 39916800.0, 1.0 / 362880.0,
                         -1.0 / 5040.0, 1.0 / 120.0, -1.0 / 6.0, 1.0})
    sine = std::fma(sine, s, c);
  sine *= x;
  double cosine = -1.0 / 6402373705728000.0;
  for (const double c : {1.0 / 20922789888000.0, -1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800.0,
                         1.0 / 40320.0, -1.0 / 720.0, 1.0 / 24.0, -0.5, 1.0})
    cosine = std::fma(cosine, s, c);
  switch (static_cast<int>(quarter) & 3) {
    case 0: return {sine, cosine};
    case 1: return {cosine, -sine};
    case 2: return {-sine, -cosine};
    default: return {-cosine, sine};
  }
}

/// Angle of the vector (x, y) to the x axis in degrees, 0 up to but not including 360; 0 for the vector (0,
/// 0).
/// - Error below 2e-13 degrees; multiples of 45 degrees are exact.
/// @pre x and y are finite
inline double direction_degrees(double y, double x) {
  const double width = std::abs(x), height = std::abs(y);
  if (width == 0 && height == 0) return 0;
  const bool is_steep = height > width;
  const double slope = is_steep ? width / height : height / width;  // 0 to 1
  // Around 45 degrees, atan t = 45 degrees - atan((1 - t) / (1 + t)). Then atan t = 2 atan(t / (1 + sqrt(1 +
  // t^2))).
  const bool is_diagonal = slope > 0.5;
  const double t = is_diagonal ? (1 - slope) / (1 + slope) : slope;  // at most 1/2
  const double half = t / (1 + std::sqrt(1 + t * t));                // at most 0.2361
  // atan h = h - h^3/3 + h^5/5 - ...: the first term left out, h^27/27, is below 1e-18.
  double sum = 0;
  for (int k = 25; k > 0; k -= 2) sum = (k % 4 == 1 ? 1.0 : -1.0) / k + half * half * sum;
  double degrees = 2 * half * sum * (180.0 / 3.14159265358979323846);
  if (is_diagonal) degrees = 45 - degrees;
  if (is_steep) degrees = 90 - degrees;
  if (x < 0) degrees = 180 - degrees;
  if (y < 0) degrees = 360 - degrees;
  return degrees < 360 ? degrees : 0;
}

}  // namespace tessera::detail
