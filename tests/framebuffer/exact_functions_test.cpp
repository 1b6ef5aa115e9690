// Roots, logarithm and exponential, compared with long double.
#include "framebuffer/exact_functions.h"
#include "framebuffer/srgb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tessera::detail::exact_functions_test {
namespace {

/// Calls check(x) for numbers spread evenly over exponents from 2^min to 2^max.
template <class Check>
void for_numbers(double min_exponent, double max_exponent, const Check& check) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const double unit = static_cast<double>(random() >> 11) * 0x1p-53;
    check(std::exp2(min_exponent + (max_exponent - min_exponent) * unit));
  }
}

TEST(ExactFunctions, RootsAreWithinTheirErrors) {
  EXPECT_EQ(nth_root<3>(0), 0);
  EXPECT_EQ(nth_root<3>(1), 1);
  EXPECT_EQ(nth_root<5>(1), 1);
  for_numbers(-300, 300, [](double x) {
    const long double power = 1.0L / 5;
    EXPECT_NEAR(nth_root<3>(x) / static_cast<double>(std::cbrt(static_cast<long double>(x))), 1, 1e-15) << x;
    EXPECT_NEAR(nth_root<5>(x) / static_cast<double>(std::pow(static_cast<long double>(x), power)), 1, 1e-15)
        << x;
  });
}

TEST(ExactFunctions, LogarithmIsWithinItsErrors) {
  EXPECT_EQ(natural_log(1), 0);
  for_numbers(-1, 1, [](double x) {
    EXPECT_NEAR(natural_log(x), static_cast<double>(std::log(static_cast<long double>(x))), 1e-15) << x;
  });
  for_numbers(-1000, 1000, [](double x) {
    const auto expected = static_cast<double>(std::log(static_cast<long double>(x)));
    EXPECT_NEAR(natural_log(x), expected, 1e-15 * std::abs(expected) + 1e-15) << x;
  });
}

TEST(ExactFunctions, ExponentialIsWithinItsErrors) {
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(exponential(-701), 0);
  EXPECT_EQ(exponential(-1e300), 0);
  for_numbers(-60, std::log2(700.0), [](double x) {
    for (const double signed_x : {x, -x})
      EXPECT_NEAR(exponential(signed_x) / static_cast<double>(std::exp(static_cast<long double>(signed_x))),
                  1, 1e-13)
          << signed_x;
  });
}

TEST(ExactFunctions, SrgbCurvesInvertEachOther) {
  // Constants of IEC 61966-2-1, from long double.
  EXPECT_NEAR(linear_from_srgb(128 / 255.0), 0.215860500113899, 1e-14);
  EXPECT_NEAR(linear_from_srgb(188 / 255.0), 0.502886458032569, 1e-14);
  for (int level = 0; level <= 255; ++level)
    EXPECT_NEAR(srgb_from_linear(linear_from_srgb(level / 255.0)), level / 255.0, 2e-7) << level;
}

}  // namespace
}  // namespace tessera::detail::exact_functions_test
