// Each term of the lighting equation alone, as the kernels compute it from their float inputs, against long
// double, with bounds from counted roundings.
//
// u = 2^-24 is the largest relative error of one rounding. Products of (1 + u) are taken to first order, and
// bounds are rounded up. `dot` rounds the product of the last components once and adds two more, so it is
// within 3 u of the sum of the magnitudes of its terms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shading/lighting.h"
#include "shading/power.h"
#include "tests/numerics/bounds.h"
#include "tests/numerics/lit_patches.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::light_terms_test {
using namespace detail;
namespace {

constexpr Real kUnit = 0x1p-24L;

struct Point {
  std::array<float, 3> normal{};
  std::array<float, 3> position{};
};
RealPoint real_point(const Point& p, bool renormalize) {
  return {renormalize ? normalized(real3(p.normal)) : real3(p.normal), real3(p.position)};
}

RealLight real_light(const EyeLight& l) {
  RealLight r{real3(l.ambient), real3(l.diffuse), real3(l.specular)};
  r.directional = l.directional;
  r.position = real3(l.position);
  r.spot_direction = real3(l.spot_direction);
  r.spot_exponent = l.spot_exponent;
  r.spot_cutoff = l.spot_cutoff;
  r.attenuation = real3(l.attenuation);
  return r;
}

/// Red component of the points, lit by one light.
std::vector<float> lit_red(const SurfaceMaterial& material, const EyeLight& light, const LightingModel& model,
                           bool renormalize, const std::vector<Point>& points) {
  LightingProgram program = plan_lighting(material, {}, {light}, model, nullptr);
  program.renormalize = renormalize;
  std::vector<float> red;
  for (std::size_t first = 0; first < points.size(); first += kBatchPoints) {
    const std::size_t count = std::min<std::size_t>(kBatchPoints, points.size() - first);
    ShadingBatch batch{};
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        batch.field[kNormalX + c][i] = points[first + i].normal[c];
        batch.field[kPositionX + c][i] = points[first + i].position[c];
      }
    light_points(available_isas().front())(program, batch, static_cast<int>((count + 15) / 16 * 16));
    red.insert(red.end(), batch.field[kColorR], batch.field[kColorR] + count);
  }
  return red;
}

constexpr std::size_t kPoints = 64;
int rounds(int usual) { return long_tests() ? 100 * usual : usual; }

/// Scale of a whole scene. Bounds are relative, so it must not matter.
double any_scale(LightingRng& rng) { return rng.one_in(2) ? 1 : std::exp2(std::floor(rng.between(-56, 50))); }

/// A light near the scene, directional or not. Its cone axis is within some 60 degrees of the scene's
/// direction.
EyeLight any_light(LightingRng& rng, bool directional, double scale = 1) {
  EyeLight l{.ambient = {0, 0, 0}, .diffuse = {0, 0, 0}, .specular = {0, 0, 0}};
  l.directional = directional;
  const auto [x, y, z] = rng.direction();
  const auto distance = static_cast<float>(directional ? 1 : scale * std::exp2(rng.between(-2, 8)));
  l.position = {x * distance, y * distance, z * distance};
  const Real3 aim = normalized(real3(std::array{-x, -y, -z}) + real3(rng.direction()) * 0.8L);
  for (std::size_t c = 0; c < 3; ++c) l.spot_direction[c] = static_cast<float>(aim[c]);
  return l;
}

std::vector<Point> any_points(LightingRng& rng, bool of_any_length, double scale = 1) {
  std::vector<Point> points(kPoints);
  for (Point& p : points) {
    p = {rng.direction(), rng.direction()};
    const auto size = static_cast<float>(of_any_length ? std::exp2(rng.between(-30, 30)) : 1);
    for (float& n : p.normal) n *= size;
    for (float& at : p.position) at *= static_cast<float>(2 * scale);
  }
  return points;
}

// Products of colours and their sum, one rounding each: the scene's ambient term, and those of directional
// lights, which are summed before a point is lit.
TEST(LightTerms, Ambient) {
  LightingRng rng{std::mt19937(21)};
  Real worst = 0;
  for (int n = 0; n < rounds(2000); ++n) {
    const SurfaceMaterial material{.ambient = {static_cast<float>(rng.unit()), 0, 0}, .diffuse = {0, 0, 0}};
    const bool directional = rng.one_in(2);
    EyeLight light = any_light(rng, directional);
    light.ambient = {static_cast<float>(rng.unit()) / 2, 0, 0};
    const LightingModel model{.scene_ambient = {static_cast<float>(rng.unit()) / 2, 0, 0}};
    const Real exact = Real{material.ambient[0]} * (Real{model.scene_ambient[0]} + light.ambient[0]);
    for (const float found : lit_red(material, light, model, false, any_points(rng, false)))
      update_worst(worst, std::abs(found - exact) / exact);
  }
  expect_within("ambient term, relative", worst / kUnit, 2, "2^-24");
}

