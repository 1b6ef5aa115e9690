// Our own powers, logarithms, roots, sines and normalization against results of long double: the largest error in units in the last place (ulp) of
// what is exact. Powers, logarithms and roots have the same bits on every instruction set: the fastest is measured, and all are compared.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "shading/power.h"
#include "shading/trigonometry.h"
#include "tests/numerics/bounds.h"
#include "tests/raster/random_triangles.h"
#include "tests/shading/power_lanes.h"

namespace tessera::test {
namespace {

long double ulps(float found, long double exact) {
  const int exponent = std::max(std::ilogb(exact), -126);
  return std::abs(found - exact) / std::ldexp(1.0L, exponent - 23);
}

/// Floats from the bits `first` to `last`, each or so many that every exponent has 2^12, evenly; sixteen at a time.
void for_floats(std::uint32_t first, std::uint32_t last, const std::function<void(const std::vector<float>&)>& chunk) {
  const std::uint32_t step = long_tests() ? 1 : 2039;  // a prime: no bit of the mantissa stays what it is
  std::vector<float> floats;
  const auto run = [&] {
    while (floats.size() % 16 != 0) floats.push_back(floats.back());
    chunk(floats);
    floats.clear();
  };
  for (std::uint64_t bits = first; bits <= last; bits += step) {
    floats.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    if (floats.size() == 65536) run();
  }
  floats.push_back(std::bit_cast<float>(last));
  run();
}

using Exact = std::function<long double(float)>;

long double largest_error(PowerFunction function, float exponent, std::uint32_t first, std::uint32_t last, const Exact& exact) {
  long double worst = 0;
  for_floats(first, last, [&](const std::vector<float>& arguments) {
    std::vector<float> results(arguments.size());
    evaluate_power(available_isas().front())(function, arguments.data(), exponent, results.data(), arguments.size());
    for (std::size_t i = 0; i < arguments.size(); ++i) worst = std::max(worst, ulps(results[i], exact(arguments[i])));
  });
  return worst;
}

std::uint32_t bits_of(float f) { return std::bit_cast<std::uint32_t>(f); }

TEST(Functions, Logarithms) {
  const auto exact = [](float x) { return static_cast<long double>(std::log2(static_cast<double>(x))); };
  // 1 apart: log2(1) is 0, and comes out so.
  const long double below = largest_error(PowerFunction::log2, 1, bits_of(kSmallestNormal), bits_of(1) - 1, exact);
  const long double above = largest_error(PowerFunction::log2, 1, bits_of(1) + 1, bits_of(3.4028234e38f), exact);
  expect_within("log2(x), every normal x", std::max(below, above), 1.6, "ulp");
}

TEST(Functions, PowersOfTwo) {
  const auto exact = [](float x) { return static_cast<long double>(std::exp2(static_cast<double>(x))); };
  const long double positive = largest_error(PowerFunction::exp2, 1, 0, bits_of(kLargestLog2), exact);
  const long double negative = largest_error(PowerFunction::exp2, 1, bits_of(-0.0f), bits_of(-126.0f), exact);
  expect_within("2^x, x in -126 .. 96", std::max(positive, negative), 1.2, "ulp");
}

// p = y log2 x is off by the error of the logarithm and half an ulp of its own: 2^p by ln 2 times that, times |p|, and by its own error.
TEST(Functions, Powers) {
  for (const float y : {0.5f, 2.0f, 20.0f, 128.0f, 10000.0f}) {
    const auto exact = [y](float x) { return static_cast<long double>(std::pow(static_cast<double>(x), static_cast<double>(y))); };
    // Where the power is at least 2^-8, one level of eight bits, and where it is a normal float at all.
    const auto least = [y](double p) { return std::nextafter(static_cast<float>(std::exp2(std::max(-126.0, p / static_cast<double>(y)))), 2.0f); };
    const long double visible = largest_error(PowerFunction::power, y, bits_of(least(-8)), bits_of(1), exact);
    const long double any = largest_error(PowerFunction::power, y, bits_of(least(-125.9)), bits_of(1), exact);
    const std::string power = "x^" + std::to_string(static_cast<int>(y * 10) / 10) + (y < 1 ? ".5" : "");
    expect_within(power + " of at least 1/256", visible, 14, "ulp");
    expect_within(power + ", x in 0 .. 1", any, 160, "ulp");
  }
}

TEST(Functions, SinesAndCosines) {
  long double worst = 0;
  std::mt19937 random(5);
  const auto check = [&](double degrees) {
    const long double turn = std::remainder(static_cast<long double>(degrees), 360.0L) * (std::numbers::pi_v<long double> / 180);
    const SinCos found = sin_cos_degrees(degrees);
    worst = std::max({worst, std::abs(found.sine - std::sin(turn)), std::abs(found.cosine - std::cos(turn))});
  };
  for (int i = -720 * 1024; i <= 720 * 1024; ++i) check(i / 1024.0);
  for (int i = 0; i < 1000000; ++i) check(std::ldexp(static_cast<double>(random()) - 0x1p31, static_cast<int>(random() % 64) - 40));
  expect_within("sine and cosine of degrees, absolute", worst, 1e-15L, "");
  for (int quarter = -8; quarter <= 8; ++quarter) {
    const SinCos found = sin_cos_degrees(90.0 * quarter);
    constexpr double kSines[] = {0, 1, 0, -1};
    EXPECT_EQ(found.sine, kSines[quarter & 3]);
    EXPECT_EQ(found.cosine, kSines[(quarter + 1) & 3]);
  }
}

}  // namespace
}  // namespace tessera::test
