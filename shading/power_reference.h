// The scalar twin of power-inl.h, and its specification.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "shading/power.h"

namespace tessera {

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
  const float safe = x > kSmallestNormal ? x : kSmallestNormal;
  const float product = log2_reference(safe) * y;
  const float low = product > -126.0f ? product : -126.0f;
  return exp2_reference(low < kLargestLog2 ? low : kLargestLog2);
}

inline float whole_power_reference(float x, int n) {
  if (!(x > 0.0f)) return 0.0f;
  const float least = exp2_reference(least_log2(n));
  float square = x > least ? x : least, product = 1;
  for (int rest = n; rest != 0; rest >>= 1, square *= square)
    if ((rest & 1) != 0) product *= square;
  return product < kLargestPower ? product : kLargestPower;
}

/// How kernels work out x^exponent: planned once, where they would work out `least` again for each batch.
inline Power power_with(float exponent) {
  const int whole = whole_power(exponent);
  return {exponent, whole, whole != 0 ? exp2_reference(least_log2(whole)) : 0};
}

/// x^0 is 1 whatever x is.
inline float power_of_reference(float x, float exponent) {
  if (const int whole = whole_power(exponent); whole != 0) return whole_power_reference(x, whole);
  return exponent == 0 ? 1.0f : power_reference(x, exponent);
}

}  // namespace tessera
