// Odd numbers in the helpers that make matrices, one and two at a time: an error, or a matrix of finite numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "tests/numerics/odd_values.h"
#include "tests/engine/api_support.h"

namespace tessera::test {
namespace {

using Numbers = std::vector<double>;

struct Helper {
  const char* name;
  Numbers plain;
  std::function<Matrix(const Numbers&)> make;
};

Light light_at(const Numbers& n, std::size_t first) {
  Light light;
  for (std::size_t i = 0; i < 4; ++i) light.position[i] = static_cast<float>(n[first + i]);
  return light;
}

std::vector<Helper> helpers() {
  return {{"rotate", {30, 0.1, 0.7, 0.3}, [](const Numbers& n) { return rotate(n[0], n[1], n[2], n[3]); }},
          {"look_at", {0.1, 0.7, 3.3, 0.2, -0.1, 0.3, 0.1, 1, 0.2}, [](const Numbers& n) { return look_at({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}); }},
          {"perspective", {47, 1.3, 0.1, 77}, [](const Numbers& n) { return perspective(n[0], n[1], n[2], n[3]); }},
          {"perspective, reversed", {47, 1.3, 0.1, 77}, [](const Numbers& n) { return perspective(n[0], n[1], n[2], n[3], true); }},
          {"frustum", {-0.1, 0.3, -0.7, 0.2, 0.1, 33}, [](const Numbers& n) { return frustum(n[0], n[1], n[2], n[3], n[4], n[5]); }},
          {"frustum, reversed", {-0.1, 0.3, -0.7, 0.2, 0.1, 33}, [](const Numbers& n) { return frustum(n[0], n[1], n[2], n[3], n[4], n[5], true); }},
          {"orthographic", {-0.1, 0.3, -0.7, 0.2, -2, 33}, [](const Numbers& n) { return orthographic(n[0], n[1], n[2], n[3], n[4], n[5]); }},
          {"orthographic, reversed", {-0.1, 0.3, -0.7, 0.2, -2, 33}, [](const Numbers& n) { return orthographic(n[0], n[1], n[2], n[3], n[4], n[5], true); }},
          {"calibrated_camera", {333, 313, 100, 77, 0.1, 33}, [](const Numbers& n) { return calibrated_camera({n[0], n[1], n[2], n[3], 201, 151}, {}, n[4], n[5]).projection; }},
          {"planar_shadow", {0.1, 0.9, 0.2, 0.3, 0.1, 3.3, 0.7, 1}, [](const Numbers& n) { return planar_shadow({n[0], n[1], n[2], n[3]}, light_at(n, 4)); }}};
}

void expect_error_or_finite(const Helper& helper, const Numbers& numbers) {
  try {
    const Matrix matrix = helper.make(numbers);
    for (const double element : matrix.m)
      if (!std::isfinite(element)) {
        std::string given;
        for (const double n : numbers) given += testing::PrintToString(n) + " ";
        FAIL() << helper.name << " of " << given << "has an element " << element;
      }
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()), "");
  }
}

std::vector<double> values() {
  std::vector<double> all = odd_values<double>();
  for (const float v : odd_values<float>()) all.push_back(v);  // what a light's position can be
  return all;
}

TEST(OddMatrices, OfOneOddNumberAreErrorsOrFinite) {
  for (const Helper& helper : helpers())
    for (std::size_t i = 0; i < helper.plain.size(); ++i)
      for (const double odd : values()) {
        Numbers numbers = helper.plain;
        numbers[i] = odd;
        expect_error_or_finite(helper, numbers);
        if (!std::isnan(odd)) continue;
        EXPECT_TRUE(error_of([&] { helper.make(numbers); })) << helper.name << ", number " << i << " is not a number";
      }
}

TEST(OddMatrices, OfTwoOddNumbersAreErrorsOrFinite) {
  for (const Helper& helper : helpers())
    for (std::size_t i = 0; i < helper.plain.size(); ++i)
      for (std::size_t j = i + 1; j < helper.plain.size(); ++j)
        for (const double a : values())
          for (const double b : values()) {
            Numbers numbers = helper.plain;
            numbers[i] = a, numbers[j] = b;
            expect_error_or_finite(helper, numbers);
            if (HasFatalFailure()) return;
          }
}

// All of them the same, large or small: what a scene in other units has.
TEST(OddMatrices, OfNumbersInAnyUnitAreErrorsOrFinite) {
  for (const Helper& helper : helpers())
    for (int exponent = -1074; exponent < 1024; exponent += 7) {
      Numbers numbers = helper.plain;
      for (double& n : numbers) n = std::ldexp(n, exponent);
      expect_error_or_finite(helper, numbers);
      if (HasFatalFailure()) return;
    }
}

TEST(OddMatrices, OfPicturesWithoutPixelsAreErrors) {
  for (const int size : odd_values<int>())
    for (const bool wide : {false, true}) {
      const auto make = [&] { return calibrated_camera({333, 313, 100, 77, wide ? size : 200, wide ? 150 : size}, {}, 0.1, 33); };
      EXPECT_EQ(error_of(make).has_value(), size < 1) << size;
    }
}

}  // namespace
}  // namespace tessera::test
