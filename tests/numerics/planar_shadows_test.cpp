// Degenerate planar shadows: lights nearly in the plane, nearly parallel to it, or very far away; planes with
// huge and tiny coefficients. Either the draw is rejected, or the matrix maps points onto the plane.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>

#include "tests/numerics/bounds.h"
#include "tests/numerics/random_lit_scenes.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::planar_shadows_test {
namespace {

constexpr Real kDouble = 0x1p-53L;
constexpr Real kLongDouble = 0x1p-64L;
using Real4 = std::array<Real, 4>;

Real dot(const Real4& a, const Real4& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }
Real4 magnitudes(const Real4& v) { return {std::abs(v[0]), std::abs(v[1]), std::abs(v[2]), std::abs(v[3])}; }

struct Shadow {
  std::array<double, 4> plane{};
  Light light;

  Real4 p() const { return {plane[0], plane[1], plane[2], plane[3]}; }
  Real4 l() const { return {light.position[0], light.position[1], light.position[2], light.position[3]}; }
  /// p.l relative to the magnitudes of its terms: 0 where there is no shadow.
  Real slope() const { return std::abs(dot(p(), l())) / dot(magnitudes(p()), magnitudes(l())); }
  std::optional<Matrix> matrix() const {
    try {
      return planar_shadow(plane, light);
    } catch (const Error&) {
      return std::nullopt;
    }
  }
};

// x goes to x - l (p.x) / (p.l). A matrix element multiplies l and p and divides by p.l (2 roundings): 4
// roundings of its terms; subtracting from 1 or 0 adds another. Each product with the point adds as much, and
// long double has its own roundings.
Real worst_error(const Shadow& shadow, const Matrix& m, const Real4& x) {
  const Real4 p = shadow.p();
  const Real4 l = shadow.l();
  const Real product = dot(p, l);
  const Real condition = 1 / shadow.slope();
  Real worst = 0;
  Real from_plane = 0;
  Real from_plane_allowed = 0;
  for (std::size_t r = 0; r < 4; ++r) {
    Real at = 0;
    Real exact = x[r];
    Real allowed = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const Real removed = l[r] * p[c] / product;
      at += m.m[4 * r + c] * x[c];
      exact -= removed * x[c];
      allowed += (((3 + 4 * condition) * std::abs(removed) + (r == c)) * kDouble +
                  8 * kLongDouble * (std::abs(removed) + 1)) *
                 std::abs(x[c]);
    }
    update_worst(worst, std::abs(at - exact) / allowed);
    from_plane += p[r] * at;
    from_plane_allowed += std::abs(p[r]) * allowed;
  }
  update_worst(worst, std::abs(from_plane) / from_plane_allowed);
  return worst;
}

