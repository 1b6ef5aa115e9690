// CIELAB and OKLab, compared with the definitions in long double.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "framebuffer/tessera/color.hpp"

namespace tessera::lab_test {
namespace {

using Triple = std::array<long double, 3>;

Triple lab_in_long_double(const ColorValues& xyz, Chromaticity white) {
  const auto f = [](long double t) {
    return t > 216.0L / 24389 ? std::cbrt(t) : (24389.0L / 27 * t + 16) / 116;  // the ratios of CIE 15
  };
  const long double x = white.x, y = white.y;
  const long double fx = f(xyz[0] / (x / y)), fy = f(xyz[1]), fz = f(xyz[2] / ((1 - x - y) / y));
  return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

// The code that Ottosson published, in long double.
Triple oklab_in_long_double(const ColorValues& light) {
  const long double r = light[0], g = light[1], b = light[2];
  const long double l = std::cbrt(.4122214708L * r + .5363325363L * g + .0514459929L * b);
  const long double m = std::cbrt(.2119034982L * r + .6806995451L * g + .1073969566L * b);
  const long double s = std::cbrt(.0883024619L * r + .2817188376L * g + .6299787005L * b);
  return {.2104542553L * l + .7936177850L * m - .0040720468L * s,
          1.9779984951L * l - 2.4285922050L * m + .4505937099L * s,
          .0259040371L * l + .7827717662L * m - .8086757660L * s};
}

void expect_near(const ColorValues& found, const Triple& expected, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i)
    ASSERT_NEAR(found[i], static_cast<double>(expected[i]), tolerance) << "value " << i;
}

/// Calls check(v) for random values from -0.2 to 1.2, of several magnitudes.
template <class Check>
void for_colors(const Check& check) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 100000; ++i) {
    ColorValues values{};
    for (double& value : values)
      value = std::ldexp(static_cast<double>(random() >> 11) * 0x1p-53 * 1.4 - .2, -(i % 12));
    check(values);
  }
}

TEST(Lab, AgreesWithLongDouble) {
  for_colors([](const ColorValues& xyz) {
    for (const Chromaticity white : {kWhiteD65, kWhiteD50})
      expect_near(lab_from_xyz(xyz, white), lab_in_long_double(xyz, white), 1e-12);
  });
}

TEST(Lab, OklabAgreesWithLongDouble) {
  for_colors([](const ColorValues& light) {
    expect_near(oklab_from_light(light), oklab_in_long_double(light), 1e-14);
  });
}

TEST(Lab, ConvertBack) {
  for_colors([](const ColorValues& v) {
    const ColorValues from_lab = xyz_from_lab(lab_from_xyz(v, kWhiteD50), kWhiteD50);
    const ColorValues from_oklab = light_from_oklab(oklab_from_light(v));
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_NEAR(from_lab[i], v[i], 1e-13);
      ASSERT_NEAR(from_oklab[i], v[i], 1e-13);
    }
  });
}

TEST(Lab, BlackAndWhiteAreTheEndsOfTheAxis) {
  expect_near(lab_from_xyz(xyz_of(kWhiteD65), kWhiteD65), {100, 0, 0}, 1e-12);
  expect_near(lab_from_xyz({0, 0, 0}, kWhiteD65), {0, 0, 0}, 1e-13);
  expect_near(oklab_from_light({1, 1, 1}), {1, 0, 0}, 1e-7);  // the published matrices have ten digits
  expect_near(oklab_from_light({0, 0, 0}), {0, 0, 0}, 0);
}

// Other programs' values of sRGB red: Lab (D65) 53.24, 80.09, 67.20; OKLab .62796, .22486, .12585.
TEST(Lab, RedIsWhereOtherProgramsPutIt) {
  const ColorMatrix xyz_from_rgb = xyz_from_rgb_light(kBt709Primaries);
  expect_near(lab_from_xyz(xyz_from_rgb * ColorValues{1, 0, 0}, kWhiteD65), {53.24L, 80.09L, 67.20L}, .01);
  expect_near(oklab_from_light({1, 0, 0}), {.62796L, .22486L, .12585L}, .5001e-5);
}

}  // namespace
}  // namespace tessera::lab_test
