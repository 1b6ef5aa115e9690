// Constants of the power function; power-inl.h derives them.
#pragma once

#include <cstdint>

namespace tessera::detail {

inline constexpr std::int32_t kSqrtHalfBits = 0x3f3504f3;  ///< bits of sqrt(1/2) as a float
inline constexpr float kRoundingBias = 0x1.8p23f;          ///< added and subtracted, it rounds to an integer
inline constexpr float kMinNormal = 0x1p-126f;
inline constexpr float kMaxLog2 = 96.0f;
inline constexpr float kMaxPower = 0x1p96f;  ///< powers are clamped to this

/// Powers with whole exponents up to this are computed as products of squares.
inline constexpr int kMaxIntegerExponent = 64;
/// The exponent, if it is a whole number from 1 to kMaxIntegerExponent; otherwise 0.
constexpr int integer_exponent(float exponent) {
  const int whole = exponent >= 1 && exponent <= kMaxIntegerExponent ? static_cast<int>(exponent) : 0;
  return static_cast<float>(whole) == exponent ? whole : 0;
}
/// log2 of the smallest base for a whole exponent n: above -126 / n, so that no product is subnormal.
constexpr float min_base_log2(int whole) { return -125.99f / static_cast<float>(whole); }

/// An exponent, and the method to raise many numbers to it. Default: x^0.
struct Power {
  float exponent = 0;
  int whole = 0;       ///< integer_exponent(exponent)
  float min_base = 0;  ///< 2^min_base_log2(whole): smaller positive bases count as this
};

inline constexpr int kLog2Terms = 10;
inline constexpr float kLog2Coefficients[kLog2Terms] = {
    -0.107497894181f, 0.184760333652f,  -0.191388376567f, 0.204857647786f,  -0.23960812191f,
    0.288552561437f,  -0.360696541808f, 0.480898520324f,  -0.721347354479f, 1.44269504f};
inline constexpr int kExp2Terms = 7;
inline constexpr float kExp2Coefficients[kExp2Terms] = {0.000154614446986f,
                                                        0.00134004281776f,
                                                        0.00961805667852f,
                                                        0.0555032722667f,
                                                        0.240226509223f,
                                                        0.693147206703f,
                                                        1.0f};

}  // namespace tessera::detail