// Each component of the offset is rounded: distance u, squared distance 2 u. Its square rounds three times (5
// u), the root once (3.5 u). The denominator is off by at most 6 u through its quadratic part (5 u and one
// more), by 5.5 u through the linear one. Its reciprocal rounds once. All coefficients have one sign.
TEST(LightTerms, Attenuation) {
  LightingRng rng{std::mt19937(22)};
  Real worst = 0;
  int measured = 0;
  for (int n = 0; n < rounds(3000); ++n) {
    const double scale = any_scale(rng);
    EyeLight light = any_light(rng, false, scale);
    light.ambient = {0x1p-20f, 0, 0};
    const double distance = static_cast<double>(length(real3(light.position)));
    for (std::size_t k = 0; k < 3; ++k)
      light.attenuation[k] = rng.one_in(3) ? 0 : static_cast<float>(rng.unit() / std::pow(distance, k));
    if (light.attenuation == std::array<float, 3>{0, 0, 0}) continue;
    const std::vector<Point> points = any_points(rng, false, scale);
    const std::vector<float> found = lit_red({.ambient = {1, 0, 0}, .diffuse = {0, 0, 0}}, light,
                                             {.scene_ambient = {0, 0, 0}}, false, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Real att =
          LightAtPoint(real_light(light), real_point(points[i], false), false, SpecularModel::blinn, 0, 0)
              .att;
      if (!(att < 0x1p19L)) continue;
      update_worst(worst, std::abs(found[i] * 0x1p20L / att - 1));
      ++measured;
    }
  }
  EXPECT_GT(measured, rounds(3000) * static_cast<int>(kPoints) / 2);
  expect_within("attenuation, relative", worst / kUnit, 7, "2^-24");
}

// Components of L are off by 6.5 u: the direction of the offset 2 u, the reciprocal of its length 3.5 u,
// their product u. Those of a renormalized normal are off by 4.5 u. Products with the normal and their sums
// add 3 u. Errors are relative to the length of the normal, not to the cosine: at grazing light the bound is
// absolute.
TEST(LightTerms, Diffuse) {
  LightingRng rng{std::mt19937(23)};
  for (const bool directional : {true, false})
    for (const bool renormalize : {false, true}) {
      Real worst = 0;
      for (int n = 0; n < rounds(1000); ++n) {
        const double scale = any_scale(rng);
        EyeLight light = any_light(rng, directional, scale);
        light.diffuse = {0.5f, 0, 0};
        std::vector<Point> points = any_points(rng, renormalize, scale);
        for (std::size_t i = 0; i < points.size(); i += 2) {  // grazing light
          const Real3 l = directional ? real3(light.position)
                                      : normalized(real3(light.position) - real3(points[i].position));
          const Real3 normal = real3(points[i].normal);
          const Real3 across =
              normalized(normal - l * (dot(normal, l) * (1 - std::exp2(rng.between(-30, -2))))) *
              length(normal);
          for (std::size_t c = 0; c < 3; ++c) points[i].normal[c] = static_cast<float>(across[c]);
        }
        const std::vector<float> found =
            lit_red({.diffuse = {1, 0, 0}}, light, {.scene_ambient = {0, 0, 0}}, renormalize, points);
        for (std::size_t i = 0; i < points.size(); ++i) {
          const Real cosine =
              std::max<Real>(LightAtPoint(real_light(light), real_point(points[i], renormalize), false,
                                          SpecularModel::blinn, 0, 0)
                                 .n_dot_l,
                             0);
          update_worst(worst, std::abs(2 * found[i] - cosine));
        }
      }
      expect_within(std::string("max(L.n, 0) of ") + (directional ? "a direction" : "a point") +
                        (renormalize ? ", renormalized, absolute" : ", absolute"),
                    worst / kUnit, (directional ? 0 : 6.5L) + (renormalize ? 4.5L : 0) + 3, "2^-24");
    }
}

