// Directions and sines in degrees, compared with long double.
#include "framebuffer/trigonometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace tessera::detail::trigonometry_test {
namespace {

constexpr long double kDegree = std::numbers::pi_v<long double> / 180;

TEST(Trigonometry, DirectionsAreWithinTheirErrors) {
  std::mt19937_64 random(1);
  const auto signed_unit = [&random] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  for (int i = 0; i < 200000; ++i) {
    // Magnitudes of different exponents, so that slopes near 0 and near 1 occur.
    const double x = std::ldexp(signed_unit(), i % 7), y = std::ldexp(signed_unit(), i % 5);
    const long double angle = std::atan2(static_cast<long double>(y), static_cast<long double>(x)) / kDegree;
    const auto expected = static_cast<double>(angle < 0 ? angle + 360 : angle);
    ASSERT_NEAR(direction_degrees(y, x), expected, 2e-13) << y << " " << x;
  }
}

TEST(Trigonometry, MultiplesOf45DegreesAreExact) {
  const struct {
    double y, x, degrees;
  } kCases[] = {{0, 0, 0},    {0, 2, 0},     {3, 3, 45},   {5, 0, 90},   {1, -1, 135},
                {0, -1, 180}, {-2, -2, 225}, {-1, 0, 270}, {-4, 4, 315}, {-1e-300, 1, 0}};
  for (const auto& [y, x, degrees] : kCases) EXPECT_EQ(direction_degrees(y, x), degrees) << y << " " << x;
}

TEST(Trigonometry, SinesAreWithinTheirErrors) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 100000; ++i) {
    const double degrees = static_cast<double>(random() >> 11) * 0x1p-53 * 1440 - 720;
    const auto [sine, cosine] = sine_cosine(degrees);
    const long double angle = std::remainder(static_cast<long double>(degrees), 360.0L) * kDegree;
    ASSERT_NEAR(sine, static_cast<double>(std::sin(angle)), 1e-15) << degrees;
    ASSERT_NEAR(cosine, static_cast<double>(std::cos(angle)), 1e-15) << degrees;
  }
}

}  // namespace
}  // namespace tessera::detail::trigonometry_test