// Between light and plane, or beyond the plane.
Real4 any_point(LightingRng& rng, const Shadow& shadow) {
  Real4 x{rng.between(-10, 10), rng.between(-10, 10), rng.between(-10, 10), 1};
  if (rng.one_in(2)) {  // near the plane
    const Real4 p = shadow.p();
    const Real off = dot(p, x) / (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (std::size_t k = 0; k < 3; ++k) x[k] -= 0.999L * off * p[k];
  }
  return x;
}

Shadow any_shadow(LightingRng& rng) {
  Shadow s;
  const std::array<float, 3> n = rng.direction();
  const std::array<float, 3> d = rng.direction();
  const double size = std::pow(10, rng.of({0.0, 0.0, -100.0, 100.0, -290.0, 290.0}));
  s.plane = {n[0] * size, n[1] * size, n[2] * size, rng.between(-10, 10) * size};
  const float far = static_cast<float>(std::pow(10, rng.of({-20, -3, 0, 3, 20, 36})));
  for (std::size_t k = 0; k < 3; ++k) s.light.position[k] = d[k] * far;
  s.light.position[3] = rng.one_in(3) ? 0 : rng.of({1.0f, 2.0f, -1.0f, 1e-20f});
  return s;
}

TEST(PlanarShadows, FallOntoThePlane) {
  LightingRng rng{std::mt19937(51)};
  Real worst = 0;
  int cast = 0;
  for (int n = 0; n < 20000 * (long_tests() ? 100 : 1); ++n) {
    const Shadow shadow = any_shadow(rng);
    const std::optional<Matrix> m = shadow.matrix();
    if (!m) {
      EXPECT_LT(shadow.slope(), 0x1p-21L) << "a valid shadow was rejected";
      continue;
    }
    ++cast;
    for (int k = 0; k < 4; ++k) update_worst(worst, worst_error(shadow, *m, any_point(rng, shadow)));
  }
  EXPECT_GT(cast, 19000);
  expect_within("planar shadows, of 4 double eps over the sine between light and plane", worst, 1, "");
}

// The light's distance from the plane ranges from 2^-30 of its magnitude to well off the plane. Rejected up
// to 2^-22 of the sum of the magnitudes, accurate above that.
TEST(PlanarShadows, LightsNearlyInThePlaneAreAccurateOrRejected) {
  LightingRng rng{std::mt19937(52)};
  Real worst = 0;
  int cast = 0;
  int refused = 0;
  for (int n = 0; n < 20000 * (long_tests() ? 100 : 1); ++n) {
    Shadow shadow = any_shadow(rng);
    const double off = std::exp2(rng.between(-30, -8));
    // A plane that nearly contains the light or its direction.
    const Real4 l = shadow.l();
    Real4 p = shadow.p();
    if (l[3] == 0) {
      const Real along =
          (p[0] * l[0] + p[1] * l[1] + p[2] * l[2]) / (l[0] * l[0] + l[1] * l[1] + l[2] * l[2]);
      for (std::size_t k = 0; k < 3; ++k)
        shadow.plane[k] = static_cast<double>(p[k] - along * l[k] * (1 - off));
    } else {
      shadow.plane[3] = static_cast<double>(-(p[0] * l[0] + p[1] * l[1] + p[2] * l[2]) / l[3]) * (1 + off);
    }
    if (!std::isfinite(shadow.plane[3])) continue;
    const Real slope = shadow.slope();
    const std::optional<Matrix> m = shadow.matrix();
    (m ? cast : refused) += 1;
    EXPECT_TRUE(!m || slope > 0x1.fp-23L) << static_cast<double>(slope);
    EXPECT_TRUE(m || slope < 0x1.1p-22L) << static_cast<double>(slope);
    if (!m) continue;
    for (int k = 0; k < 4; ++k) update_worst(worst, worst_error(shadow, *m, any_point(rng, shadow)));
  }
  EXPECT_GT(cast, 5000);
  EXPECT_GT(refused, 3000);
  expect_within("planar shadows of lights nearly in the plane, of the same", worst, 1, "");
}

// Matrix elements beyond the range of doubles are rejected, too. Accepted shadows are always finite.
TEST(PlanarShadows, TooDistantShadowsAreRejected) {
  const Light above{.position = {0, 0, 1, 1}};
  EXPECT_THROW(planar_shadow({0, 0, 1e-310, 1}, Light{.position = {0, 0, 1, 0}}), Error);
  EXPECT_THROW(planar_shadow({0, 0, 1e-310, 1e300}, Light{.position = {0, 0, 1, 0}}), Error);
  EXPECT_THROW(planar_shadow({0, 0, 0, 1}, above), Error);
  EXPECT_THROW(planar_shadow({0, 0, 1, -1}, above), Error);
  EXPECT_NO_THROW(planar_shadow({0, 0, 1e308, 1e308}, above));
  EXPECT_NO_THROW(planar_shadow({0, 0, 1e-308, 1e-308}, above));
  EXPECT_NO_THROW(planar_shadow({0, 0, 1, 0}, Light{.position = {3e38f, 0, 3e38f, 1e-38f}}));
}

}  // namespace
}  // namespace tessera::test::planar_shadows_test
