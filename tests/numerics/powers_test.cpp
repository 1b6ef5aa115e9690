// Logarithms and powers against long double, and against double where there are billions of them: the largest
// error in units in the last place (ulp) of the exact value, and relative to it. All instruction sets give
// the same bits (other tests compare them), so only the fastest is measured.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "shading/power.h"
#include "tests/numerics/bounds.h"
#include "tests/numerics/every_float.h"
#include "tests/shading/power_lanes.h"

namespace tessera::test::powers_test {
using namespace detail;
namespace {

using Exact = std::function<long double(float)>;

/// Largest error in ulp, and relative to the exact value.
struct Errors {
  long double ulp = 0;
  long double relative = 0;
  template <class Real>
  void add(float found, Real exact) {
    update_worst(ulp, ulps(found, exact));
    update_worst(relative, std::abs(found / exact - 1) * Real{0x1p24});
  }
};

std::vector<float> evaluated(PowerFunction function, float exponent, const std::vector<float>& arguments) {
  std::vector<float> results(arguments.size());
  evaluate_power(available_isas().front())(function, arguments.data(), exponent, results.data(),
                                           arguments.size());
  return results;
}

void measure(Errors& errors, PowerFunction function, std::uint32_t first, std::uint32_t last,
             const Exact& exact) {
  for_floats(first, last, [&](const std::vector<float>& arguments) {
    const std::vector<float> results = evaluated(function, 1, arguments);
    for (std::size_t i = 0; i < arguments.size(); ++i) errors.add(results[i], exact(arguments[i]));
  });
}

TEST(PowerFunctions, Logarithms) {
  const auto exact = [](float x) { return std::log2(static_cast<long double>(x)); };
  Errors errors;
  // 1 is skipped: log2(1) is exactly 0.
  measure(errors, PowerFunction::log2, bits_of(kMinNormal), bits_of(1) - 1, exact);
  measure(errors, PowerFunction::log2, bits_of(1) + 1, bits_of(3.4028234e38f), exact);
  expect_within("log2(x), normal x", errors.ulp, 1.61, "ulp");
  expect_within("log2(x), normal x, relative", errors.relative, 2.09, "2^-24");
}

TEST(PowerFunctions, PowersOfTwo) {
  const auto exact = [](float x) { return std::exp2(static_cast<long double>(x)); };
  Errors errors;
  measure(errors, PowerFunction::exp2, 0, bits_of(kMaxLog2), exact);
  measure(errors, PowerFunction::exp2, bits_of(-0.0f), bits_of(-126.0f), exact);
  expect_within("2^x, x in -126 .. 96", errors.ulp, 1.2, "ulp");
}

/// Errors of powers of x in 0 .. 1, for powers of at least 1/256 and for all normal powers.
struct PowerErrors {
  Errors visible;
  Errors any;
  template <class Real>
  void add(float y, const std::vector<float>& arguments) {
    const std::vector<float> results = evaluated(PowerFunction::power, y, arguments);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const Real exact = std::pow(static_cast<Real>(arguments[i]), static_cast<Real>(y));
      if (exact < 0x1.02p-126L) continue;  // clamped to 2^-126
      any.add(results[i], exact);
      if (exact >= 0x1p-8L) visible.add(results[i], exact);
    }
  }
  // p = y log2 x has the error of the logarithm, 2.09 u of p (u = 2^-24), and another half ulp: 64 u
  // for |p| between 64 and 128, 4 u between 4 and 8. 2^p is off by ln 2 times that plus its own 1.2 ulp, at
  // most 2.4 u: (2.09 * 126 + 64) ln 2 + 2.4 = 229.4 and (2.09 * 8 + 4) ln 2 + 2.4 = 16.8. An ulp is between
  // u and 2 u; where it is u, the error of 2^p counts 1.2: 228.2 and 15.6.
  void expect(const std::string& power) const {
    expect_within(power + " of at least 1/256, relative", visible.relative, 16.8L, "2^-24");
    expect_within(power + " of at least 1/256", visible.ulp, 15.6L, "ulp");
    expect_within(power + ", relative", any.relative, 229.4L, "2^-24");
    expect_within(power, any.ulp, 228.2L, "ulp");
  }
};

/// Distance of the sampled arguments in floats. Large exponents have few arguments with a normal power.
std::uint32_t step_of(float y) {
  if (y > 5000) return 1;
  return y > 500 ? 7 : kSampled;
}

// Exponents 0 .. 16384. For large exponents, every float close enough to 1 to have a normal power. One test
// per exponent: with TESSERA_LONG up to a billion floats each. The exact value is therefore a double here,
// which is itself off by about 2^-28 of a float's ulp.
class RealPowers : public testing::TestWithParam<float> {};
TEST_P(RealPowers, AreWithinTheirErrorBounds) {
  const float y = GetParam();
  PowerErrors errors;
  const auto least = std::max(static_cast<float>(std::exp2(-126 / static_cast<double>(y))), kMinNormal);
  for_floats(
      bits_of(least), bits_of(1),
      [&](const std::vector<float>& arguments) { errors.add<double>(y, arguments); }, step_of(y));
  errors.expect("x^" + std::to_string(y).substr(0, 5));
}
INSTANTIATE_TEST_SUITE_P(Exponents, RealPowers,
                         testing::Values(0.25f, 0.5f, 2.0f, 20.0f, 128.0f, 1000.0f, 7661.0f, 10000.0f,
                                         16384.0f));

// Exponents spaced evenly in 0 .. 16384 and evenly in their logarithms; powers spaced evenly in their
// logarithms.
TEST(PowerFunctions, PowersOfAnyExponent) {
  std::mt19937 random(9);
  const auto unit = [&] { return static_cast<double>(random()) * 0x1p-32; };
  PowerErrors errors;
  for (int n = 0; n < (long_tests() ? 1000000 : 10000); ++n) {
    const auto y = static_cast<float>(n % 2 == 0 ? 16384 * unit() : std::exp2(28 * unit() - 14));
    std::vector<float> arguments(48);
    for (float& x : arguments)
      x = std::clamp(
          static_cast<float>(std::exp2((random() % 4 == 0 ? -8 : -126) * unit() / static_cast<double>(y))),
          kMinNormal, 1.0f);
    errors.add<long double>(y, arguments);
  }
  errors.expect("x^y, y in 0 .. 16384");
}

// Products: x^a x^b has the errors of its factors, a - 1 and b - 1 roundings of u, and its own rounding. The
// ranges of exponents contain about equally many floats, a billion with TESSERA_LONG; the exact value is a
// double here, too.
struct WholeExponents {
  int first, last;
};
class IntegerPowers : public testing::TestWithParam<WholeExponents> {};
TEST_P(IntegerPowers, AreWithinTheirErrorBounds) {
  const auto [first, last] = GetParam();
  double share = 0;
  for (int n = first; n <= last; ++n)
    for_floats(
        bits_of(static_cast<float>(std::exp2(-125.98 / n))), bits_of(1),
        [&](const std::vector<float>& arguments) {
          const std::vector<float> results =
              evaluated(PowerFunction::chosen, static_cast<float>(n), arguments);
          for (std::size_t i = 0; i < arguments.size(); ++i)
            update_worst(share,
                         std::abs(results[i] / std::pow(double{arguments[i]}, n) - 1) * (0x1p24 / (n - 1)));
        },
        kSampled * 16);
  expect_within("x^n, n = " + std::to_string(first) + " .. " + std::to_string(last) + ", relative", share, 1,
                "(n - 1) 2^-24");
}
INSTANTIATE_TEST_SUITE_P(Exponents, IntegerPowers,
                         testing::Values(WholeExponents{2, 4}, WholeExponents{5, 8}, WholeExponents{9, 16},
                                         WholeExponents{17, 32}, WholeExponents{33, kMaxIntegerExponent}),
                         [](const auto& range) {
                           return "From" + std::to_string(range.param.first) + "To" +
                                  std::to_string(range.param.last);
                         });

// Subnormal arguments count as the smallest normal float. 0 has the power 0.
TEST(PowerFunctions, PowersOfSubnormalFloats) {
  std::vector<float> subnormal{0x1p-149f};
  while (subnormal.size() < 16)
    subnormal.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(0x7fffff * subnormal.size() / 15)));
  for (const float y : {0x1p-10f, 0.5f, 0.75f, 1.0f, 16384.0f}) {
    const float smallest = evaluated(PowerFunction::power, y, std::vector<float>(16, kMinNormal))[0];
    EXPECT_LE(ulps(smallest, std::exp2(std::max(-126.0L * y, -126.0L))), 228.2L) << y;
    EXPECT_EQ(evaluated(PowerFunction::power, y, subnormal), std::vector<float>(16, smallest)) << y;
    EXPECT_EQ(evaluated(PowerFunction::power, y, std::vector<float>(16, 0.0f)), std::vector<float>(16, 0.0f))
        << y;
  }
}

}  // namespace
}  // namespace tessera::test::powers_test
