// Roots, logarithm and exponential with the same bits on every machine. They consist of operations that
// IEEE 754 rounds exactly (+ - * / and square roots), without libm, whose results differ between versions.
// Requires rounding to nearest, the default, and no fused multiply-adds (-ffp-contract=off).
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace tessera::detail {

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
inline double natural_log(double x) {
  // x = m 2^k with m from sqrt(1/2) to sqrt(2); log m = 2 artanh s = 2 (s + s^3/3 + s^5/5 + ...) with
  // s = (m - 1) / (m + 1), |s| < 0.172. The first term left out is below 1e-18.
  constexpr int kTerms = 11;
  constexpr auto kReciprocals = [] {
    std::array<double, kTerms> list{};
    for (int i = 0; i < kTerms; ++i) list[static_cast<std::size_t>(i)] = 1.0 / (2 * i + 1);
    return list;
  }();
  const auto bits = std::bit_cast<std::uint64_t>(x);
  int exponent = static_cast<int>(bits >> 52) - 1023;
  double mantissa = std::bit_cast<double>((bits & 0xfffffffffffffu) | (std::uint64_t{1023} << 52));
  if (mantissa > std::numbers::sqrt2) {
    mantissa /= 2;
    ++exponent;
  }
  const double s = (mantissa - 1) / (mantissa + 1);
  double sum = 0;
  for (std::size_t i = kTerms; i-- > 0;) sum = sum * (s * s) + kReciprocals[i];
  return exponent * std::numbers::ln2 + 2 * s * sum;
}

/// e to the power x.
/// - Relative error: below 1e-13. 0 for x below -700.
/// @param x  at most 700
inline double exponential(double x) {
  // x = k log 2 + r with |r| < 0.35; e^r = 1 + r + r^2/2! + ... The first term left out is below 1e-17.
  if (x < -700) return 0;
  constexpr int kTerms = 14;
  constexpr auto kInverseFactorials = [] {
    std::array<double, kTerms> list{1.0};
    for (int i = 1; i < kTerms; ++i)
      list[static_cast<std::size_t>(i)] = list[static_cast<std::size_t>(i - 1)] / i;
    return list;
  }();
  const int k = static_cast<int>(x * std::numbers::log2e + (x < 0 ? -0.5 : 0.5));
  const double r = x - k * std::numbers::ln2;
  double sum = 0;
  for (std::size_t i = kTerms; i-- > 0;) sum = sum * r + kInverseFactorials[i];
  return sum * std::bit_cast<double>(static_cast<std::uint64_t>(1023 + k) << 52);
}

}  // namespace tessera::detail
