// OKLab against its definition in long double.
#include "framebuffer/oklab.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace tessera::detail::oklab_test {
namespace {

using Vector = std::array<long double, 3>;

/// B. Ottosson, 2020, with the functions of the C library.
Vector oklab_reference(const Vector& stored) {
  Vector linear{};
  for (std::size_t i = 0; i < 3; ++i)
    linear[i] = stored[i] <= 0.04045L ? stored[i] / 12.92L : std::pow((stored[i] + 0.055L) / 1.055L, 2.4L);
  const auto [r, g, b] = linear;
  const long double l = std::cbrt(0.4122214708L * r + 0.5363325363L * g + 0.0514459929L * b);
  const long double m = std::cbrt(0.2119034982L * r + 0.6806995451L * g + 0.1073969566L * b);
  const long double s = std::cbrt(0.0883024619L * r + 0.2817188376L * g + 0.6299787005L * b);
  return {0.2104542553L * l + 0.7936177850L * m - 0.0040720468L * s,
          1.9779984951L * l - 2.4285922050L * m + 0.4505937099L * s,
          0.0259040371L * l + 0.7827717662L * m - 0.8086757660L * s};
}

TEST(OklabColors, AgreeWithTheDefinition) {
  for (int r = 0; r < 256; r += 5)
    for (int g = 0; g < 256; g += 3)
      for (int b = 0; b < 256; b += 15) {
        const Oklab ours = oklab_from_rgb8(
            {static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(b)});
        const Vector exact = oklab_reference({r / 255.0L, g / 255.0L, b / 255.0L});
        ASSERT_NEAR(ours.l, static_cast<double>(exact[0]), 1e-14) << r << " " << g << " " << b;
        ASSERT_NEAR(ours.a, static_cast<double>(exact[1]), 1e-14) << r << " " << g << " " << b;
        ASSERT_NEAR(ours.b, static_cast<double>(exact[2]), 1e-14) << r << " " << g << " " << b;
        ASSERT_EQ(ours, oklab_from_srgb(r / 255.0, g / 255.0, b / 255.0));
      }
}

TEST(OklabColors, WhiteIsOneAndBlackIsZero) {
  EXPECT_EQ(oklab_from_rgb8({0, 0, 0}), Oklab{});
  EXPECT_NEAR(oklab_from_rgb8({255, 255, 255}).l, 1, 1e-7);
  EXPECT_NEAR(oklab_from_rgb8({255, 255, 255}).a, 0, 1e-7);
  EXPECT_NEAR(oklab_from_rgb8({255, 255, 255}).b, 0, 1e-7);
}

TEST(OklabColors, LinearLightIsTheInverse) {
  for (int r = 0; r <= 20; ++r)
    for (int g = 0; g <= 20; ++g)
      for (int b = 0; b <= 20; ++b) {
        const LinearRgb linear = linear_from_oklab(oklab_from_srgb(r / 20.0, g / 20.0, b / 20.0));
        const auto exact = [](int v) {
          const double c = v / 20.0;
          return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        };
        ASSERT_NEAR(linear.r, exact(r), 1e-6);
        ASSERT_NEAR(linear.g, exact(g), 1e-6);
        ASSERT_NEAR(linear.b, exact(b), 1e-6);
      }
}

}  // namespace
}  // namespace tessera::detail::oklab_test
