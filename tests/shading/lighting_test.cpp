// Lighting kernels: bit-identical to their scalar twin on every instruction set, and close to the
// specification's formula.
#include "shading/lighting.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <tuple>
#include <vector>

#include "tests/shading/lighting_expectations.h"

namespace tessera::test::lighting_test {
using namespace detail;
namespace {

using test::light;

int rounds(int normal) {
  const char* value = std::getenv("TESSERA_LONG");
  return value != nullptr && *value != '\0' && *value != '0' ? normal * 30 : normal;
}

// Every combination: kind of light x highlight x highlight formula x ambient or tracked parts, each with
// every preparation of the normals.
TEST(LightingKernels, OneLightMatchesTheScalarTwin) {
  RandomLighting random(1);
  std::set<std::tuple<LightKind, HighlightKind, bool, bool, bool, bool>> combinations;
  for (int kind = 0; kind < kLightKinds; ++kind) {
    for (int variant = 0; variant < 128; ++variant) {
      for (int round = 0; round < rounds(4); ++round) {
        LightingCase c;
        c.material = random.material();
        c.material.ambient = c.material.diffuse = {0.5f, 0.6f, 0.7f};
        if (round < 2) c.material.shininess = round == 0 ? 20 : 10000;
        c.material.specular = (variant & 1) != 0 ? Rgb{0.3f, 0.4f, 0.5f} : Rgb{};
        c.model.local_viewer = (variant & 2) != 0;
        c.model.phong_highlight = (variant & 4) != 0;
        c.tracked.diffuse = (variant & 8) != 0;
        c.renormalize = c.model.unit_normals = (variant & 16) != 0;
        c.negate_normal = (variant & 32) != 0;
        c.lights.push_back(random.light(static_cast<LightKind>(kind)));
        c.lights[0].diffuse = c.lights[0].specular = {0.9f, 0.8f, 0.7f};
        c.lights[0].ambient = (variant & 64) != 0 ? Rgb{0.1f, 0.2f, 0.3f} : Rgb{};
        std::vector<LightingPoint> points(kBatchPoints);
        for (LightingPoint& p : points) p = random.point();
        const LightingProgram program = c.program();
        for (const LightTerm& term : program.terms)
          combinations.insert({term.kind, term.highlight, term.squared, term.sharp, program.tracked,
                               !is_black(term.ambient)});
        expect_same_bits(program, points);
        if (HasFatalFailure()) return;
      }
    }
  }
  // All highlights may be sharp. Squared ones exist only for Blinn with S varying per point: one kind of
  // highlight for directional lights, two for others. Ambient parts of directional lights are in no term.
  const int highlights = 2 * kHighlightKinds - 1;
  const int directional = highlights + 1;
  const int positional = highlights + 2;
  EXPECT_EQ(combinations.size(),
            static_cast<std::size_t>(directional * 2 + (kLightKinds - 1) * positional * 4))
      << "some kernels never ran";
}

TEST(LightingKernels, ManyLightsMatchTheScalarTwin) {
  RandomLighting random(2);
  for (int round = 0; round < rounds(2000); ++round) {
    std::vector<LightingPoint> points(static_cast<std::size_t>(16 + 16 * (round % 8)));
    for (LightingPoint& p : points) p = random.point();
    expect_same_bits(random.next().program(), points);
    if (HasFatalFailure()) return;
  }
}

// On both sides of the edge of cones wider and narrower than kNarrowCone.
TEST(LightingKernels, NarrowConesMatchTheScalarTwin) {
  RandomLighting random(7);
  int inside = 0, outside = 0;
  for (int round = 0; round < rounds(200); ++round) {
    LightingCase c = random.next();
    c.lights = {random.light(round % 2 == 0 ? LightKind::spot : LightKind::attenuated_spot)};
    EyeLight& l = c.lights[0];
    constexpr float kCutoffs[] = {0, 1e-4f, 0.01f, 0.3f, 0.99f, 1, 1.5f};
    l.spot_cutoff = kCutoffs[static_cast<std::size_t>(round % 7)];
    l.spot_direction = random.direction();
    l.ambient = {0.5f, 0.5f, 0.5f};
    c.material.ambient = {1, 1, 1};
    c.tracked = {};
    std::vector<LightingPoint> points(kBatchPoints);
    for (LightingPoint& p : points) {
      p = random.point();
      const std::array<float, 3> aside = random.direction();
      const float reach = random.in(0, 2.5) * std::max(l.spot_cutoff, 1e-6f) * 0.017453f;
      const float distance = random.in(0.1, 50);
      for (std::size_t k = 0; k < 3; ++k)
        p.position[k] = l.position[k] + distance * (l.spot_direction[k] + reach * aside[k]);
    }
    expect_same_bits(c.program(), points);
    if (HasFatalFailure()) return;
    LightingProgram ambient_alone = c.program();
    ambient_alone.base = {0, 0, 0};
    ambient_alone.terms[0].diffuse = ambient_alone.terms[0].specular = {0, 0, 0};
    for (const Rgb& color : light(ambient_alone, points, available_isas().front()))
      (color[0] > 0 ? inside : outside) += 1;
  }
  EXPECT_TRUE(inside > 2000 && outside > 2000) << inside << " " << outside;
}

// Indices: negative, wrapping, with and without highlights; programs of no, one and many lights.
TEST(LightingKernels, IndicesMatchTheScalarTwin) {
  RandomLighting random(5);
  int wrapped = 0, full = 0, between = 0;
  for (int round = 0; round < rounds(2000); ++round) {
    const LightingCase c = random.next();
    IndexMaterial material{{random.in(-100, 100), random.in(-100, 100), random.in(-100, 100)},
                           c.material.shininess,
                           std::ldexp(1.0f, round % 24 + 1)};
    if (random.one_in(4)) material.indexes[1] = material.indexes[0];
    if (random.one_in(4)) material.indexes[2] = material.indexes[0];
    if (random.one_in(4)) material.indexes[0] = 0;
    LightingProgram program = plan_index_lighting(material, c.lights, c.model, nullptr);
    program.renormalize = c.renormalize;
    program.negate_normal = c.negate_normal;
    std::vector<LightingPoint> points(kBatchPoints);
    for (LightingPoint& p : points) p = random.point();
    for (const InstructionSet isa : available_isas()) {
      const std::vector<Rgb> colors = light(program, points, isa);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const float expected =
            light_point_reference(program, {points[i].normal, points[i].position, points[i].vertex})[0];
        ASSERT_EQ(std::bit_cast<std::uint32_t>(colors[i][0]), std::bit_cast<std::uint32_t>(expected))
            << name_of(isa) << " point " << i << ": " << colors[i][0] << " for " << expected;
        ASSERT_TRUE(expected >= 0 && expected <= material.modulus);
        wrapped += material.indexes[2] < 0;
        full += expected == material.indexes[2];
        between += expected > material.indexes[0] && expected < material.indexes[2];
      }
    }
  }
  EXPECT_TRUE(wrapped > 1000 && full > 1000 && between > 1000) << wrapped << " " << full << " " << between;
}

// Indices of every kernel against those of the formula in double, whose red and green are the sums d and s.
// Sharp highlights may be off by 16 u per unit of the exponent (tests/numerics/README.md), times the
// derivative of the index by s.
TEST(LightingKernels, IndicesMatchTheFormula) {
  RandomLighting random(6);
  std::size_t compared = 0;
  const auto luminance = [](const Rgb& c) { return 0.30f * c[0] + 0.59f * c[1] + 0.11f * c[2]; };
  for (int round = 0; round < rounds(2000); ++round) {
    LightingCase c = random.next();
    c.lights.resize(std::min<std::size_t>(c.lights.size(), 2));
    c.tracked = {};
    // Within 0..1, so that nothing is clamped.
    c.material = {{0, 0, 0}, {0.25f, 0, 0}, {0, 0.25f, 0}, {0.5f, 0.5f, 0}, c.material.shininess};
    c.model.scene_ambient = {0, 0, 0};
    const IndexMaterial material{{3, 40, 90}, c.material.shininess, 256};
    LightingProgram program = plan_index_lighting(material, c.lights, c.model, nullptr);
    program.renormalize = c.renormalize;
    program.negate_normal = c.negate_normal;
    std::vector<LightingPoint> points(kBatchPoints);
    for (LightingPoint& p : points) p = random.point();
    const std::vector<Rgb> colors = light(program, points, available_isas().front());
    for (EyeLight& l : c.lights) {
      l.ambient = {0, 0, 0};
      l.diffuse = Rgb{1, 1, 1} * luminance(l.diffuse);
      l.specular = Rgb{1, 1, 1} * luminance(l.specular);
    }
    LightingCase sizes = c;  // magnitudes of the highlights: some lights subtract
    for (EyeLight& l : sizes.lights) l.specular = Rgb{1, 1, 1} * std::abs(l.specular[0]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      bool smooth = true;
      const std::array<double, 3> sums = lighting_formula(c, points[i], smooth);
      const bool is_clamped = sums[0] <= 0 || sums[0] >= 1 || sums[1] <= 0 || sums[1] >= 1;
      if (!smooth || is_clamped) continue;
      const double d = 4 * (sums[0] - 0.5), s = 4 * (sums[1] - 0.5);
      const double index = std::min(3 + d * (1 - s) * 37 + s * 87, 90.0);
      const double expected = index - 256 * std::floor(index / 256);
      if (std::abs(index) < 0.01) continue;  // either end of the range
      const double highlights_off =
          16 * 0x1p-24 * c.material.shininess * 4 * (lighting_formula(sizes, points[i], smooth)[1] - 0.5);
      ASSERT_NEAR(colors[i][0], expected, 0.005 + highlights_off * std::abs(87 - 37 * d))
          << "round " << round << ", d " << d << ", s " << s;
      ++compared;
    }
  }
  EXPECT_GT(compared, 50000u);
}

TEST(LightingKernels, IsWithinOneLevelOfTheFormula) {
  RandomLighting random(3);
  double worst = 0;
  std::size_t compared = 0, all = 0;
  for (int round = 0; round < rounds(4000); ++round) {
    const LightingCase c = random.next();
    std::vector<LightingPoint> points(kBatchPoints);
    for (LightingPoint& p : points) p = random.point();
    all += points.size();
    const double distance = distance_to_formula(c, points, &compared);
    ASSERT_LE(distance, 1 / 255.0) << "round " << round << ", shininess " << c.material.shininess;
    worst = std::max(worst, distance);
  }
  EXPECT_GT(compared, all * 9 / 10) << "too many points were called discontinuous";
  RecordProperty("worst_1e9", static_cast<int>(worst * 1e9));
  std::printf("[  figure  ] lighting, largest distance to the formula: %.3g (1/255 is 0.0039)\n", worst);
}

// 1 - 2^-24 to the power of 16384 is 0.999: rounding errors of S.n or R.E are multiplied by the exponent.
// Normals, light and halfway vectors have length 1 within about 2^-23 each, so the highlight is off by a few
// times 2^-23 times the exponent.
TEST(LightingKernels, SharpHighlightsAreWithinAFewRoundingsOfTheFormula) {
  for (const float shininess : {128.0f, 1000.0f, 4096.0f, 16384.0f}) {
    RandomLighting random(4);
    double worst[2][2][2] = {};
    for (int round = 0; round < rounds(2000); ++round) {
      LightingCase c;
      c.material.specular = {1, 1, 1};
      c.material.shininess = shininess;
      const bool local = round % 2 != 0;
      const bool phong = round % 4 > 1;
      const bool point = round % 8 > 3;
      c.model.local_viewer = local;
      c.model.phong_highlight = phong;
      c.renormalize = c.model.unit_normals = true;
      c.lights.push_back(random.light(point ? LightKind::point : LightKind::directional));
      c.lights[0].specular = {1, 0.7f, 0.4f};
      c.lights[0].spot_cutoff = 180;
      // Normals around the halfway vector, so that highlights are visible.
      std::vector<LightingPoint> points(kBatchPoints);
      for (LightingPoint& p : points) {
        p = random.point();
        std::array<double, 3> l{}, e{0, 0, 1};
        double ll = 0, pp = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          l[k] = point ? double{c.lights[0].position[k]} - p.position[k] : c.lights[0].position[k];
          ll += l[k] * l[k];
          pp += double{p.position[k]} * p.position[k];
        }
        if (local)
          e = {-p.position[0] / std::sqrt(pp), -p.position[1] / std::sqrt(pp),
               -p.position[2] / std::sqrt(pp)};
        // A viewer nearly opposite to the light would amplify the roundings of both in L + E.
        const double l_dot_e = l[0] * e[0] + l[1] * e[1] + l[2] * e[2];
        const bool opposite = l_dot_e < -0.8 * std::sqrt(ll);
        for (std::size_t k = 0; k < 3; ++k) {
          p.normal[k] = opposite ? 0.0f
                                 : static_cast<float>(l[k] / std::sqrt(ll) + e[k] +
                                                      1.5 / std::sqrt(shininess) * (random.unit() - 0.5));
        }
      }
      double& most = worst[point][phong][local];
      most = std::max(most, distance_to_formula(c, points));
    }
    for (const bool point : {false, true}) {
      for (const bool phong : {false, true}) {
        for (const bool local : {false, true}) {
          std::printf("[  figure  ] shininess %g, %s, %s, %s viewer: %.2f levels from the formula\n",
                      shininess, point ? "point light" : "directional", phong ? "Phong" : "Blinn",
                      local ? "local" : "infinite", 255 * worst[point][phong][local]);
          EXPECT_LE(worst[point][phong][local], 8 * 0x1p-23 * shininess);
          EXPECT_LE(worst[point][phong][local], 1 / 255.0);
        }
      }
    }
  }
}

}  // namespace
}  // namespace tessera::test::lighting_test
