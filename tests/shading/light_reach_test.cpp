// Proofs that a light adds nothing, against the scalar lighting of points inside of the bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "shading/light_reach.h"
#include "shading/lighting_reference.h"

namespace tessera::detail::light_reach_test {
namespace {

struct Rng {
  std::mt19937 random;

  explicit Rng(std::uint32_t seed) : random(seed) {}
  double unit() { return random() * 0x1p-32; }
  bool one_in(std::uint32_t n) { return random() % n == 0; }
  bool maybe() { return one_in(2); }
};

using Vec = std::array<double, 3>;

double within(Rng& rng, double limit) { return limit * (2 * rng.unit() - 1); }

Vec random_unit(Rng& rng) {
  for (;;) {
    const Vec v{within(rng, 1), within(rng, 1), within(rng, 1)};
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (length > 0.1 && length < 1) return {v[0] / length, v[1] / length, v[2] / length};
  }
}

std::array<float, 3> to_floats(const Vec& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

VectorBox random_box(Rng& rng, const Vec& center, double half) {
  VectorBox box{.center = center, .half = {}};
  for (std::size_t k = 0; k < 3; ++k) {
    box.half[k] = half * rng.unit();
    box.magnitude = std::max(box.magnitude, std::abs(center[k]) + box.half[k]);
  }
  return box;
}

/// A point of the box: often a corner.
Vec random_point(Rng& rng, const VectorBox& box) {
  Vec point = box.center;
  const bool is_corner = rng.maybe();
  for (std::size_t k = 0; k < 3; ++k) {
    const double at = is_corner ? (rng.maybe() ? 1 : -1) : within(rng, 1);
    point[k] += at * box.half[k];
  }
  return point;
}

struct RandomSurface {
  EyeLight light;
  SurfaceBounds bounds;
};

/// Boxes of all sizes and distances, many of which graze the light.
RandomSurface random_surface(Rng& rng) {
  RandomSurface s;
  const double scale = std::exp2(30 * rng.unit() - 15);
  const Vec place{within(rng, 3), within(rng, 3), within(rng, 3)};
  s.bounds.positions = random_box(rng, {place[0] * scale, place[1] * scale, place[2] * scale},
                                  scale * std::exp2(-12 * rng.unit()));
  s.bounds.normals = random_box(rng, random_unit(rng), std::exp2(-14 * rng.unit()));
  s.light.directional = rng.one_in(3);
  const Vec toward = random_unit(rng);
  const double distance = s.light.directional ? 1 : scale * std::exp2(4 * rng.unit() - 2);
  s.light.position = to_floats({toward[0] * distance, toward[1] * distance, toward[2] * distance});
  s.light.spot_cutoff = rng.maybe() ? 180 : static_cast<float>(90 * rng.unit() * rng.unit());
  s.light.spot_direction = to_floats(random_unit(rng));
  return s;
}

LightTerm term_of(const EyeLight& light) {
  const SurfaceMaterial white{
      .ambient = {0, 0, 0}, .diffuse = {1, 1, 1}, .specular = {1, 1, 1}, .emission = {0, 0, 0}};
  const LightingProgram program = plan_lighting(white, {}, {light}, {}, nullptr);
  return program.terms.empty() ? LightTerm{} : program.terms.front();
}

TEST(LightReach, LightsProvenToBeBehindFaceNoNormalOfTheBox) {
  Rng rng(1);
  int proven = 0;
  for (int n = 0; n < 20000; ++n) {
    RandomSurface s = random_surface(rng);
    s.light.spot_cutoff = 180;
    const bool back = rng.maybe();
    if (!is_light_behind(s.light, s.bounds, back)) continue;
    ++proven;
    const LightTerm term = term_of(s.light);
    for (int i = 0; i < 32; ++i) {
      std::array<float, 3> normal = to_floats(random_point(rng, s.bounds.normals));
      if (back)
        for (float& component : normal) component = -component;
      const std::array<float, 3> position = to_floats(random_point(rng, s.bounds.positions));
      const auto light = lighting_reference::incidence_of(term, normal, position);
      ASSERT_FALSE(light.facing) << n;
      ASSERT_EQ(light.n_dot_l, 0) << n;
    }
  }
  EXPECT_GT(proven, 2000);
}

TEST(LightReach, ConesProvenToBeElsewhereLightNoPointOfTheBox) {
  Rng rng(2);
  int proven = 0;
  for (int n = 0; n < 20000; ++n) {
    RandomSurface s = random_surface(rng);
    if (!is_outside_cone(s.light, s.bounds.positions)) continue;
    ++proven;
    const LightTerm term = term_of(s.light);
    for (int i = 0; i < 32; ++i) {
      const auto light =
          lighting_reference::incidence_of(term, {0, 0, 1}, to_floats(random_point(rng, s.bounds.positions)));
      ASSERT_EQ(light.factor, 0) << n << ": cutoff " << s.light.spot_cutoff;
    }
  }
  EXPECT_GT(proven, 2000);
}

/// Degrees between two directions.
double angle(const Vec& a, const Vec& b) {
  const double product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const double lengths =
      std::sqrt((a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]));
  return std::acos(std::clamp(product / lengths, -1.0, 1.0)) * 180 / 3.14159265358979323846;
}

// Small boxes: whatever misses their points by more than 2 degrees is found.
TEST(LightReach, FindsMostLightsThatMissByTwoDegrees) {
  Rng rng(3);
  int misses_behind = 0, found_behind = 0, misses_cone = 0, found_cone = 0;
  for (int n = 0; n < 20000; ++n) {
    RandomSurface s = random_surface(rng);
    double behind = 180, outside = 180;
    for (int i = 0; i < 64; ++i) {
      const Vec normal = random_point(rng, s.bounds.normals), at = random_point(rng, s.bounds.positions);
      const auto& p = s.light.position;
      const Vec to_light =
          s.light.directional ? Vec{p[0], p[1], p[2]} : Vec{p[0] - at[0], p[1] - at[1], p[2] - at[2]};
      behind = std::min(behind, angle(normal, to_light) - 90);
      const auto& d = s.light.spot_direction;
      outside = std::min(outside, angle({-to_light[0], -to_light[1], -to_light[2]}, {d[0], d[1], d[2]}) -
                                      double{s.light.spot_cutoff});
    }
    if (behind > 2) {
      ++misses_behind;
      found_behind += is_light_behind(s.light, s.bounds, false) ? 1 : 0;
    }
    if (outside > 2 && !s.light.directional && s.light.spot_cutoff <= 90) {
      ++misses_cone;
      found_cone += is_outside_cone(s.light, s.bounds.positions) ? 1 : 0;
    }
  }
  std::printf("behind: %d of %d found; outside a cone: %d of %d found\n", found_behind, misses_behind,
              found_cone, misses_cone);
  EXPECT_GT(misses_behind, 1000);
  EXPECT_GT(misses_cone, 1000);
  EXPECT_GE(found_behind, 0.8 * misses_behind);
  EXPECT_GE(found_cone, 0.8 * misses_cone);
}

TEST(LightReach, ProvesNothingForBoxesThatProductsCouldOverflow) {
  const EyeLight light{.directional = true, .position = {0, 0, -1}};
  SurfaceBounds bounds{.positions = {.center = {0, 0, 0}, .half = {1, 1, 1}, .magnitude = 1},
                       .normals = {.center = {0, 0, 1}, .half = {}, .magnitude = 1}};
  EXPECT_TRUE(is_light_behind(light, bounds, false));
  EXPECT_FALSE(is_light_behind(light, bounds, true));
  bounds.normals = {.center = {0, 0, 0x1p60}, .half = {}, .magnitude = 0x1p60};
  EXPECT_FALSE(is_light_behind(light, bounds, false));
  bounds.normals = {};
  EXPECT_FALSE(is_light_behind(light, bounds, false)) << "normals of 0 are on the border";
}

}  // namespace
}  // namespace tessera::detail::light_reach_test
