// Roots, logarithm and exponential with the same bits on every machine. They consist of operations that
// IEEE 754 rounds exactly (+ - * / and square roots), without libm, whose results differ between versions.
// Requires rounding to nearest, the default, and no fused multiply-adds (-ffp-contract=off).
#pragma once

#include <bit>
#include <cstdint>

namespace tessera::program {

/// The positive N-th root.
/// - Relative error: below 1e-15.
/// @param x  0, or a normal positive number
template <int N>
double nth_root(double x) {
  if (x == 0) return 0;
  // Halley's iteration for r^N = x cubes the relative error e, times (N^2 - 1) / 12. Seed: dividing the bits
  // of x by N divides its exponent, |e| < 0.07. After three steps |e| < 1e-20 for N up to 5, plus rounding.
  constexpr std::uint64_t kOne = std::uint64_t{1023} << 52;  // bits of 1.0
  const auto offset = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) - kOne);
  double r = std::bit_cast<double>(kOne + static_cast<std::uint64_t>(offset / N));
  for (int step = 0; step < 3; ++step) {
    double power = r;
    for (int i = 1; i < N; ++i) power *= r;
    r *= ((N - 1) * power + (N + 1) * x) / ((N + 1) * power + (N - 1) * x);
  }
  return r;
}

/// The natural logarithm.
/// - Absolute error: below 1e-15 for x from 1/2 to 2; relative error elsewhere: below 1e-15.
/// @param x  a normal positive number
double natural_log(double x);

/// e to the power x.
/// - Relative error: below 1e-13. 0 for x below -700.
/// @param x  at most 700
double exponential(double x);

}  // namespace tessera::program
