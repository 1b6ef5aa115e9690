// Odd numbers in the matrix helpers, one and two at a time: an error, or a matrix of finite numbers. Helpers
// that only place numbers, and products, report no errors; the calls that take a matrix do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "tests/engine/frame/api_support.h"
#include "tests/numerics/odd_values.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::odd_matrices_test {
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
          {"look_at",
           {0.1, 0.7, 3.3, 0.2, -0.1, 0.3, 0.1, 1, 0.2},
           [](const Numbers& n) {
             return look_at({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]});
           }},
          {"perspective",
           {47, 1.3, 0.1, 77},
           [](const Numbers& n) { return perspective(n[0], n[1], n[2], n[3]); }},
          {"perspective, reversed",
           {47, 1.3, 0.1, 77},
           [](const Numbers& n) { return perspective(n[0], n[1], n[2], n[3], true); }},
          {"frustum",
           {-0.1, 0.3, -0.7, 0.2, 0.1, 33},
           [](const Numbers& n) { return frustum(n[0], n[1], n[2], n[3], n[4], n[5]); }},
          {"frustum, reversed",
           {-0.1, 0.3, -0.7, 0.2, 0.1, 33},
           [](const Numbers& n) { return frustum(n[0], n[1], n[2], n[3], n[4], n[5], true); }},
          {"orthographic",
           {-0.1, 0.3, -0.7, 0.2, -2, 33},
           [](const Numbers& n) { return orthographic(n[0], n[1], n[2], n[3], n[4], n[5]); }},
          {"orthographic, reversed",
           {-0.1, 0.3, -0.7, 0.2, -2, 33},
           [](const Numbers& n) { return orthographic(n[0], n[1], n[2], n[3], n[4], n[5], true); }},
          {"calibrated_camera",
           {333, 313, 100, 77, 0.1, 33},
           [](const Numbers& n) {
             return calibrated_camera({n[0], n[1], n[2], n[3], 201, 151}, {}, n[4], n[5]).projection;
           }},
          {"calibrated_camera, camera_from_world",
           {0.9, 0.1, 0.3, 2, -0.1, 0.8, 0.2, 1, 0.3, -0.2, 0.9, 5, 0, 0, 0, 1},
           [](const Numbers& n) {
             Matrix camera_from_world;
             std::copy(n.begin(), n.end(), camera_from_world.m.begin());
             return calibrated_camera({333, 313, 100, 77, 201, 151}, camera_from_world, 0.1, 33).view;
           }},
          {"planar_shadow", {0.1, 0.9, 0.2, 0.3, 0.1, 3.3, 0.7, 1}, [](const Numbers& n) {
             return planar_shadow({n[0], n[1], n[2], n[3]}, light_at(n, 4));
           }}};
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
  for (const float v : odd_values<float>()) all.push_back(v);  // possible values of a light's position
  return all;
}

TEST(OddMatrices, OneOddNumberIsAnErrorOrFinite) {
  for (const Helper& helper : helpers())
    for (std::size_t i = 0; i < helper.plain.size(); ++i)
      for (const double odd : values()) {
        Numbers numbers = helper.plain;
        numbers[i] = odd;
        expect_error_or_finite(helper, numbers);
        if (!std::isnan(odd)) continue;
        EXPECT_TRUE(error_of([&] { helper.make(numbers); }))
            << helper.name << ", argument " << i << " is NaN";
      }
}

TEST(OddMatrices, TwoOddNumbersAreErrorsOrFinite) {
  for (const Helper& helper : helpers())
    for (std::size_t i = 0; i < helper.plain.size(); ++i)
      for (std::size_t j = i + 1; j < helper.plain.size(); ++j)
        for (const double a : values())
          for (const double b : values()) {
            Numbers numbers = helper.plain;
            numbers[i] = a;
            numbers[j] = b;
            expect_error_or_finite(helper, numbers);
            if (HasFatalFailure()) return;
          }
}