// Relative error, in u, of a power of a cosine: the cosine's error times the exponent, the error of the power
// function (powers_test.cpp), and one rounding. Integer powers are products.
// @param exponent  applied to the cosine, or to its square
Real of_power(Real cosine_error, Real cosine, Real y, Real power, float exponent) {
  const int whole = integer_exponent(exponent);
  const Real of_function = power < 1 / 256.0L ? 230.4L : 17.8L;
  return y * cosine_error / cosine + (whole != 0 ? whole : of_function);
}

// The cosine of the angle between -L and the axis is off by at most 9.5 u: 6.5 u from L, 3 u from the dot
// product.
TEST(LightTerms, Spot) {
  LightingRng rng{std::mt19937(24)};
  for (const float y : {0.5f, 1.0f, 20.0f, 64.0f, 128.0f, 10000.0f}) {
    Real share = 0;
    Real levels = 0;
    int measured = 0;
    for (int n = 0; n < rounds(500); ++n) {
      EyeLight light = any_light(rng, false);
      light.ambient = {0.5f, 0, 0};
      light.spot_cutoff = 90;
      light.spot_exponent = y;
      std::vector<Point> points = any_points(rng, false);
      for (Point& p : points) {  // inside the cone
        const Real tilt = rng.between(0, 2) / std::sqrt(std::max(y, 4.0f));
        const Real away = std::exp2(rng.between(-2, 2));
        const Real3 at = real3(light.position) +
                         normalized(real3(light.spot_direction) + real3(rng.direction()) * tilt) * away;
        for (std::size_t c = 0; c < 3; ++c) p.position[c] = static_cast<float>(at[c]);
      }
      const std::vector<float> found = lit_red({.ambient = {1, 0, 0}, .diffuse = {0, 0, 0}}, light,
                                               {.scene_ambient = {0, 0, 0}}, false, points);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const LightAtPoint exact(real_light(light), real_point(points[i], false), false, SpecularModel::blinn,
                                 0, 0);
        const Real spot = exact.spot.high;
        const Real error = std::abs(2 * found[i] - spot);
        if (exact.spot_cosine < 64 * 9.5L * kUnit || spot < 0x1p-120L) continue;
        update_worst(share, error / (spot * of_power(9.5L, exact.spot_cosine, y, spot, y) * kUnit));
        update_worst(levels, error * 255);
        ++measured;
      }
    }
    EXPECT_GT(measured, rounds(500) * static_cast<int>(kPoints) / 2) << y;
    const std::string quantity = "spot of exponent " + std::to_string(y).substr(0, 5);
    expect_within(quantity + ", error / bound", share, 1, "");
    expect_within(quantity + ", absolute", levels, 1, "levels of 255");
  }
}

/// A highlight formula.
struct HighlightFormula {
  SpecularModel kind;
  bool directional;
  bool local;
  bool renormalize;
  bool sharp;
  bool unit;
  bool squared;

  /// Whether the power is applied to the square of the cosine.
  bool uses_square() const {
    const bool has_constant_half = directional && !local;
    return squared && kind == SpecularModel::blinn && !sharp && !has_constant_half;
  }

  /// Error of the highlight's cosine, in u: roundings of L and E (towards a point), of the normal, of their
  /// dot products, of L + E and, unless squared, of its length. Sharp highlights assume unit normals and
  /// directions, which floats are within u.
  Real cosine_error(const LightAtPoint& exact) const {
    const Real given = sharp ? 1 : 0;
    const Real n = renormalize ? 4.5L : given;
    const Real l = directional ? given : 6.5L;
    const Real v = local ? 4.5L : 0;
    const Real n_dot_l = l + n + 3;
    const Real n_dot_v = local ? v + n + 3 : n;
    // Sharp: the difference of two vectors (S and n, or E and R) carries that error. Half its square carries
    // that error times the difference, half of the error's square, and 1.5 u more. A rounding below 1 is
    // 0.5 u.
    const auto of_difference = [&](Real error) {
      const Real apart = std::sqrt(2 * std::max<Real>(1 - exact.highlight_base, 0));
      return apart * error + 0.5L * error * error * kUnit + 1.5L * apart * apart + 0.5L;
    };
    // Rounded once. L is assumed to have length 1, so E gets slightly too much or too little weight in L + E.
    const bool constant_half = directional && !local;
    if (kind == SpecularModel::blinn && constant_half)
      return sharp ? of_difference(l / exact.half_length + 1 + n + 1) : 1 + n + 3;
    // Squared cosines use neither root nor length. Errors: 1 u of the sum of the two cosines, and half of 7 u
    // (its square 1 u, the square of L + E 5 u, their quotient 1 u).
    if (kind == SpecularModel::blinn) {
      if (sharp) return of_difference((l + v) / exact.half_length + 1 + 3.5L + n + 1);
      return (n_dot_l + n_dot_v + l + v) / exact.half_length + (squared ? 4.5L : 6.5L);
    }
    if (sharp) return of_difference(l + v + 2 + 2 * n_dot_l + 2 * n + 1);
    return 2 * (n_dot_l + n_dot_v) + 2 + l + (local ? v + 3 : 0) + 1;
  }
};

