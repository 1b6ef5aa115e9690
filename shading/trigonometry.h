// Sines and cosines of degrees for scene set-up, in double, by a fixed sequence of operations, so that
// pictures do not depend on the host's mathematics library. Error below 1e-15.
#pragma once

#include <cmath>

namespace tessera::detail {

struct SineCosine {
  double sine, cosine;
};

/// Takes any finite angle. Exact for multiples of 90.
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

}  // namespace tessera::detail