// All numbers scaled alike, as in a scene with other units.
TEST(OddMatrices, NumbersInAnyUnitAreErrorsOrFinite) {
  for (const Helper& helper : helpers())
    for (int exponent = -1074; exponent < 1024; exponent += 7) {
      Numbers numbers = helper.plain;
      for (double& n : numbers) n = std::ldexp(n, exponent);
      expect_error_or_finite(helper, numbers);
      if (HasFatalFailure()) return;
    }
}

TEST(OddMatrices, PicturesWithoutPixelsAreErrors) {
  for (const int size : odd_values<int>())
    for (const bool wide : {false, true}) {
      const auto make = [&] {
        return calibrated_camera({333, 313, 100, 77, wide ? size : 200, wide ? 150 : size}, {}, 0.1, 33);
      };
      EXPECT_EQ(error_of(make).has_value(), size < 1) << size;
    }
}

TEST(OddMatrices, ZeroAxesAreErrors) {
  for (const int odd : {2, 127, 255})
    EXPECT_THAT(error_of([&] {
                  calibrated_camera({333, 313, 100, 77, 201, 151}, {}, 0.1, 33, static_cast<CameraAxes>(odd));
                }).value_or(""),
                testing::HasSubstr("axes is " + std::to_string(odd)));
}

// Each number is stored bit for bit in its place, and nothing else changes.
TEST(OddMatrices, TranslationsAndScalesHoldTheExactNumbers) {
  const std::vector<double> odd = values();
  for (std::size_t i = 0; i < odd.size(); ++i) {
    const double x = odd[i];
    const double y = odd[(i + 7) % odd.size()];
    const double z = odd[(i + 19) % odd.size()];
    Matrix moved;
    Matrix stretched;
    moved.m[3] = stretched.m[0] = x;
    moved.m[7] = stretched.m[5] = y;
    moved.m[11] = stretched.m[10] = z;
    const auto bits = [](const Matrix& matrix) {
      return std::bit_cast<std::array<std::uint64_t, 16>>(matrix.m);
    };
    EXPECT_EQ(bits(translate(x, y, z)), bits(moved)) << x << " " << y << " " << z;
    EXPECT_EQ(bits(scale(x, y, z)), bits(stretched)) << x << " " << y << " " << z;
  }
}

// Each element is the sum of its four products: NaN if a product is NaN or infinities of both signs meet,
// infinite if a product is, else within its roundings. (If the sum of the finite magnitudes overflows, the
// result depends on the order and is not checked.)
TEST(OddMatrices, ProductsAreSumsWithinTheirRoundings) {
  const std::vector<double> odd = values();
  Random random(24);
  std::size_t numbers = 0;
  std::size_t infinite = 0;
  std::size_t not_numbers = 0;
  for (int n = 0; n < 20000; ++n) {
    Matrix left;
    Matrix right;
    for (Matrix* const matrix : {&left, &right})
      for (double& element : matrix->m)
        element = random.next() % 8 == 0 ? odd[random.next() % odd.size()] : random.between(-3, 3);
    const Matrix product = left * right;
    for (std::size_t at = 0; at < 16; ++at) {
      long double sum = 0;
      long double sizes = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const long double term = static_cast<long double>(left.m[at / 4 * 4 + k]) *
                                 static_cast<long double>(right.m[4 * k + at % 4]);
        const double product_of_two = static_cast<double>(term);  // infinite beyond the range of doubles
        sum += product_of_two;
        if (std::isfinite(product_of_two)) sizes += std::abs(term);
      }
      const double found = product.m[at];
      if (std::isnan(sum)) {
        ASSERT_TRUE(std::isnan(found)) << found;
        ++not_numbers;
      } else if (sizes > std::numeric_limits<double>::max()) {
        continue;
      } else if (std::isinf(sum)) {
        ASSERT_EQ(found, static_cast<double>(sum));
        ++infinite;
      } else {
        ASSERT_LE(std::abs(found - sum), 4 * (0x1p-53L * sizes + 0x1p-1074L)) << found;
        ++numbers;
      }
    }
  }
  EXPECT_TRUE(numbers > 10000 && infinite > 10000 && not_numbers > 10000)
      << numbers << " " << infinite << " " << not_numbers;
}

}  // namespace
}  // namespace tessera::test::odd_matrices_test
