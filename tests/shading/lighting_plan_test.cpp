// Terms that plan_lighting() elides, and terms that it must keep.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "shading/lighting.h"

namespace tessera::test::lighting_plan_test {
using namespace detail;
namespace {

constexpr Rgb kBlack{0, 0, 0};

struct Scene {
  SurfaceMaterial material{
      {0.1f, 0.2f, 0.3f}, {0.4f, 0.5f, 0.6f}, {0.7f, 0.8f, 0.9f}, {0.01f, 0.02f, 0.03f}, 20};
  TrackedColors tracked;
  EyeLight light;
  LightingModel model;
  Scene() {
    light.ambient = {0.5f, 0.5f, 0.5f};
    light.directional = false;
    light.position = {1, 2, 3};
    light.spot_cutoff = 30;
    light.spot_exponent = 2;
    light.attenuation = {1, 2, 3};
  }
  LightingProgram plan(std::vector<EffectNote>* notes = nullptr) const {
    return plan_lighting(material, tracked, {light}, model, notes);
  }
};

/// A change of the scene, and the program that it yields.
struct Row {
  const char* name;
  std::function<void(Scene&)> change;
  int terms;
  LightKind kind = LightKind::attenuated_spot;
  HighlightKind highlight = HighlightKind::blinn_infinite;
  bool has_ambient_or_tracked = true;
  bool needs_position = true;
  bool needs_view = false;
};

std::vector<Row> changed_scenes() {
  const auto directional = [](Scene& s) {
    s.light.directional = true;
    s.light.spot_cutoff = 180;
  };
  return {
      {"everything", [](Scene&) {}, 1},
      {"cutoff 180 is no cone", [](Scene& s) { s.light.spot_cutoff = 180; }, 1, LightKind::attenuated_point},
      {"attenuation 1 0 0 is none",
       [](Scene& s) {
         s.light.attenuation = {1, 0, 0};
       },
       1, LightKind::spot},
      {"attenuation 2 0 0 is one",
       [](Scene& s) {
         s.light.attenuation = {2, 0, 0};
       },
       1},
      {"attenuation 0 0 0 is one",
       [](Scene& s) {
         s.light.attenuation = {0, 0, 0};
       },
       1},
      {"attenuation 1 0 q is one",
       [](Scene& s) {
         s.light.attenuation = {1, 0, 1};
       },
       1},
      {"neither cone nor attenuation",
       [](Scene& s) {
         s.light.spot_cutoff = 180;
         s.light.attenuation = {1, 0, 0};
       },
       1, LightKind::point},
      {"a point without exponent still has its cone", [](Scene& s) { s.light.spot_exponent = 0; }, 1},
      {"cutoff 90 is a cone", [](Scene& s) { s.light.spot_cutoff = 90; }, 1},
      {"directional", directional, 1, LightKind::directional, HighlightKind::blinn_infinite, false, false},
      {"directional, attenuation is unused",
       [directional](Scene& s) {
         directional(s);
         s.light.attenuation = {5, 5, 5};
       },
       1, LightKind::directional, HighlightKind::blinn_infinite, false, false},
      {"specular material black", [](Scene& s) { s.material.specular = kBlack; }, 1,
       LightKind::attenuated_spot, HighlightKind::none},
      {"specular light black", [](Scene& s) { s.light.specular = kBlack; }, 1, LightKind::attenuated_spot,
       HighlightKind::none},
      {"specular product black",
       [](Scene& s) {
         s.material.specular = {1, 0, 0};
         s.light.specular = {0, 1, 1};
       },
       1, LightKind::attenuated_spot, HighlightKind::none},
      {"ambient material black", [](Scene& s) { s.material.ambient = kBlack; }, 1, LightKind::attenuated_spot,
       HighlightKind::blinn_infinite, false},
      {"ambient light black", [](Scene& s) { s.light.ambient = kBlack; }, 1, LightKind::attenuated_spot,
       HighlightKind::blinn_infinite, false},
      {"negative light is not black",
       [](Scene& s) {
         s.light.ambient = s.light.specular = kBlack;
         s.light.diffuse = {-1, 0, 0};
       },
       1, LightKind::attenuated_spot, HighlightKind::none, false},
      {"diffuse black, highlight alone", [](Scene& s) { s.material.diffuse = kBlack; }, 1},
      {"ambient alone", [](Scene& s) { s.material.diffuse = s.material.specular = kBlack; }, 1,
       LightKind::attenuated_spot, HighlightKind::none},
      {"black light", [](Scene& s) { s.light.ambient = s.light.diffuse = s.light.specular = kBlack; }, 0},
      {"black material",
       [](Scene& s) { s.material.ambient = s.material.diffuse = s.material.specular = kBlack; }, 0},
      {"directional, ambient alone",
       [directional](Scene& s) {
         directional(s);
         s.light.diffuse = s.light.specular = kBlack;
       },
       0},
      {"directional, turned out of its cone",
       [directional](Scene& s) {
         directional(s);
         s.light.position = {0, 0, 1};
         s.light.spot_direction = {0, 0, 1};
         s.light.spot_cutoff = 60;
       },
       0},
      {"directional, in its cone",
       [directional](Scene& s) {
         directional(s);
         s.light.position = {0, 0, 1};
         s.light.spot_cutoff = 60;
       },
       1, LightKind::directional, HighlightKind::blinn_infinite, false, false},
      {"local viewer", [](Scene& s) { s.model.local_viewer = true; }, 1, LightKind::attenuated_spot,
       HighlightKind::blinn_local, true, true, true},
      {"local viewer without highlight",
       [](Scene& s) {
         s.model.local_viewer = true;
         s.material.specular = kBlack;
       },
       1, LightKind::attenuated_spot, HighlightKind::none},
      {"directional, local viewer without highlight",
       [directional](Scene& s) {
         directional(s);
         s.model.local_viewer = true;
         s.material.specular = kBlack;
       },
       1, LightKind::directional, HighlightKind::none, false, false},
      {"directional, local viewer",
       [directional](Scene& s) {
         directional(s);
         s.model.local_viewer = true;
       },
       1, LightKind::directional, HighlightKind::blinn_local, false, true, true},
      {"Phong highlight", [](Scene& s) { s.model.phong_highlight = true; }, 1, LightKind::attenuated_spot,
       HighlightKind::phong_infinite},
      {"Phong highlight, local viewer",
       [](Scene& s) { s.model.phong_highlight = s.model.local_viewer = true; }, 1, LightKind::attenuated_spot,
       HighlightKind::phong_local, true, true, true},
      {"vertex colours as diffuse",
       [](Scene& s) {
         s.tracked.diffuse = true;
         s.light.ambient = kBlack;
       },
       1},
      {"vertex colours as diffuse of a light without",
       [](Scene& s) {
         s.tracked.diffuse = true;
         s.light.ambient = s.light.diffuse = kBlack;
       },
       1, LightKind::attenuated_spot, HighlightKind::blinn_infinite, false},
      {"vertex colours as emission",
       [](Scene& s) {
         s.tracked.emission = true;
         s.light.ambient = kBlack;
       },
       1, LightKind::attenuated_spot, HighlightKind::blinn_infinite, false},
      {"vertex colours as specular, material black",
       [](Scene& s) {
         s.tracked.specular = true;
         s.material.specular = kBlack;
       },
       1},
  };
}

TEST(Effects, ElideTermsWithoutInfluence) {
  for (const Row& row : changed_scenes()) {
    Scene scene;
    row.change(scene);
    std::vector<EffectNote> notes;
    const LightingProgram program = scene.plan(&notes);
    SCOPED_TRACE(row.name);
    EXPECT_FALSE(notes.empty());
    ASSERT_EQ(program.terms.size(), static_cast<std::size_t>(row.terms));
    if (row.terms == 0) {
      EXPECT_FALSE(program.needs_normal || program.needs_position || program.needs_view);
      continue;
    }
    EXPECT_EQ(program.terms[0].kind, row.kind);
    EXPECT_EQ(program.terms[0].highlight, row.highlight);
    const bool has_ambient_or_tracked = std::any_of(notes.begin(), notes.end(), [](const EffectNote& note) {
      return note.effect == Effect::light_ambient || note.effect == Effect::light_tracked_colors;
    });
    EXPECT_EQ(has_ambient_or_tracked, row.has_ambient_or_tracked);
    EXPECT_TRUE(program.needs_normal);
    EXPECT_EQ(program.needs_position, row.needs_position);
    EXPECT_EQ(program.needs_view, row.needs_view);
  }
}

TEST(Effects, FoldConstants) {
  Scene s;
  s.light.directional = true;
  s.light.spot_cutoff = 180;
  const LightingProgram program = s.plan();
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(program.base[k], s.material.emission[k] + (0.2f + 0.5f) * s.material.ambient[k], 1e-7);
    EXPECT_EQ(program.terms[0].ambient[k], 0);
    EXPECT_EQ(program.terms[0].diffuse[k], s.light.diffuse[k] * s.material.diffuse[k]);
    EXPECT_EQ(program.terms[0].specular[k], s.light.specular[k] * s.material.specular[k]);
  }
  // The cone of a directional light is one factor for all points: V = -L, V.D = 0.8, exponent 2.
  s.light.position = {0, 0.6f, 0.8f};
  s.light.spot_cutoff = 60;
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(s.plan().terms[0].diffuse[k], 0.64 * s.light.diffuse[k] * s.material.diffuse[k], 1e-6);
}

// The result must not depend on how directions round to float.
TEST(Effects, DirectionalLightsShineInVeryNarrowCones) {
  std::mt19937 random(61);
  std::uniform_real_distribution<double> any(-1, 1);
  Scene s;
  s.light.directional = true;
  for (int n = 0; n < 300; ++n) {
    const double to[3] = {any(random), any(random), any(random)};
    const double length = std::hypot(to[0], to[1], to[2]);
    const double aside[3] = {to[1], -to[0], 0};
    const double aside_length = std::hypot(aside[0], aside[1]);
    // Angle between the light's direction and its cone's axis.
    for (const double degrees : {0.0, 1e-4, 0.0099, 0.0101, 0.02}) {
      const double angle = degrees * 3.141592653589793 / 180;
      for (std::size_t k = 0; k < 3; ++k) {
        s.light.position[k] = static_cast<float>(to[k] / length);
        s.light.spot_direction[k] = static_cast<float>(
            -(std::cos(angle) * to[k] / length + std::sin(angle) * aside[k] / aside_length));
      }
      s.light.spot_cutoff = 0.01f;
      EXPECT_EQ(s.plan().terms.size(), degrees < 0.01 ? 1u : 0u) << n << " " << degrees;
      // The same direction, rounded differently.
      for (float& component : s.light.position)
        component = std::nextafter(component, n % 2 == 0 ? 2.0f : 0.0f);
      s.light.spot_cutoff = 0;
      EXPECT_EQ(s.plan().terms.size(), degrees == 0 ? 1u : 0u) << n << " " << degrees;
    }
  }
}

// The engine's directions are float unit vectors. These lie exactly on the edge of their cone before
// rounding, and must stay lit.
TEST(Effects, DirectionalLightsShineAtTheEdgesOfTheirCones) {
  Scene s;
  s.light.directional = true;
  int edges = 0;
  const auto set_unit = [](std::array<float, 3>& to, int x, int y, int z, int sign) {
    const double length = std::sqrt(double{1} * (x * x + y * y + z * z));
    to = {static_cast<float>(sign * x / length), static_cast<float>(sign * y / length),
          static_cast<float>(sign * z / length)};
  };
  for (int n = 0; n < 5 * 5 * 5 * 5; ++n) {
    const int x = n % 5 + 1, y = n / 5 % 5;
    const int u = n / 25 % 5 + 1, v = n / 125 % 5;
    const int dot = x * u + y * v;
    const int squares = (x * x + y * y) * (u * u + v * v);
    set_unit(s.light.position, x, y, 0, 1);
    set_unit(s.light.spot_direction, u, v, 0, -1);
    if (dot * dot * 2 != squares) continue;  // the angle is not 45 degrees
    ++edges;
    s.light.spot_cutoff = 45;
    EXPECT_EQ(s.plan().terms.size(), 1u) << x << " " << y << ", " << u << " " << v;
    s.light.spot_cutoff = 44.9999f;
    EXPECT_EQ(s.plan().terms.size(), 0u) << x << " " << y << ", " << u << " " << v;
  }
  EXPECT_GT(edges, 30);
}

TEST(Effects, TrackedColorsReplaceTheMaterialColors) {
  Scene s;
  s.tracked = {true, true, true, true};
  const LightingProgram all = s.plan();
  EXPECT_TRUE(all.tracked);
  EXPECT_EQ(all.base, kBlack);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(all.tracked_base[k], 1 + 0.2, 1e-6);
  EXPECT_EQ(all.terms[0].tracked_diffuse, s.light.diffuse);
  EXPECT_EQ(all.terms[0].diffuse, kBlack);
  s.tracked = {};
  const LightingProgram none = s.plan();
  EXPECT_FALSE(none.tracked);
  EXPECT_EQ(none.tracked_base, kBlack);
  EXPECT_EQ(none.terms[0].tracked_diffuse, kBlack);
}

// Unlit points add 0 times the product: an infinity would become NaN.
TEST(Effects, OverflowingProductsAreTheLargestFloat) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  Scene s;
  s.material.diffuse = s.material.specular = {1e30f, -1e30f, 0.5f};
  s.light.diffuse = s.light.specular = {1e30f, 1e30f, 0.5f};
  const LightingProgram program = s.plan();
  ASSERT_EQ(program.terms.size(), 1u);
  EXPECT_EQ(program.terms[0].diffuse, (Rgb{kLargest, -kLargest, 0.25f}));
  EXPECT_EQ(program.terms[0].specular, (Rgb{kLargest, -kLargest, 0.25f}));
}

TEST(Effects, NoLightsMakeAConstant) {
  const Scene s;
  const LightingProgram program = plan_lighting(s.material, {}, {}, s.model, nullptr);
  EXPECT_TRUE(program.terms.empty());
  EXPECT_FALSE(program.needs_normal || program.needs_position || program.needs_view || program.tracked);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(program.base[k], s.material.emission[k] + 0.2f * s.material.ambient[k], 1e-7);
}

}  // namespace
}  // namespace tessera::test::lighting_plan_test
