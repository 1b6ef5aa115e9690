// Lights far brighter than 1 show the tails of highlights: bases near 0 times huge factors, in every kernel.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/shading/lighting_expectations.h"

namespace tessera::test::bright_highlights_test {
namespace {

/// Light and eye are in front of a tilted surface such that S.n (or R.E) is `cosine` and no other factor of
/// the highlight is rounded.
struct BrightHighlight {
  LightKind kind = LightKind::point;
  bool local_viewer = false;
  bool phong_highlight = false;
  bool tracks_specular = false;  ///< the brightness is that of vertex colours, not of the light
  float brightness = 1;
  float constant = 1;  ///< constant attenuation

  LightingCase lit(float shininess) const {
    LightingCase c;
    c.material = {{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, {0, 0, 0}, shininess};
    c.model = {{0, 0, 0}, local_viewer, phong_highlight, true};
    c.renormalize = true;
    c.tracked.specular = tracks_specular;
    EyeLight l;
    l.directional = kind == LightKind::directional;
    l.position = {0, 0, l.directional ? 1.0f : 2.0f};
    l.ambient = l.diffuse = {0, 0, 0};
    const float light_brightness = tracks_specular ? 1 : brightness;
    l.specular = {light_brightness, light_brightness, light_brightness};
    l.spot_direction = {0, 0, -1};
    l.spot_cutoff = is_spot(kind) ? 30.0f : 180.0f;
    if (kind == LightKind::attenuated_point || kind == LightKind::attenuated_spot)
      l.attenuation = {constant, constant < 1 ? 0.0f : 0x1p-30f, 0};
    c.lights.push_back(l);
    return c;
  }
  double factor() const { return static_cast<double>(brightness) / constant; }
  std::vector<LightingPoint> points(double cosine) const {
    // R.E is the cosine of twice the angle.
    const double z = phong_highlight ? std::sqrt((1 + cosine) / 2) : cosine;
    const LightingPoint p{{static_cast<float>(std::sqrt(1 - z * z)), 0, static_cast<float>(z)},
                          {0, 0, -2},
                          {brightness, brightness, brightness}};
    return std::vector<LightingPoint>(16, p);
  }
};

std::vector<BrightHighlight> all_highlights() {
  std::vector<BrightHighlight> all;
  for (int kind = 0; kind < kLightKinds; ++kind)
    for (const bool local : {false, true})
      for (const bool phong : {false, true})
        for (const bool tracks_specular : {false, true})
          for (const float brightness : {1.0f, 2e9f, 3e20f, 1.9e28f})
            for (const float constant : {1.0f, 0x1p-30f})
              all.push_back(
                  {static_cast<LightKind>(kind), local, phong, tracks_specular, brightness, constant});
  return all;
}

constexpr float kExponents[] = {0.6f, 1, 1.5f, 2, 10, 60, 1000, 5000};
constexpr double kShares[] = {0.1, 0.4, 0.8};  // visible values to compare

TEST(BrightHighlights, ShowTheirTails) {
  std::size_t compared = 0, squared = 0, sharp = 0;
  for (const BrightHighlight& bright : all_highlights()) {
    const bool is_attenuated =
        bright.kind == LightKind::attenuated_point || bright.kind == LightKind::attenuated_spot;
    if ((bright.constant < 1 && !is_attenuated) || bright.factor() > 0x1p94) continue;
    for (const float exponent : kExponents)
      for (const double share : kShares) {
        const double cosine = std::pow(share / bright.factor(), 1 / double{exponent});
        if (cosine < (bright.phong_highlight ? 0.01 : 1e-36)) continue;  // smaller than any float
        const LightingProgram program = bright.lit(exponent).program();
        squared += program.terms[0].squared;
        sharp += program.terms[0].sharp;
        for (const InstructionSet isa : available_isas()) {
          const double found = light(program, bright.points(cosine), isa)[7][1];
          ASSERT_NEAR(found, share, 4e-6 * exponent + 1e-5)
              << name_of(isa) << ", kind " << static_cast<int>(bright.kind) << ", exponent " << exponent
              << ", brightness " << bright.brightness << " over " << bright.constant
              << (bright.local_viewer ? ", local viewer" : "") << (bright.phong_highlight ? ", R.E" : "")
              << (bright.tracks_specular ? ", vertex colours" : "");
        }
        ++compared;
      }
  }
  EXPECT_TRUE(compared > 1500 && squared > 300 && sharp > 150) << compared << " " << squared << " " << sharp;
}

// Highlights that no factor above 1 amplifies are evaluated only where they are visible.
TEST(BrightHighlights, AreElidedWhereInvisible) {
  BrightHighlight bright{.kind = LightKind::attenuated_point};
  const auto floor_of = [&](float constant) {
    bright.constant = constant;
    return bright.lit(64).program().terms[0].highlight_floor;  // for the square: 2^(-bits / 32)
  };
  EXPECT_EQ(floor_of(2), std::exp2(-32.0f / 32));
  EXPECT_EQ(floor_of(1), std::exp2(-32.0f / 32));
  EXPECT_NEAR(floor_of(0.75f), std::exp2(-33.0f / 32), 1e-7);
  EXPECT_NEAR(floor_of(0x1p-10f), std::exp2(-43.0f / 32), 1e-7);
  EXPECT_NEAR(floor_of(0), std::exp2(-126.0f / 32), 1e-7) << "attenuation by distance alone is unbounded";
}

TEST(BrightHighlights, IndexHighlightsShowTheirTails) {
  for (const BrightHighlight& bright : all_highlights())
    for (const float exponent : kExponents)
      for (const double share : kShares) {
        const double cosine = std::pow(share / bright.brightness, 1 / double{exponent});
        if (bright.constant < 1 || bright.tracks_specular) continue;
        if (cosine < (bright.phong_highlight ? 0.01 : 1e-36)) continue;  // smaller than any float
        const LightingCase c = bright.lit(exponent);
        LightingProgram program =
            plan_index_lighting({{0, 0, 1000}, exponent, 4096}, c.lights, c.model, nullptr);
        program.renormalize = true;
        const double found = light(program, bright.points(cosine), available_isas().front())[7][0];
        ASSERT_NEAR(found, 1000 * share, 1 + 4e-3 * exponent)
            << static_cast<int>(bright.kind) << " " << exponent << " " << bright.brightness;
      }
}

}  // namespace
}  // namespace tessera::test::bright_highlights_test
