#include "engine/program/compare/exact_functions.h"

#include <array>
#include <cstddef>
#include <numbers>

namespace tessera::program {

// x = m 2^k with m from sqrt(1/2) to sqrt(2); log m = 2 artanh s = 2 (s + s^3/3 + s^5/5 + ...) with
// s = (m - 1) / (m + 1), |s| < 0.172. The first term left out is below 1e-18.
double natural_log(double x) {
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

// x = k log 2 + r with |r| < 0.35; e^r = 1 + r + r^2/2! + ... The first term left out is below 1e-17.
double exponential(double x) {
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

}  // namespace tessera::program
