// The lighting kernels: the same bits as their scalar twin on every instruction set, and the specification's formula.
#include "shading/lighting.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "shading/lighting_reference.h"
#include "tests/raster/tile_stage.h"
#include "tests/shading/lighting_cases.h"

namespace tessera::test {
namespace {

using test::light;

int rounds(int normal) {
  const char* value = std::getenv("TESSERA_LONG");
  return value != nullptr && *value != '\0' && *value != '0' ? normal * 30 : normal;
}

void expect_same_bits(const LightingProgram& program, const std::vector<LightingPoint>& points) {
  for (const Isa isa : available_isas()) {
    const std::vector<Rgb> colors = light(program, points, isa);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Rgb expected = light_point_reference(program, {points[i].normal, points[i].position, points[i].vertex});
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_EQ(std::bit_cast<std::uint32_t>(colors[i][k]), std::bit_cast<std::uint32_t>(expected[k]))
            << name_of(isa) << " point " << i << " component " << k << ": " << colors[i][k] << " for " << expected[k];
    }
  }
}

// Every combination by itself: kind of light x highlight x how that comes about x parts that are ambient or tracked, each with every preparation of the normals.
TEST(Lighting, OfOneLightHasTheBitsOfItsTwin) {
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
        for (const LightTerm& term : program.terms) combinations.insert({term.kind, term.highlight, term.squared, term.sharp, program.tracked, !is_black(term.ambient)});
        expect_same_bits(program, points);
        if (HasFatalFailure()) return;
      }
    }
  }
  // All highlights may be sharp. Squares are those of Blinn's whose S differs from point to point; ambient parts of directional lights are no part of theirs.
  const int highlights = 2 * kHighlightKinds - 1, directional = highlights + 1, positional = highlights + 2;
  EXPECT_EQ(combinations.size(), static_cast<std::size_t>(directional * 2 + (kLightKinds - 1) * positional * 4)) << "some were never run";
}
TEST(Lighting, OfManyLightsHasTheBitsOfItsTwin) {
  RandomLighting random(2);
  for (int round = 0; round < rounds(2000); ++round) {
    std::vector<LightingPoint> points(static_cast<std::size_t>(16 + 16 * (round % 8)));
    for (LightingPoint& p : points) p = random.point();
    expect_same_bits(random.next().program(), points);
    if (HasFatalFailure()) return;
  }
}

// Indices: negative, wrapping, with and without highlights; programs of no, one and many lights.
TEST(Lighting, OfIndicesHasTheBitsOfItsTwin) {
  RandomLighting random(5);
  int wrapped = 0, most = 0, between = 0;
  for (int round = 0; round < rounds(2000); ++round) {
    const LightingCase c = random.next();
    IndexMaterial material{{random.in(-100, 100), random.in(-100, 100), random.in(-100, 100)}, c.material.shininess, std::ldexp(1.0f, round % 24 + 1)};
    if (random.one_in(4)) material.indexes[1] = material.indexes[0];
    if (random.one_in(4)) material.indexes[2] = material.indexes[0];
    if (random.one_in(4)) material.indexes[0] = 0;
    LightingProgram program = plan_index_lighting(material, c.lights, c.model, nullptr);
    program.renormalize = c.renormalize;
    program.negate_normal = c.negate_normal;
    std::vector<LightingPoint> points(kBatchPoints);
    for (LightingPoint& p : points) p = random.point();
    for (const Isa isa : available_isas()) {
      const std::vector<Rgb> colors = light(program, points, isa);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const float expected = light_point_reference(program, {points[i].normal, points[i].position, points[i].vertex})[0];
        ASSERT_EQ(std::bit_cast<std::uint32_t>(colors[i][0]), std::bit_cast<std::uint32_t>(expected)) << name_of(isa) << " point " << i << ": " << colors[i][0] << " for " << expected;
        ASSERT_TRUE(expected >= 0 && expected <= material.modulus);
        wrapped += material.indexes[2] < 0;
        most += expected == material.indexes[2];
        between += expected > material.indexes[0] && expected < material.indexes[2];
      }
    }
  }
  EXPECT_TRUE(wrapped > 1000 && most > 1000 && between > 1000) << wrapped << " " << most << " " << between;
}
// Every kernel's sums, by the formula in double: what a grey material would have, through the last step.
TEST(Lighting, OfIndicesIsThatOfTheFormula) {
  RandomLighting random(6);
  std::size_t compared = 0;
  const auto luminance = [](const Rgb& c) { return 0.30f * c[0] + 0.59f * c[1] + 0.11f * c[2]; };
  for (int round = 0; round < rounds(2000); ++round) {
    LightingCase c = random.next();
    c.lights.resize(std::min<std::size_t>(c.lights.size(), 2));
    c.tracked = {};
    c.material = {{0, 0, 0}, {0.25f, 0, 0}, {0, 0.25f, 0}, {0.5f, 0.5f, 0}, c.material.shininess};  // within 0..1, so that nothing is clamped
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
    for (std::size_t i = 0; i < points.size(); ++i) {
      bool smooth = true;
      const std::array<double, 3> sums = lighting_formula(c, points[i], smooth);
      if (!smooth || sums[0] <= 0 || sums[0] >= 1 || sums[1] <= 0 || sums[1] >= 1) continue;
      const double d = 4 * (sums[0] - 0.5), s = 4 * (sums[1] - 0.5);
      const double index = std::min(3 + d * (1 - s) * 37 + s * 87, 90.0), expected = index - 256 * std::floor(index / 256);
      if (std::abs(index) < 0.01) continue;  // either end of the range
      ASSERT_NEAR(colors[i][0], expected, 0.02) << "round " << round << ", d " << d << ", s " << s;
      ++compared;
    }
  }
  EXPECT_GT(compared, 50000u);
}

