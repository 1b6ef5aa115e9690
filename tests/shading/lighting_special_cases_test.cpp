// Lighting with a term at the end of its range: colours computed by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "shading/lighting.h"
#include "tests/shading/lighting_expectations.h"

namespace tessera::test::lighting_special_cases_test {
using namespace detail;
namespace {

TEST(LightingSpecialCase, HeadOnShowsEveryTerm) {
  KnownColorCase().expect(kGlow + kBase + kAmbient + kDiffuse + kSpecular,
                          kBase + kAmbient + kDiffuse + kSpecular);
}

TEST(LightingSpecialCase, AttenuationWithoutAPositiveDenominatorIsOneMillion) {
  for (const std::array<float, 3>& coefficients :
       {std::array<float, 3>{0, 0, 0}, {1, -1, 0}, {1, 0, -1}, {2, -1, 0}}) {
    KnownColorCase s;
    s.light().attenuation = coefficients;
    s.light().diffuse = s.light().specular = {0, 0, 0};
    s.light().ambient = {2e-6f, 2e-6f, 2e-6f};
    s.expect(kGlow + kBase + 0.2, kBase + 0.2);
  }
}

TEST(LightingSpecialCase, LightAtThePointAddsItsAmbientPartOnly) {
  KnownColorCase s;
  s.light().position = {0, 0, -2};
  s.expect(kGlow + kBase + kAmbient, kBase + kAmbient);
  s.light().attenuation = {2, 5, 7};
  s.expect(kGlow + kBase + kAmbient / 2, kBase + kAmbient / 2);
  s.light().spot_cutoff = 90;  // V.D <= 0
  s.expect(kGlow + kBase, kBase);
}

TEST(LightingSpecialCase, ZeroNormalsReceiveTheAmbientPartOnly) {
  KnownColorCase s;
  for (LightingPoint& p : s.points) p.normal = {0, 0, 0};
  s.expect(kGlow + kBase + kAmbient, kBase + kAmbient);
  s.c.renormalize = true;
  s.expect(kGlow + kBase + kAmbient, kBase + kAmbient);
  s.c.material.shininess = 0;
  s.expect(kGlow + kBase + kAmbient, kBase + kAmbient);
}

TEST(LightingSpecialCase, BackFacingSurfacesHaveNoHighlight) {
  for (const float shininess : {0.0f, 1.0f, 10.0f}) {
    for (const bool phong : {false, true}) {
      KnownColorCase s;
      s.c.material.shininess = shininess;
      s.c.model.phong_highlight = phong;
      for (LightingPoint& p : s.points) p.normal = {0, 0, -1};
      s.expect(kGlow + kBase + kAmbient, kBase + kAmbient);
      s.c.negate_normal = true;  // a visible back face
      s.expect(kGlow + kBase + kAmbient + kDiffuse + kSpecular, kBase + kAmbient + kDiffuse + kSpecular);
    }
  }
}

TEST(LightingSpecialCase, ShininessZeroIsAConstantHighlightWhereTheLightFalls) {
  KnownColorCase s;
  s.c.material.shininess = 0;
  for (LightingPoint& p : s.points) p.normal = {0.8f, 0, 0.6f};
  s.expect(kGlow + kBase + kAmbient + 0.6 * kDiffuse + kSpecular,
           kBase + kAmbient + 0.6 * kDiffuse + kSpecular);
}

TEST(LightingSpecialCase, ViewerOnTheOtherSideHasNoHalfwayVector) {
  KnownColorCase s;
  s.light().position = {0, 0, -4};  // L = (0, 0, -1), E = (0, 0, 1)
  for (LightingPoint& p : s.points) p.normal = {0, 0, -1};
  s.expect(kGlow + kBase + kAmbient + kDiffuse, kBase + kAmbient + kDiffuse);
  s.c.material.shininess = 0;
  for (const InstructionSet isa : available_isas())
    EXPECT_NEAR(test::light(s.c.program(), s.points, isa)[0][1], kBase + kAmbient + kDiffuse + kSpecular,
                2e-6);
}

TEST(LightingSpecialCase, ConesOf0And90And180Degrees) {
  KnownColorCase s;
  s.light().spot_direction = {0, 0, -1};
  for (const float exponent : {0.0f, 1.0f, 16384.0f}) {
    s.light().spot_exponent = exponent;
    for (const float cutoff : {0.0f, 90.0f, 180.0f}) {
      s.light().spot_cutoff = cutoff;
      for (const InstructionSet isa : available_isas())
        EXPECT_NEAR(test::light(s.c.program(), s.points, isa)[0][1], kBase + kAmbient + kDiffuse + kSpecular,
                    2e-6)
            << "on the axis, cutoff " << cutoff;
    }
  }
  // Next to the light: V.D = 0, outside every cone; 180 degrees is no cone.
  for (LightingPoint& p : s.points) p = {{-1, 0, 0}, {2, 0, 0}, {1, 1, 1}};
  for (const float cutoff : {0.0f, 90.0f}) {
    s.light().spot_cutoff = cutoff;
    for (const InstructionSet isa : available_isas())
      EXPECT_NEAR(test::light(s.c.program(), s.points, isa)[0][1], kBase, 2e-6)
          << "off the axis, cutoff " << cutoff;
  }
  s.light().spot_cutoff = 180;
  s.light().spot_exponent = 0;
  for (const InstructionSet isa : available_isas())
    EXPECT_GT(test::light(s.c.program(), s.points, isa)[0][1], kBase + kAmbient + kDiffuse - 2e-6);
}

TEST(LightingSpecialCase, NegativeLightsDarkenAndTheSumIsClampedOnce) {
  KnownColorCase s;
  s.c.lights.push_back(s.light());
  for (std::size_t k = 0; k < 3; ++k) {
    s.light().diffuse[k] = 4;  // far above 1, before the second light subtracts
    s.c.lights[1].diffuse[k] = -3.5f;
    s.c.lights[1].ambient[k] = s.c.lights[1].specular[k] = 0;
  }
  s.expect(kGlow + kBase + kAmbient + 0.5 * kDiffuse + kSpecular,
           kBase + kAmbient + 0.5 * kDiffuse + kSpecular);
  s.c.lights[1].diffuse = {-30, -30, -30};
  s.expect(0, 0);
}

// x^0 is 1 for every x, even if R.E is infinite.
TEST(LightingSpecialCase, ShininessZeroIsAConstantHighlightForAnyBase) {
  for (const float size : {1.0f, 1e20f, 3e38f}) {
    KnownColorCase s;
    s.c.model.phong_highlight = true;
    s.c.material.shininess = 0;
    s.light().directional = true;
    s.light().position = {1, 0, 0};
    s.light().ambient = s.light().diffuse = {0, 0, 0};
    for (LightingPoint& p : s.points) p.normal = {size, 0, -size};
    for (const InstructionSet isa : available_isas())
      EXPECT_NEAR(test::light(s.c.program(), s.points, isa)[7][1], kBase + kSpecular, 2e-6) << size;
    expect_same_bits(s.c.program(), s.points);
  }
}

// Small exponents, down to the tenth root, yield visible highlights for tiny cosines.
TEST(LightingSpecialCase, SmallExponentsKeepTinyCosines) {
  KnownColorCase s;
  s.light().position = {0x1p-62f, 0, 1};  // S = (2^-63, 0, 1)
  s.c.renormalize = s.c.model.unit_normals = true;
  for (LightingPoint& p : s.points) p = {{1, 0, 0}, {0, 0, 0}, {1, 1, 1}};
  for (const float shininess : {0.01f, 0.05f, 0.1f}) {
    s.c.material.shininess = shininess;
    for (const InstructionSet isa : available_isas())
      EXPECT_NEAR(test::light(s.c.program(), s.points, isa)[2][1],
                  kBase + kAmbient + kSpecular * std::exp2(-63.0 * shininess), 1e-5)
          << shininess;
  }
}

}  // namespace
}  // namespace tessera::test::lighting_special_cases_test
