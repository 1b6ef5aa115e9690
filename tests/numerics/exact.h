// Quotients of 128-bit integers: the exact value of a double, and its rounding.
#pragma once

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

namespace tessera::test {

__extension__ typedef __int128 Int128;

/// Not reduced; the denominator is above 0.
struct Ratio {
  Int128 numerator = 0;
  Int128 denominator = 1;

  /// @pre |value| is 0 or has no bit below 2^-100, and is below 2^30
  static Ratio of(double value) {
    if (value == 0) return {};
    int exponent = 0;
    auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    exponent -= 53;
    for (; mantissa % 2 == 0; mantissa /= 2) ++exponent;
    EXPECT_TRUE(exponent > -100 && exponent < 30) << value;
    return exponent >= 0 ? Ratio{Int128{mantissa} << exponent, 1} : Ratio{mantissa, Int128{1} << -exponent};
  }
  friend Ratio operator*(Ratio a, std::int64_t b) { return {a.numerator * b, a.denominator}; }
  friend Ratio operator/(Ratio a, std::int64_t b) { return {a.numerator, a.denominator * b}; }

  Int128 floor() const { return numerator / denominator - (numerator % denominator < 0 ? 1 : 0); }
  /// Nearest integer, halves up.
  Int128 rounded() const { return Ratio{2 * numerator + denominator, 2 * denominator}.floor(); }
  /// Distance of an integer from the quotient.
  long double distance(Int128 whole) const {
    const Int128 off = whole * denominator - numerator;
    return static_cast<long double>(off < 0 ? -off : off) / static_cast<long double>(denominator);
  }
};

}  // namespace tessera::test
