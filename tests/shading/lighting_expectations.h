// Expectations for the lighting kernels: the scalar twin bit by bit, the formula in double, and a surface
// whose colour is computed by hand.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "shading/lighting_reference.h"
#include "tests/raster/tile_harness.h"
#include "tests/shading/lighting_cases.h"

namespace tessera::test {
using namespace detail;

inline void expect_same_bits(const LightingProgram& program, const std::vector<LightingPoint>& points) {
  for (const InstructionSet isa : available_isas()) {
    const std::vector<Rgb> colors = light(program, points, isa);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Rgb expected =
          light_point_reference(program, {points[i].normal, points[i].position, points[i].vertex});
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_EQ(std::bit_cast<std::uint32_t>(colors[i][k]), std::bit_cast<std::uint32_t>(expected[k]))
            << name_of(isa) << " point " << i << " component " << k << ": " << colors[i][k] << " for "
            << expected[k];
    }
  }
}

inline double distance_to_formula(const LightingCase& c, const std::vector<LightingPoint>& points,
                                  std::size_t* compared = nullptr) {
  double worst = 0;
  const std::vector<Rgb> colors = light(c.program(), points, available_isas().front());
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool smooth = true;
    const std::array<double, 3> expected = lighting_formula(c, points[i], smooth);
    if (!smooth) continue;
    if (compared) ++*compared;
    for (std::size_t k = 0; k < 3; ++k) worst = std::max(worst, std::abs(colors[i][k] - expected[k]));
  }
  return worst;
}

/// A point light at the eye, and a surface that faces it.
struct KnownColorCase {
  LightingCase c;
  std::vector<LightingPoint> points = std::vector<LightingPoint>(16);
  KnownColorCase() {
    c.material = {{0.1f, 0.1f, 0.1f}, {0.5f, 0.5f, 0.5f}, {0.25f, 0.25f, 0.25f}, {0.05f, 0, 0}, 10};
    EyeLight l;
    l.directional = false;
    l.position = {0, 0, 0};
    l.ambient = {0.5f, 0.5f, 0.5f};
    c.lights.push_back(l);
    for (LightingPoint& p : points) p = {{0, 0, 1}, {0, 0, -2}, {1, 1, 1}};
  }
  EyeLight& light() { return c.lights[0]; }
  /// Expects a colour computed by hand: red, and green and blue, which are equal.
  void expect(double red, double green) {
    for (const InstructionSet isa : available_isas()) {
      const Rgb color = test::light(c.program(), points, isa)[5];
      EXPECT_NEAR(color[0], red, 2e-6) << name_of(isa);
      EXPECT_NEAR(color[1], green, 2e-6) << name_of(isa);
      EXPECT_EQ(color[1], color[2]);
    }
    EXPECT_LE(distance_to_formula(c, points), 2e-6);
  }
};
// Terms of KnownColorCase.
inline constexpr double kGlow = 0.05;       // emission, only red
inline constexpr double kBase = 0.2 * 0.1;  // scene ambient
inline constexpr double kAmbient = 0.05;
inline constexpr double kDiffuse = 0.5;
inline constexpr double kSpecular = 0.25;

}  // namespace tessera::test
