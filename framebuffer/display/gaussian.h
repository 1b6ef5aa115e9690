// Integrals of the Gaussian, the same bits on every machine.
#pragma once

#include <cmath>
#include <numbers>

#include "framebuffer/exact_functions.h"

namespace tessera::detail {

/// Full width at half maximum of a Gaussian over its standard deviation: 2 sqrt(2 ln 2).
inline constexpr double kFwhmPerSigma = 2.3548200450309493;

/// Density of the Gaussian of standard deviation 1.
inline double gaussian(double x) {
  return exponential(-x * x / 2) / (std::numbers::sqrt2 / std::numbers::inv_sqrtpi);
}

/// Integral of gaussian() from minus infinity to x.
/// - Absolute error: below 1e-13.
inline double gaussian_integral(double x) {
  // 1/2 + gaussian(x) (x + x^3 / 3 + x^5 / (3 5) + ...) [Abramowitz and Stegun, 26.2.11]. The terms have one
  // sign, so nothing cancels. Beyond 8, the rest is below 1e-15.
  if (x >= 8) return 1;
  if (x <= -8) return 0;
  double term = x, sum = x;
  for (int n = 3; term * term > sum * sum * 1e-34; n += 2) {
    term *= x * x / n;
    sum += term;
  }
  return 0.5 + gaussian(x) * sum;
}

/// Integral of gaussian_integral() from minus infinity to x.
inline double gaussian_ramp(double x) { return x * gaussian_integral(x) + gaussian(x); }

}  // namespace tessera::detail
