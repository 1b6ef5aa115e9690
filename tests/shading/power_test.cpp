// x^y, log2 and 2^x: bit-identical to their scalar twins on every instruction set, and their error.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "shading/power_reference.h"
#include "tests/numerics/bounds.h"
#include "tests/raster/tile_harness.h"
#include "tests/shading/power_lanes.h"

namespace tessera::test::power_test {
using namespace detail;
namespace {

constexpr float kExponents[] = {0.5f, 1, 2, 20, 128, 1000, 16384};

// Floats with every exponent: mantissas at both ends of the range, around that of sqrt(2), and random ones.
// Among them are infinity and NaN.
std::vector<float> all_magnitudes() {
  std::vector<float> values;
  std::mt19937 random(1);
  for (std::uint32_t exponent = 0; exponent <= 255; ++exponent) {
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t mantissa = 0;
      if (i < 4) mantissa = i;
      else if (i < 8) mantissa = 0x7fffff - (i - 4);
      else if (i < 12) mantissa = 0x3504f3 + i - 10;
      else mantissa = static_cast<std::uint32_t>(random()) & 0x7fffff;
      values.push_back(std::bit_cast<float>(exponent << 23 | mantissa));
      if (i % 8 == 0) values.push_back(-values.back());
    }
  }
  while (values.size() % 16 != 0) values.push_back(0);
  return values;
}

// Arguments as in lighting: cosines, many of them near 1.
std::vector<float> cosines() {
  std::vector<float> values;
  for (int i = 0; i < 200000; ++i) values.push_back(static_cast<float>(i) / 200000);
  for (int i = 0; i < 100000; ++i) values.push_back(1 - static_cast<float>(i) * 0x1p-24f);
  for (int i = 0; i <= 65536; ++i) values.push_back(std::exp2(-static_cast<float>(i) / 8192));
  while (values.size() % 16 != 0) values.push_back(1);
  return values;
}

std::vector<float> evaluate(PowerFunction function, const std::vector<float>& arguments, float exponent,
                            InstructionSet isa) {
  std::vector<float> results(arguments.size());
  evaluate_power(isa)(function, arguments.data(), exponent, results.data(), arguments.size());
  return results;
}

template <class Reference>
void expect_same_bits(PowerFunction function, const std::vector<float>& arguments, float exponent,
                      const Reference& reference) {
  for (const InstructionSet isa : available_isas()) {
    const std::vector<float> results = evaluate(function, arguments, exponent, isa);
    for (std::size_t i = 0; i < arguments.size(); ++i)
      ASSERT_EQ(std::bit_cast<std::uint32_t>(results[i]),
                std::bit_cast<std::uint32_t>(reference(arguments[i])))
          << name_of(isa) << ": " << arguments[i] << " to " << exponent << " is " << results[i] << ", not "
          << reference(arguments[i]);
  }
}

TEST(Power, MatchesTheScalarTwin) {
  for (const float y : {0x1p-20f, 0.1f, 0.5f, 1.0f, 2.0f, 20.0f, 76.8f, 128.0f, 1000.0f, 16384.0f}) {
    expect_same_bits(PowerFunction::power, all_magnitudes(), y,
                     [y](float x) { return power_reference(x, y); });
    expect_same_bits(PowerFunction::power, cosines(), y, [y](float x) { return power_reference(x, y); });
  }
}

// Integer exponents up to the largest use products; larger and fractional ones do not.
TEST(Power, MethodMatchesTheScalarTwin) {
  for (const float y :
       {0.0f, 0.5f, 1.0f, 2.0f, 3.0f, 25.0f, 25.5f, 31.0f, 63.0f, 64.0f, 64.5f, 65.0f, 1000.0f}) {
    expect_same_bits(PowerFunction::chosen, all_magnitudes(), y,
                     [y](float x) { return power_of_reference(x, y); });
    expect_same_bits(PowerFunction::chosen, cosines(), y, [y](float x) { return power_of_reference(x, y); });
    EXPECT_EQ(integer_exponent(y) != 0, y >= 1 && y <= 64 && y == std::floor(y)) << y;
  }
  EXPECT_EQ(integer_exponent(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(power_of_reference(0.75f, 3), 0.421875f);
}

// Products of one-digit numbers are exact, and no intermediate product is subnormal.
TEST(Power, IntegerPowersOfShortNumbersAreExact) {
  for (int n = 1; n <= kMaxIntegerExponent; ++n) {
    for (const float tiny : {0x1p-149f, 0x1p-126f, exp2_reference(-126.1f / static_cast<float>(n))}) {
      const float smallest = integer_power_reference(tiny, n);
      EXPECT_TRUE(smallest >= kMinNormal && smallest <= 1.01f * kMinNormal) << n << ": " << smallest;
    }
    for (int e = -1; e * n >= -125; --e)
      EXPECT_EQ(integer_power_reference(std::ldexp(1.0f, e), n), std::ldexp(1.0f, e * n)) << n;
    EXPECT_EQ(integer_power_reference(1, n), 1.0f);
    EXPECT_EQ(integer_power_reference(0x1p90f, n), n == 1 ? 0x1p90f : 0x1p96f) << n;
    EXPECT_EQ(integer_power_reference(std::numeric_limits<float>::infinity(), n), 0x1p96f) << n;
    for (const float x :
         {0.0f, -1.0f, -std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
      EXPECT_EQ(integer_power_reference(x, n), 0.0f) << n;
  }
}

TEST(Power, Log2MatchesTheScalarTwin) {
  std::vector<float> arguments;
  for (const float x : all_magnitudes())
    if (std::isnormal(x) && x > 0) arguments.push_back(x);
  while (arguments.size() % 16 != 0) arguments.push_back(1);
  expect_same_bits(PowerFunction::log2, arguments, 1, [](float x) { return log2_reference(x); });
  long double worst = 0;
  for (const float x : arguments) {
    const long double exact = std::log2(static_cast<long double>(x));
    if (exact != 0) update_worst(worst, std::abs((log2_reference(x) - exact) / exact));
  }
  std::printf("[  figure  ] log2, largest relative error: %.3Lg\n", worst);
  EXPECT_LE(worst, 9.2e-8L);
}

TEST(Power, Exp2MatchesTheScalarTwin) {
  std::vector<float> arguments;
  for (int i = -126 * 512; i <= 127 * 512; ++i)
    arguments.push_back(static_cast<float>(i) / 512 + (i % 3 != 0 && i < 127 * 512 ? 0.0007f : 0));
  while (arguments.size() % 16 != 0) arguments.push_back(0);
  expect_same_bits(PowerFunction::exp2, arguments, 1, [](float x) { return exp2_reference(x); });
  long double worst = 0;
  for (const float x : arguments) {
    const long double exact = std::exp2(static_cast<long double>(x));
    update_worst(worst, std::abs((exp2_reference(x) - exact) / exact));
  }
  std::printf("[  figure  ] exp2, largest relative error: %.3Lg\n", worst);
  EXPECT_LE(worst, 7.2e-8L);
}

TEST(Power, IsExactAtOneAndPowersOfTwo) {
  for (const float y : kExponents) EXPECT_EQ(power_reference(1, y), 1.0f);
  for (int e = -63; e <= 48; ++e) EXPECT_EQ(power_reference(std::ldexp(1.0f, e), 2), std::ldexp(1.0f, 2 * e));
}

TEST(Power, NonPositiveBasesYieldZero) {
  for (const float x :
       {0.0f, -0.0f, -1.0f, -std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    for (const float y : kExponents) EXPECT_EQ(power_reference(x, y), 0.0f);
}

// x^y = 2^p, p = y log2 x. log2 is off by at most 9.1e-8 of itself (measured above), and its product with y
// by 2^-24 more: p is off by 1.5e-7 |p|. That is a relative error of 1.1e-7 |p| in the result, or up to
// 1.8 |p| units in the last place, plus one or two from 2^p. For visible results |p| is at most 8, and the
// errors rarely all reach their maximum at once. The bounds for all powers are 15.6 and 228.2
// (tests/numerics/README.md); these exponents are held to 14 and 160. The absolute error peaks where |p| 2^p
// does: at 1.1e-7 / (e ln 2) + 6e-8.
TEST(Power, IsWithinItsErrorBounds) {
  for (const float y : kExponents) {
    double absolute = 0, visible = 0, any = 0;
    for (const float x : cosines()) {
      const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(y));
      if (exact < 0x1p-126L) continue;
      const float power = power_reference(x, y);
      const int exponent = std::ilogb(static_cast<float>(exact));
      const auto error = static_cast<double>(std::abs(power - exact));
      const double error_ulp = error / std::ldexp(1.0, exponent - 23);
      update_worst(absolute, error);
      update_worst(any, error_ulp);
      if (exact >= 1 / 256.0L) update_worst(visible, error_ulp);
    }
    std::printf(
        "[  figure  ] x^%g for x in 0..1: absolute error at most %.3g, %.3g ulp where it is at least 1/256, "
        "%.4g ulp anywhere\n",
        y, absolute, visible, any);
    EXPECT_LE(absolute, 1.0e-7);
    EXPECT_LE(visible, 14);
    EXPECT_LE(any, 160);
  }
}

}  // namespace
}  // namespace tessera::test::power_test
