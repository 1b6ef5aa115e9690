// Powers with real exponents, the same bits on every machine.
#pragma once

#include <algorithm>

#include "framebuffer/exact_functions.h"

namespace tessera::detail {

/// x to the power of `exponent`; 0 for x up to 1e-300.
/// - Relative error: below 2e-13 + 2e-15 |exponent log x|. Powers of 1 are exact.
/// - Results are at most e^690, about 1e299, and 0 below e^-700.
inline double power(double x, double exponent) {
  return x > 1e-300 ? exponential(std::min(exponent * natural_log(x), 690.0)) : 0;
}

}  // namespace tessera::detail
