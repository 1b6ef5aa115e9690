// Lighting whose intermediate values overflow float: lit components saturate, black components stay black,
// and every instruction set gives the same result.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "shading/lighting.h"
#include "tests/shading/lighting_expectations.h"

namespace tessera::test::lighting_overflow_test {
using namespace detail;
namespace {

// Long normals (of scaled models, not normalized) to a high power, times a bright light: red saturates, the
// other components are unaffected.
TEST(LightingOverflow, InfiniteHighlightsLeaveBlackComponentsAlone) {
  for (const float length : {1.5f, 3.0f, 100.0f}) {
    KnownColorCase s;
    s.c.material.specular = {1, 0, 0};
    s.c.material.shininess = 1000;
    s.light().diffuse = {0, 0, 0};
    s.light().ambient = {1e-3f, 1e-3f, 1e-3f};
    s.light().attenuation = {1e-3f, 0, 0};
    for (LightingPoint& p : s.points) p.normal = {0, 0, length};
    for (const InstructionSet isa : available_isas()) {
      const Rgb color = test::light(s.c.program(), s.points, isa)[3];
      EXPECT_EQ(color[0], 1.0f);
      EXPECT_NEAR(color[1], kBase + 0.1, 2e-6);
    }
  }
}

// Squared distances from 2^64 on overflow. Attenuation then uses the largest float, and is 10^6 only if its
// denominator is not positive.
TEST(LightingOverflow, AttenuationOfHugeDistancesIsFinite) {
  struct Row {
    std::array<float, 3> attenuation;
    double factor;
  };
  for (const float distance :
       {1e19f, 1e20f, 1e30f, std::numeric_limits<float>::max(), std::numeric_limits<float>::infinity()})
    for (const Row& row :
         {Row{{2, 0, 0}, 0.5}, Row{{1, 0.1f, 0}, 0}, Row{{1, 0, 0.1f}, 0}, Row{{4, 1e-45f, 0}, 0.25},
          Row{{-1, 0, 0}, 1e6}, Row{{1, -1, 0}, 1e6}, Row{{1, 0, -1}, 1e6}}) {
      KnownColorCase s;
      s.light().ambient = s.light().diffuse = s.light().specular = {0, 0, 0};
      s.light().ambient[1] = row.factor > 1 ? 1e-6f : 1.0f;
      s.light().position = {0, 0, 1};
      s.light().attenuation = row.attenuation;
      s.c.material.ambient = {0, 0.5f, 0};
      for (LightingPoint& p : s.points) p.position = {distance, 0, -2};
      for (const InstructionSet isa : available_isas())
        EXPECT_NEAR(test::light(s.c.program(), s.points, isa)[7][1],
                    0.2 * 0.5 + 0.5 * s.light().ambient[1] * row.factor, 1e-5)
            << name_of(isa) << ", distance " << distance << ", attenuation " << row.attenuation[0] << " "
            << row.attenuation[1] << " " << row.attenuation[2];
      expect_same_bits(s.c.program(), s.points);
    }
}

/// A lit point whose light, or one factor of it, overflows float.
struct OverflowingLight {
  const char* name;
  std::array<float, 3> normal;    ///< normal of the point
  std::array<float, 3> position;  ///< position of the point
  EyeLight light;
};
std::vector<OverflowingLight> overflowing_lights() {
  constexpr float kInverseSqrt3 = 0.57735026f;
  constexpr float kInverseSqrt6 = 0.4082483f;
  constexpr float kLargest = std::numeric_limits<float>::max();
  std::vector<OverflowingLight> all;
  const auto add = [&](const char* name, const std::array<float, 3>& normal, const auto& change) {
    EyeLight light = KnownColorCase().light();
    light.ambient = light.diffuse = light.specular = {0, 1, 0};
    all.push_back({name, normal, {0, 0, -2}, light});
    change(all.back());
  };
  const auto attenuated = [](float constant) {
    return [constant](OverflowingLight& e) { e.light.attenuation = {constant, 0, 0}; };
  };
  add("attenuation 1e-42", {0, 0, 1}, attenuated(1e-42f));
  add("attenuation 1e-42, largest colour", {0, 0, 1}, [&](OverflowingLight& e) {
    e.light.attenuation = {1e-42f, 0, 0};
    e.light.diffuse = {0, kLargest, 0};
  });
  add("attenuation 1e-42, normals of length 100", {0, 0, 100}, attenuated(1e-42f));
  add("attenuation 1e-42, normals of length 1e10", {0, 0, 1e10f}, attenuated(1e-42f));
  add("normals of length 3e38", {0, 0, 3e38f}, attenuated(0.5f));
  add("directional light, normals of length 5e38", {3e38f, 3e38f, 3e38f}, [&](OverflowingLight& e) {
    e.light.directional = true;
    e.light.position = {kInverseSqrt3, kInverseSqrt3, kInverseSqrt3};
  });
  // Squares of such small distances have few digits: |L| and V.D come out as 1.2.
  add("spot light at a distance of 4.5e-23", {0, 0, 1}, [](OverflowingLight& e) {
    e.position = {0, 0, 0};
    e.light.position = {0, 0, 4.5e-23f};
    e.light.attenuation = {0, 1, 0};
    e.light.spot_direction = {0, 0, -1};
    e.light.spot_cutoff = 90;
    e.light.spot_exponent = 16384;
  });
  // The computed cosine between its direction and its axis is 1 + 2^-23.
  add("spot light of the largest colour, on its axis", {0, 0, 1}, [&](OverflowingLight& e) {
    e.light.directional = true;
    e.light.position = {kInverseSqrt6, kInverseSqrt6, 2 * kInverseSqrt6};
    e.light.spot_direction = {-kInverseSqrt6, -kInverseSqrt6, -2 * kInverseSqrt6};
    e.light.spot_cutoff = 90;
    e.light.spot_exponent = 16384;
    e.light.diffuse = e.light.specular = {0, kLargest, 0};
  });
  return all;
}

// Lit components saturate, back-facing points stay unlit, and black stays black: for black lights, black
// vertices, and under infinite highlights.
TEST(LightingOverflow, InfiniteLightsLeaveBlackComponentsAlone) {
  const auto has_black_vertex = [](std::size_t i) { return i % 4 == 3; };
  const auto faces_away = [](std::size_t i) { return i >= 16 && i % 2 == 0; };
  for (const OverflowingLight& lit : overflowing_lights())
    for (const bool tracked : {false, true})
      for (const float ambient : {0.0f, 1.0f}) {
        KnownColorCase s;
        s.light() = lit.light;
        s.light().ambient[1] = ambient;
        s.c.material.diffuse = {1, 1, 1};
        s.c.material.specular = tracked ? Rgb{} : Rgb{1, 1, 1};
        s.c.material.shininess = 1000;
        s.c.tracked.diffuse = tracked;
        s.points.resize(kBatchPoints);
        for (std::size_t i = 0; i < s.points.size(); ++i) {
          LightingPoint& p = s.points[i];
          p = {lit.normal, lit.position, has_black_vertex(i) ? Rgb{0, 0, 0} : Rgb{1, 1, 1}};
          if (faces_away(i))
            for (float& n : p.normal) n = -n;
        }
        SCOPED_TRACE(std::string(lit.name) + (tracked ? ", tracked" : "") +
                     (ambient != 0 ? ", ambient" : ""));
        for (const InstructionSet isa : available_isas()) {
          const std::vector<Rgb> colors = test::light(s.c.program(), s.points, isa);
          for (std::size_t i = 0; i < colors.size(); ++i) {
            EXPECT_NEAR(colors[i][0], kGlow + kBase, 1e-7) << name_of(isa) << " " << i;
            const bool is_black = tracked && has_black_vertex(i);
            if (i < 16 && !is_black) {
              EXPECT_EQ(colors[i][1], 1) << name_of(isa) << " " << i;
            }
            if ((faces_away(i) || is_black) && ambient == 0) {
              EXPECT_NEAR(colors[i][1], kBase, 1e-7) << name_of(isa) << " " << i;
            }
            EXPECT_NEAR(colors[i][2], kBase, 1e-7) << name_of(isa) << " " << i;
          }
        }
        expect_same_bits(s.c.program(), s.points);
        // Batches without a lit point.
        std::vector<LightingPoint> away;
        for (std::size_t i = 16; i < s.points.size(); i += 2) away.push_back(s.points[i]);
        expect_same_bits(s.c.program(), away);
      }
}

// Vertex colours may be any number and interpolate to NaN; a black light contributes nothing.
TEST(LightingOverflow, BlackLightOnInfiniteVertexColors) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  KnownColorCase s;
  s.c.tracked.diffuse = true;
  s.light().diffuse = {1, 0, 0};
  s.light().ambient = s.light().specular = {0, 0, 0};
  const float odd[] = {3e38f, -3e38f, kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()};
  for (std::size_t i = 0; i < s.points.size(); ++i) s.points[i].vertex = {1, odd[i % 5], odd[(i + 1) % 5]};
  for (const InstructionSet isa : available_isas())
    for (const Rgb& color : test::light(s.c.program(), s.points, isa)) {
      EXPECT_EQ(color[0], 1);
      EXPECT_NEAR(color[1], kBase, 1e-7);
      EXPECT_NEAR(color[2], kBase, 1e-7);
    }
  expect_same_bits(s.c.program(), s.points);
}

// An infinite highlight counts as a full one: the index is at most the specular index, and masked.
TEST(LightingOverflow, IndicesUnderInfiniteHighlights) {
  for (const float brightness : {1e20f, 3e38f}) {
    KnownColorCase s;
    s.light().diffuse = s.light().ambient = {0, 0, 0};
    s.light().specular = {brightness, brightness, brightness};
    s.light().attenuation = {1e-30f, 0, 0};
    LightingProgram program = plan_index_lighting({{100, 120, 50}, 10, 256}, s.c.lights, s.c.model, nullptr);
    for (const InstructionSet isa : available_isas())
      // Far below 0, where no fraction digits are left to mask.
      EXPECT_EQ(test::light(program, s.points, isa)[1][0], 0) << brightness;
    program = plan_index_lighting({{100, 120, 200}, 10, 256}, s.c.lights, s.c.model, nullptr);
    for (const InstructionSet isa : available_isas())
      EXPECT_EQ(test::light(program, s.points, isa)[1][0], 200) << brightness;
  }
}

// Finite results are exact: the longest possible normal with the weakest light and material.
TEST(LightingOverflow, LongNormalsTimesWeakColorsAreExact) {
  KnownColorCase s;
  s.light().ambient = s.light().specular = {0, 0, 0};
  s.light().diffuse = {1e-19f, 1e-19f, 1e-19f};
  s.c.material.diffuse = {1e-19f, 1e-19f, 1e-19f};
  for (LightingPoint& p : s.points) p.normal = {0, 0, 0.25e38f};
  s.expect(kGlow + kBase + 0.25, kBase + 0.25);
}

// Overflow yields a colour within 0..1, identical on every instruction set.
TEST(LightingOverflow, OverflowStaysWithinRange) {
  RandomLighting random(9);
  for (const float size : {1e-30f, 1e-20f, 1e15f, 1e20f, 1e30f, 3e38f}) {
    for (int round = 0; round < 50; ++round) {
      const LightingCase c = random.next();
      std::vector<LightingPoint> points(kBatchPoints);
      for (LightingPoint& p : points) {
        p = random.point();
        for (std::size_t k = 0; k < 3; ++k) (round % 2 != 0 ? p.normal : p.position)[k] *= size;
      }
      for (const InstructionSet isa : available_isas())
        for (const Rgb& color : light(c.program(), points, isa))
          for (const float component : color)
            ASSERT_TRUE(component >= 0 && component <= 1) << name_of(isa) << " " << component;
      expect_same_bits(c.program(), points);
    }
  }
}

}  // namespace
}  // namespace tessera::test::lighting_overflow_test
