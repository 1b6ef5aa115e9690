// The scalar twin of power-inl.h, and its specification.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "shading/power.h"

namespace tessera::detail {

inline float log2_reference(float x) {
  std::int32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  const std::int32_t exponent = (bits - kSqrtHalfBits) >> 23;
  const std::int32_t mantissa_bits = bits - exponent * (1 << 23);
  float m;
  std::memcpy(&m, &mantissa_bits, sizeof m);
  const float t = m - 1.0f;
  float p = 0;
  for (const float c : kLog2Coefficients) p = std::fma(p, t, c);
  return std::fma(p, t, static_cast<float>(exponent));
}

inline float exp2_reference(float x) {
  const float whole = std::nearbyint(x);
  const float t = x - whole;
  float p = 0;
  for (const float c : kExp2Coefficients) p = std::fma(p, t, c);
  return std::ldexp(p, static_cast<int>(whole));
}

inline float power_reference(float x, float y) {
  if (!(x > 0.0f)) return 0.0f;
  const float safe = x > kMinNormal ? x : kMinNormal;
  const float product = log2_reference(safe) * y;
  const float at_least_min = product > -126.0f ? product : -126.0f;
  return exp2_reference(at_least_min < kMaxLog2 ? at_least_min : kMaxLog2);
}

inline float integer_power_reference(float x, int n) {
  if (!(x > 0.0f)) return 0.0f;
  const float min_base = exp2_reference(min_base_log2(n));
  float square = x > min_base ? x : min_base;
  float product = 1;
  for (int rest = n; rest != 0; rest >>= 1, square *= square)
    if ((rest & 1) != 0) product *= square;
  return product < kMaxPower ? product : kMaxPower;
}

/// Chooses the method for an exponent. Called once when lighting is planned.
inline Power make_power(float exponent) {
  const int whole = integer_exponent(exponent);
  return {exponent, whole, whole != 0 ? exp2_reference(min_base_log2(whole)) : 0};
}

/// x^exponent as kernels compute it. x^0 is 1 for any x.
inline float power_of_reference(float x, float exponent) {
  if (const int whole = integer_exponent(exponent); whole != 0) return integer_power_reference(x, whole);
  return exponent == 0 ? 1.0f : power_reference(x, exponent);
}

}  // namespace tessera::detail