/// Sets normals to directions near the brightest point of the highlight.
void face_highlights(LightingRng& rng, const HighlightFormula& formula, const EyeLight& light, Real y,
                     std::vector<Point>& points) {
  for (Point& p : points) {
    const Real3 at = real3(p.position);
    const Real3 l = formula.directional ? real3(light.position) : normalized(real3(light.position) - at);
    const Real3 e = formula.local ? normalized(at * -1) : Real3{0, 0, 1};
    const Real off = rng.between(0, 3) / std::sqrt(std::max<Real>(y, 10));
    const Real3 facing = normalized(normalized(l + e) + real3(rng.direction()) * off) *
                         (formula.renormalize ? rng.between(0.5, 2) : 1);
    for (std::size_t c = 0; c < 3; ++c) p.normal[c] = static_cast<float>(facing[c]);
  }
}

TEST(LightTerms, Highlights) {
  LightingRng rng{std::mt19937(25)};
  for (const SpecularModel kind : {SpecularModel::blinn, SpecularModel::phong})
    for (const float y : {0.1f, 0.5f, 1.0f, 50.0f, 128.0f, 2000.0f, 10000.0f}) {
      Real share = 0;
      Real levels = 0;
      int measured = 0;
      for (int n = 0; n < rounds(1600); ++n) {
        const HighlightFormula formula{kind,
                                       (n & 1) != 0,
                                       (n & 2) != 0,
                                       (n & 4) != 0,
                                       y > kSharpShininess,
                                       y > kSharpShininess || (n & 8) != 0,
                                       y >= 1 && (n & 8) != 0};
        EyeLight light = any_light(rng, formula.directional);
        light.specular = {0.5f, 0, 0};
        const LightingModel model{.scene_ambient = {0, 0, 0},
                                  .local_viewer = formula.local,
                                  .phong_highlight = kind == SpecularModel::phong,
                                  .unit_normals = formula.unit};
        std::vector<Point> points = any_points(rng, false);
        face_highlights(rng, formula, light, y, points);
        const std::vector<float> found =
            lit_red({.diffuse = {0, 0, 0}, .specular = {1, 0, 0}, .shininess = y}, light, model,
                    formula.renormalize, points);
        RealLight exact_light = real_light(light);
        if (formula.sharp && formula.directional) exact_light.position = normalized(exact_light.position);
        for (std::size_t i = 0; i < points.size(); ++i) {
          const LightAtPoint exact(exact_light, real_point(points[i], formula.renormalize || formula.sharp),
                                   formula.local, kind, y, 0);
          const Real shine = exact.highlight.high;
          const Real cosine_error = formula.cosine_error(exact);
          const Real error = std::abs(2 * found[i] - shine);
          // Another formula, or no highlight.
          if (exact.n_dot_l < 20 * kUnit || exact.highlight_base < 64 * cosine_error * kUnit) continue;
          // Highlights below 2^-32 are skipped.
          update_worst(share, error / (shine *
                                           of_power(cosine_error, exact.highlight_base, y, shine,
                                                    formula.uses_square() ? y / 2 : y) *
                                           kUnit +
                                       0x1p-31L));
          // If the light is almost opposite to the viewer, L + E consists of rounding errors only.
          if (kind == SpecularModel::phong || exact.half_length >= 0.125L) update_worst(levels, error * 255);
          ++measured;
        }
      }
      EXPECT_GT(measured, rounds(1600) * static_cast<int>(kPoints) / 2) << y;
      const std::string quantity = std::string(kind == SpecularModel::blinn ? "Blinn" : "Phong") +
                                   " highlight of exponent " + std::to_string(y).substr(0, 5);
      expect_within(quantity + ", error / bound", share, 1, "");
      expect_within(quantity + ", absolute", levels, 1, "levels of 255");
    }
}

}  // namespace
}  // namespace tessera::test::light_terms_test