double distance_to_formula(const LightingCase& c, const std::vector<LightingPoint>& points, std::size_t* compared = nullptr) {
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

TEST(Lighting, IsWithinOneLevelOfTheFormula) {
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

// 1 - 2^-24 to the power of 16384 is 0.999: what rounding takes from S.n or R.E counts so many times. Normals, light and halfway
// vectors are of length 1 within 2^-23 or so each; the highlight is then off by a few times 2^-23 of its exponent, until it is measured otherwise.
TEST(Lighting, OfSharpHighlightsIsWithinAFewRoundingsOfTheFormula) {
  for (const float shininess : {128.0f, 1000.0f, 4096.0f, 16384.0f}) {
    RandomLighting random(4);
    double worst[2][2][2] = {};
    for (int round = 0; round < rounds(2000); ++round) {
      LightingCase c;
      c.material.specular = {1, 1, 1};
      c.material.shininess = shininess;
      const bool local = round % 2 != 0, phong = round % 4 > 1, point = round % 8 > 3;
      c.model.local_viewer = local;
      c.model.phong_highlight = phong;
      c.renormalize = c.model.unit_normals = true;
      c.lights.push_back(random.light(point ? LightKind::point : LightKind::directional));
      c.lights[0].specular = {1, 0.7f, 0.4f};
      c.lights[0].spot_cutoff = 180;
      // Normals about the halfway vector, so that highlights are seen at all.
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
        if (local) e = {-p.position[0] / std::sqrt(pp), -p.position[1] / std::sqrt(pp), -p.position[2] / std::sqrt(pp)};
        // A viewer nearly opposite to the light would magnify the roundings of both in L + E.
        const bool opposite = l[0] * e[0] + l[1] * e[1] + l[2] * e[2] < -0.8 * std::sqrt(ll);
        for (std::size_t k = 0; k < 3; ++k) {
          p.normal[k] = opposite ? 0.0f : static_cast<float>(l[k] / std::sqrt(ll) + e[k] + 1.5 / std::sqrt(shininess) * (random.unit() - 0.5));
        }
      }
      double& most = worst[point][phong][local];
      most = std::max(most, distance_to_formula(c, points));
    }
    for (const bool point : {false, true}) {
      for (const bool phong : {false, true}) {
        for (const bool local : {false, true}) {
          std::printf("[  figure  ] shininess %g, %s, %s, %s viewer: %.2f levels from the formula\n", shininess, point ? "point light" : "directional", phong ? "Phong" : "Blinn",
                      local ? "local" : "infinite", 255 * worst[point][phong][local]);
          EXPECT_LE(worst[point][phong][local], 8 * 0x1p-23 * shininess);
          EXPECT_LE(worst[point][phong][local], 1 / 255.0);
        }
      }
    }
  }
}

struct Special {
  LightingCase c;
  std::vector<LightingPoint> points = std::vector<LightingPoint>(16);
  Special() {
    c.material = {{0.1f, 0.1f, 0.1f}, {0.5f, 0.5f, 0.5f}, {0.25f, 0.25f, 0.25f}, {0.05f, 0, 0}, 10};
    EyeLight l;
    l.directional = false;
    l.position = {0, 0, 0};
    l.ambient = {0.5f, 0.5f, 0.5f};
    c.lights.push_back(l);
    for (LightingPoint& p : points) p = {{0, 0, 1}, {0, 0, -2}, {1, 1, 1}};
  }
  EyeLight& light() { return c.lights[0]; }
  // By hand: base, then what att and spot multiply.
  void expect(double red, double green) {
    for (const Isa isa : available_isas()) {
      const Rgb color = test::light(c.program(), points, isa)[5];
      EXPECT_NEAR(color[0], red, 2e-6) << name_of(isa);
      EXPECT_NEAR(color[1], green, 2e-6) << name_of(isa);
      EXPECT_EQ(color[1], color[2]);
    }
    EXPECT_LE(distance_to_formula(c, points), 2e-6);
  }
};
constexpr double kBase = 0.2 * 0.1, kGlow = 0.05, kAmbient = 0.05, kDiffuse = 0.5, kSpecular = 0.25;

TEST(LightingSpecialCase, HeadOnEverythingIsSeen) { Special().expect(kGlow + kBase + kAmbient + kDiffuse + kSpecular, kBase + kAmbient + kDiffuse + kSpecular); }
TEST(LightingSpecialCase, AttenuationWithoutAPositiveDenominatorIsAMillion) {
  for (const std::array<float, 3>& coefficients : {std::array<float, 3>{0, 0, 0}, {1, -1, 0}, {1, 0, -1}, {2, -1, 0}}) {
    Special s;
    s.light().attenuation = coefficients;
    s.light().diffuse = s.light().specular = {0, 0, 0};
    s.light().ambient = {2e-6f, 2e-6f, 2e-6f};
    s.expect(kGlow + kBase + 0.2, kBase + 0.2);
  }
}
TEST(LightingSpecialCase, LightAtThePointGivesItsAmbientPartAlone) {
  Special s;
  s.light().position = {0, 0, -2};
  s.expect(kGlow + kBase + kAmbient, kBase + kAmbient);
  s.light().attenuation = {2, 5, 7};
  s.expect(kGlow + kBase + kAmbient / 2, kBase + kAmbient / 2);
  s.light().spot_cutoff = 90;  // V.D <= 0
  s.expect(kGlow + kBase, kBase);
}
TEST(LightingSpecialCase, ZeroNormalsSeeTheAmbientPartAlone) {
  Special s;
  for (LightingPoint& p : s.points) p.normal = {0, 0, 0};
  s.expect(kGlow + kBase + kAmbient, kBase + kAmbient);
  s.c.renormalize = true;
  s.expect(kGlow + kBase + kAmbient, kBase + kAmbient);
  s.c.material.shininess = 0;
  s.expect(kGlow + kBase + kAmbient, kBase + kAmbient);
}
TEST(LightingSpecialCase, SurfacesThatFaceAwayHaveNoHighlight) {
  for (const float shininess : {0.0f, 1.0f, 10.0f}) {
    for (const bool phong : {false, true}) {
      Special s;
      s.c.material.shininess = shininess;
      s.c.model.phong_highlight = phong;
      for (LightingPoint& p : s.points) p.normal = {0, 0, -1};
      s.expect(kGlow + kBase + kAmbient, kBase + kAmbient);
      s.c.negate_normal = true;  // a back face seen from behind
      s.expect(kGlow + kBase + kAmbient + kDiffuse + kSpecular, kBase + kAmbient + kDiffuse + kSpecular);
    }
  }
}
TEST(LightingSpecialCase, ShininessZeroIsAConstantHighlightWhereTheLightFalls) {
  Special s;
  s.c.material.shininess = 0;
  for (LightingPoint& p : s.points) p.normal = {0.8f, 0, 0.6f};
  s.expect(kGlow + kBase + kAmbient + 0.6 * kDiffuse + kSpecular, kBase + kAmbient + 0.6 * kDiffuse + kSpecular);
}
TEST(LightingSpecialCase, ViewerOnTheOtherSideHasNoHalfwayVector) {
  Special s;
  s.light().position = {0, 0, -4};  // L = (0, 0, -1), E = (0, 0, 1)
  for (LightingPoint& p : s.points) p.normal = {0, 0, -1};
  s.expect(kGlow + kBase + kAmbient + kDiffuse, kBase + kAmbient + kDiffuse);
  s.c.material.shininess = 0;
  for (const Isa isa : available_isas()) EXPECT_NEAR(test::light(s.c.program(), s.points, isa)[0][1], kBase + kAmbient + kDiffuse + kSpecular, 2e-6);
}
TEST(LightingSpecialCase, ConesOfZeroNinetyAndAHundredAndEightyDegrees) {
  Special s;
  s.light().spot_direction = {0, 0, -1};
  for (const float exponent : {0.0f, 1.0f, 16384.0f}) {
    s.light().spot_exponent = exponent;
    for (const float cutoff : {0.0f, 90.0f, 180.0f}) {
      s.light().spot_cutoff = cutoff;
      for (const Isa isa : available_isas())
        EXPECT_NEAR(test::light(s.c.program(), s.points, isa)[0][1], kBase + kAmbient + kDiffuse + kSpecular, 2e-6) << "in the axis, cutoff " << cutoff;
    }
  }
  // Beside the light: V.D = 0, outside every cone; 180 degrees is no cone.
  for (LightingPoint& p : s.points) p = {{-1, 0, 0}, {2, 0, 0}, {1, 1, 1}};
  for (const float cutoff : {0.0f, 90.0f}) {
    s.light().spot_cutoff = cutoff;
    for (const Isa isa : available_isas()) EXPECT_NEAR(test::light(s.c.program(), s.points, isa)[0][1], kBase, 2e-6) << "beside the axis, cutoff " << cutoff;
  }
  s.light().spot_cutoff = 180;
  s.light().spot_exponent = 0;
  for (const Isa isa : available_isas()) EXPECT_GT(test::light(s.c.program(), s.points, isa)[0][1], kBase + kAmbient + kDiffuse - 2e-6);
}
TEST(LightingSpecialCase, NegativeLightsDarkenAndTheSumIsClampedOnce) {
  Special s;
  s.c.lights.push_back(s.light());
  for (std::size_t k = 0; k < 3; ++k) {
    s.light().diffuse[k] = 4;  // far above 1 before the second takes some back
    s.c.lights[1].diffuse[k] = -3.5f;
    s.c.lights[1].ambient[k] = s.c.lights[1].specular[k] = 0;
  }
  s.expect(kGlow + kBase + kAmbient + 0.5 * kDiffuse + kSpecular, kBase + kAmbient + 0.5 * kDiffuse + kSpecular);
  s.c.lights[1].diffuse = {-30, -30, -30};
  s.expect(0, 0);
}
// Long normals (of scaled models, not normalized) to a high power, times a bright light: red is full, the others know nothing of it.
TEST(LightingSpecialCase, EndlessHighlightsLeaveBlackComponentsAlone) {
  for (const float length : {1.5f, 3.0f, 100.0f}) {
    Special s;
    s.c.material.specular = {1, 0, 0};
    s.c.material.shininess = 1000;
    s.light().diffuse = {0, 0, 0};
    s.light().ambient = {1e-3f, 1e-3f, 1e-3f};
    s.light().attenuation = {1e-3f, 0, 0};
    for (LightingPoint& p : s.points) p.normal = {0, 0, length};
    for (const Isa isa : available_isas()) {
      const Rgb color = test::light(s.c.program(), s.points, isa)[3];
      EXPECT_EQ(color[0], 1.0f);
      EXPECT_NEAR(color[1], kBase + 0.1, 2e-6);
    }
  }
}
/// A light that brings more than any number, or one of whose factors is more.
struct EndlessLight {
  const char* name;
  std::array<float, 3> normal, position;
  EyeLight light;
};
std::vector<EndlessLight> endless_lights() {
  constexpr float kThird = 0.57735026f, kSixth = 0.4082483f, kMost = std::numeric_limits<float>::max();
  std::vector<EndlessLight> all;
  const auto add = [&](const char* name, const std::array<float, 3>& normal, const auto& change) {
    EyeLight light = Special().light();
    light.ambient = light.diffuse = light.specular = {0, 1, 0};
    all.push_back({name, normal, {0, 0, -2}, light});
    change(all.back());
  };
  const auto attenuated = [](float constant) { return [constant](EndlessLight& e) { e.light.attenuation = {constant, 0, 0}; }; };
  add("the inverse of a small denominator", {0, 0, 1}, attenuated(1e-42f));
  add("the same of the largest colour", {0, 0, 1}, [&](EndlessLight& e) { e.light.attenuation = {1e-42f, 0, 0}, e.light.diffuse = {0, kMost, 0}; });
  add("the same on long normals", {0, 0, 100}, attenuated(1e-42f));
  add("the same on longer ones", {0, 0, 1e10f}, attenuated(1e-42f));
  add("the longest normals", {0, 0, 3e38f}, attenuated(0.5f));
  add("the longest normals, of no attenuation", {3e38f, 3e38f, 3e38f}, [&](EndlessLight& e) { e.light.directional = true, e.light.position = {kThird, kThird, kThird}; });
  // Squares of such distances have few digits: |L| and V.D are 1.2.
  add("a cone and attenuation, from a hair away", {0, 0, 1}, [](EndlessLight& e) {
    e.position = {0, 0, 0};
    e.light.position = {0, 0, 4.5e-23f};
    e.light.attenuation = {0, 1, 0};
    e.light.spot_direction = {0, 0, -1};
    e.light.spot_cutoff = 90;
    e.light.spot_exponent = 16384;
  });
  // The cosine of its direction and its axis is 1 + 2^-23.
  add("the largest colour in a cone's axis", {0, 0, 1}, [&](EndlessLight& e) {
    e.light.directional = true;
    e.light.position = {kSixth, kSixth, 2 * kSixth};
    e.light.spot_direction = {-kSixth, -kSixth, -2 * kSixth};
    e.light.spot_cutoff = 90;
    e.light.spot_exponent = 16384;
    e.light.diffuse = e.light.specular = {0, kMost, 0};
  });
  return all;
}
// What is lit is full, what faces away is not, and black stays black: of the light, of the vertices, and also under highlights without end.
TEST(LightingSpecialCase, EndlessLightsLeaveBlackComponentsAlone) {
  for (const EndlessLight& endless : endless_lights())
    for (const bool tracked : {false, true})
      for (const float ambient : {0.0f, 1.0f}) {
        Special s;
        s.light() = endless.light;
        s.light().ambient[1] = ambient;
        s.c.material.diffuse = {1, 1, 1};
        s.c.material.specular = tracked ? Rgb{} : Rgb{1, 1, 1};
        s.c.material.shininess = 1000;
        s.c.tracked.diffuse = tracked;
        s.points.resize(kBatchPoints);
        for (std::size_t i = 0; i < s.points.size(); ++i) {
          LightingPoint& p = s.points[i];
          p = {endless.normal, endless.position, i % 4 == 3 ? Rgb{0, 0, 0} : Rgb{1, 1, 1}};
          if (i >= 16 && i % 2 == 0)
            for (float& n : p.normal) n = -n;
        }
        SCOPED_TRACE(std::string(endless.name) + (tracked ? ", tracked" : "") + (ambient != 0 ? ", ambient" : ""));
        for (const Isa isa : available_isas()) {
          const std::vector<Rgb> colors = test::light(s.c.program(), s.points, isa);
          for (std::size_t i = 0; i < colors.size(); ++i) {
            EXPECT_NEAR(colors[i][0], kGlow + kBase, 1e-7) << name_of(isa) << " " << i;
            if (i < 16 && (!tracked || i % 4 != 3)) { EXPECT_EQ(colors[i][1], 1) << name_of(isa) << " " << i; }
            if (((i >= 16 && i % 2 == 0) || (tracked && i % 4 == 3)) && ambient == 0) { EXPECT_NEAR(colors[i][1], kBase, 1e-7) << name_of(isa) << " " << i; }
            EXPECT_NEAR(colors[i][2], kBase, 1e-7) << name_of(isa) << " " << i;
          }
        }
        expect_same_bits(s.c.program(), s.points);
        // And where no point of a batch is lit.
        std::vector<LightingPoint> away;
        for (std::size_t i = 16; i < s.points.size(); i += 2) away.push_back(s.points[i]);
        expect_same_bits(s.c.program(), away);
      }
}
// Vertex colours are any numbers, and what is between them may be none: black light makes nothing of them.
TEST(LightingSpecialCase, BlackLightOnEndlessVertexColors) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Special s;
  s.c.tracked.diffuse = true;
  s.light().diffuse = {1, 0, 0};
  s.light().ambient = s.light().specular = {0, 0, 0};
  const float odd[] = {3e38f, -3e38f, kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()};
  for (std::size_t i = 0; i < s.points.size(); ++i) s.points[i].vertex = {1, odd[i % 5], odd[(i + 1) % 5]};
  for (const Isa isa : available_isas())
    for (const Rgb& color : test::light(s.c.program(), s.points, isa)) {
      EXPECT_EQ(color[0], 1);
      EXPECT_NEAR(color[1], kBase, 1e-7);
      EXPECT_NEAR(color[2], kBase, 1e-7);
    }
  expect_same_bits(s.c.program(), s.points);
}
// A highlight without end is full as one is that has an end: the index is the specular one at most, and masked.
TEST(LightingSpecialCase, IndicesUnderEndlessHighlights) {
  for (const float brightness : {1e20f, 3e38f}) {
    Special s;
    s.light().diffuse = s.light().ambient = {0, 0, 0};
    s.light().specular = {brightness, brightness, brightness};
    s.light().attenuation = {1e-30f, 0, 0};
    LightingProgram program = plan_index_lighting({{100, 120, 50}, 10, 256}, s.c.lights, s.c.model, nullptr);
    for (const Isa isa : available_isas()) EXPECT_EQ(test::light(program, s.points, isa)[1][0], 0) << brightness;  // far below 0: no digits are left to mask
    program = plan_index_lighting({{100, 120, 200}, 10, 256}, s.c.lights, s.c.model, nullptr);
    for (const Isa isa : available_isas()) EXPECT_EQ(test::light(program, s.points, isa)[1][0], 200) << brightness;
  }
}
// What has an end is not cut: a normal as long as numbers go, under a light or on a material as weak as they are.
TEST(LightingSpecialCase, LongNormalsAndWeakColorsMakeUpForEachOther) {
  Special s;
  s.light().ambient = s.light().specular = {0, 0, 0};
  s.light().diffuse = {1e-19f, 1e-19f, 1e-19f};
  s.c.material.diffuse = {1e-19f, 1e-19f, 1e-19f};
  for (LightingPoint& p : s.points) p.normal = {0, 0, 0.25e38f};
  s.expect(kGlow + kBase + 0.25, kBase + 0.25);
}
// x^0 is 1 for every x: where R.E has no end, too.
TEST(LightingSpecialCase, ShininessZeroIsAConstantHighlightOfAnyNumber) {
  for (const float size : {1.0f, 1e20f, 3e38f}) {
    Special s;
    s.c.model.phong_highlight = true;
    s.c.material.shininess = 0;
    s.light().directional = true;
    s.light().position = {1, 0, 0};
    s.light().ambient = s.light().diffuse = {0, 0, 0};
    for (LightingPoint& p : s.points) p.normal = {size, 0, -size};
    for (const Isa isa : available_isas()) EXPECT_NEAR(test::light(s.c.program(), s.points, isa)[7][1], kBase + kSpecular, 2e-6) << size;
    expect_same_bits(s.c.program(), s.points);
  }
}
// Roots as high as the tenth make something of cosines that have next to nothing left.
TEST(LightingSpecialCase, SmallExponentsKeepTheSmallestCosines) {
  Special s;
  s.light().position = {0x1p-62f, 0, 1};  // S = (2^-63, 0, 1)
  s.c.renormalize = s.c.model.unit_normals = true;
  for (LightingPoint& p : s.points) p = {{1, 0, 0}, {0, 0, 0}, {1, 1, 1}};
  for (const float shininess : {0.01f, 0.05f, 0.1f}) {
    s.c.material.shininess = shininess;
    for (const Isa isa : available_isas()) EXPECT_NEAR(test::light(s.c.program(), s.points, isa)[2][1], kBase + kAmbient + kSpecular * std::exp2(-63.0 * shininess), 1e-5) << shininess;
  }
}
// Numbers that overflow give some colour within 0..1, and the same one on every instruction set.
TEST(LightingSpecialCase, OverflowStaysWithinRange) {
  RandomLighting random(9);
  for (const float size : {1e-30f, 1e-20f, 1e15f, 1e20f, 1e30f, 3e38f}) {
    for (int round = 0; round < 50; ++round) {
      const LightingCase c = random.next();
      std::vector<LightingPoint> points(kBatchPoints);
      for (LightingPoint& p : points) {
        p = random.point();
        for (std::size_t k = 0; k < 3; ++k) (round % 2 != 0 ? p.normal : p.position)[k] *= size;
      }
      for (const Isa isa : available_isas())
        for (const Rgb& color : light(c.program(), points, isa))
          for (const float component : color) ASSERT_TRUE(component >= 0 && component <= 1) << name_of(isa) << " " << component;
      expect_same_bits(c.program(), points);
    }
  }
}

}  // namespace
}  // namespace tessera::test
