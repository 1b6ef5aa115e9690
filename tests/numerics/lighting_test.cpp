// Complete sums of lights through the public interface, within one level of 255 of long double
// (lighting_oracle.h).
//
// Why one level: storing rounds by half a level. Everything else is the rounding of terms, each at most about
// 2^-24 times the exponent (light_terms_test.cpp); half a level is 32,900 times 2^-24.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/numerics/bounds.h"
#include "tests/numerics/random_lit_scenes.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::lighting_test {
namespace {

const char* name(Shading s) {
  if (s == Shading::flat) return "flat";
  return s == Shading::gouraud ? "Gouraud" : "Phong";
}

class WholeSums : public testing::TestWithParam<int> {};

TEST_P(WholeSums, AreWithinOneLevel) {
  const auto count = static_cast<std::size_t>(GetParam());
  const int few_lights = count > 10 ? 3 : 8;
  const int frames = (count > 100 ? 1 : few_lights) * (long_tests() ? 50 : 1);
  LightingRng rng{std::mt19937(static_cast<std::uint32_t>(GetParam()))};
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
    Real worst = 0;
    LitPatches scene;
    scene.shading = shading;
    for (int variant = 0; variant < 16; ++variant)
      for (int n = 0; n < frames; ++n) {
        // A quarter of the variants, chosen so that each bit takes both values.
        if (count > 100 && ((variant ^ variant >> 2) + n) % 4 != 0) continue;
        scene.model.local_viewer = (variant & 1) != 0;
        scene.model.specular = (variant & 2) != 0 ? SpecularModel::phong : SpecularModel::blinn;
        scene.model.two_sided = (variant & 4) != 0;
        scene.normalize = (variant & 8) == 0;
        scene.model.ambient = random_color(rng, 0.2, false);
        scene.extent = rng.of({1.0, 0x1p-20, 0x1p20});
        scene.material = random_material(rng);
        scene.back_material = random_material(rng);
        scene.lights.clear();
        for (std::size_t i = 0; i < count; ++i)
          scene.lights.push_back(random_light(rng, count, scene.extent));
        scene.view = scene.world_from_eye = {};
        if (n % 2 != 0 || count > 100) scene.move_camera(rng);
        randomize_patches(rng, scene);
        update_worst(worst, scene.error_in_levels());
      }
    expect_within(std::string("whole sum, ") + name(shading) + ", " + std::to_string(count) +
                      (count == 1 ? " light" : " lights"),
                  worst, 1, "levels of 255");
    EXPECT_GT(scene.unsaturated, std::size_t{LitPatches::kCount}) << "no unsaturated component was measured";
  }
}
INSTANTIATE_TEST_SUITE_P(Lighting, WholeSums, testing::Values(1, 8, 64, 1000));

// Highlights too small for random pixels: each patch faces the highlight within an angle at which it has
// almost faded.
TEST(LightingAccuracy, SharpHighlightsAreWithinOneLevel) {
  LightingRng rng{std::mt19937(11)};
  for (const float shininess : {0.5f, 128.0f, 10000.0f}) {
    Real worst = 0;
    LitPatches scene;
    for (int n = 0; n < 48 * (long_tests() ? 30 : 1); ++n) {
      scene.shading = rng.of({Shading::flat, Shading::gouraud, Shading::phong});
      scene.model.local_viewer = rng.one_in(2);
      scene.model.specular = rng.of({SpecularModel::blinn, SpecularModel::phong});
      scene.material = {.ambient = {0, 0, 0, 1},
                        .diffuse = {0.1f, 0, 0, 1},
                        .specular = {0.25f, 0.5f, 1, 1},
                        .shininess = shininess};
      const auto [x, y, z] = rng.direction();
      scene.lights = {Light{.position = {4 * x, 4 * y, 2 + 2 * std::abs(z), rng.one_in(2) ? 0.0f : 1.0f}}};
      randomize_patches(rng, scene);
      const RealLight light = real_light(scene.lights[0]);
      for (int p = 0; p < LitPatches::kCount; ++p) {
        Patch& patch = scene.patches[static_cast<std::size_t>(p)];
        for (float& at : patch.z) at = -std::abs(at);
        for (int k = 0; k < 4; ++k) {
          const Real3 at = real3(scene.corner(p, k));
          const Real3 l = light.directional ? light.position : normalized(light.position - at);
          const Real3 e = scene.model.local_viewer ? normalized(at * -1) : Real3{0, 0, 1};
          const Real3 peak = normalized(l + e);
          const double off = rng.between(0, 3) / std::sqrt(std::max(shininess, 10.0f));
          const std::array<float, 3> bend = rng.direction();
          for (std::size_t c = 0; c < 3; ++c)
            patch.normals[static_cast<std::size_t>(k)][c] = static_cast<float>(peak[c] + off * bend[c]);
        }
      }
      update_worst(worst, scene.error_in_levels());
    }
    expect_within("highlight of exponent " + std::to_string(shininess).substr(0, 7), worst, 1,
                  "levels of 255");
    EXPECT_GT(scene.unsaturated, std::size_t{20 * LitPatches::kCount});
  }
}

TEST(LightingAccuracy, SharpConesAreWithinOneLevel) {
  LightingRng rng{std::mt19937(12)};
  for (const float exponent : {0.5f, 128.0f, 10000.0f}) {
    Real worst = 0;
    LitPatches scene;
    for (int n = 0; n < 24 * (long_tests() ? 30 : 1); ++n) {
      scene.shading = rng.of({Shading::flat, Shading::gouraud, Shading::phong});
      scene.material = {.ambient = {1, 0.5f, 0, 1}, .diffuse = {0, 0.5f, 1, 1}};
      randomize_patches(rng, scene);
      const auto [x, y, z] = rng.direction();
      // Far enough that the cone fades within the frame.
      const auto distance = static_cast<float>(std::min(std::sqrt(exponent), 30.0f) + 2);
      scene.lights = {Light{.ambient = {1, 1, 1, 1},
                            .position = {distance * x, distance * y, distance * std::abs(z), 1},
                            .spot_direction = {-x, -y, -std::abs(z)},
                            .spot_exponent = exponent,
                            .spot_cutoff = 60}};
      update_worst(worst, scene.error_in_levels());
    }
    expect_within("cone of exponent " + std::to_string(exponent).substr(0, 7), worst, 1, "levels of 255");
    EXPECT_GT(scene.unsaturated, std::size_t{8 * LitPatches::kCount});
  }
}

// Patches in the plane z = 0, facing the viewer; every corner and midpoint is a multiple of 1/16.
void lie_flat(LitPatches& scene) {
  for (Patch& patch : scene.patches)
    patch = {.normals = {{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}}}, .z = {}, .front = true};
}

TEST(LightingAccuracy, LightInTheSurfaceAddsItsAmbientPartOnly) {
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
    for (const float shininess : kExponents)
      for (const bool local : {false, true}) {
        LitPatches scene;
        lie_flat(scene);
        scene.slack = 0;  // L.n is exactly 0
        scene.shading = shading;
        scene.model.local_viewer = local;
        scene.material = {.ambient = {0.25f, 0.5f, 0, 1},
                          .diffuse = {1, 1, 1, 1},
                          .specular = {1, 1, 1, 1},
                          .shininess = shininess};
        // In general position, at a corner, and at the middle of a patch.
        for (const std::array<float, 4>& at :
             {std::array{0.3f, 3.7f, 0.0f, 1.0f}, std::array{0.25f, -0.5f, 0.0f, 1.0f},
              std::array{0.0625f, 0.0625f, 0.0f, 1.0f}, std::array{1.0f, 2.0f, 0.0f, 0.0f}}) {
          scene.lights = {Light{.ambient = {0.5f, 0.5f, 0.5f, 1}, .position = at}};
          EXPECT_LE(scene.error_in_levels(), 0.501L) << name(shading) << ", shininess " << shininess;
        }
      }
}

// At the light's position L is 0: no diffuse light, no highlight, no cone, and only the constant part of the
// attenuation.
TEST(LightingAccuracy, LightAtTheVertexOrTheEyeFollowsTheFormula) {
  LightingRng rng{std::mt19937(13)};
  Real worst = 0;
  for (int n = 0; n < 200 * (long_tests() ? 30 : 1); ++n) {
    LitPatches scene;
    scene.shading = rng.of({Shading::flat, Shading::gouraud, Shading::phong});
    scene.model.local_viewer = rng.one_in(2);
    scene.model.specular = rng.of({SpecularModel::blinn, SpecularModel::phong});
    randomize_patches(rng, scene);
    scene.material = random_material(rng);
    scene.lights = {random_light(rng, 1, 1)};
    // Corner 2 of this patch coincides with the eye if it lies in the plane z = 0.
    const int p = LitPatches::kSide / 2 * (LitPatches::kSide + 1);
    scene.patches[static_cast<std::size_t>(p)].z.fill(rng.one_in(2) ? 0
                                                                    : static_cast<float>(rng.between(-2, 2)));
    std::array<float, 3> at =
        rng.one_in(2) ? std::array<float, 3>{0, 0, 0} : scene.corner(p, rng.of({0, 2, 3}));
    if (rng.one_in(3))  // the middle of the patch, which Phong shading lights
      for (std::size_t c = 0; c < 3; ++c) at[c] = (scene.corner(p, 0)[c] + scene.corner(p, 2)[c]) / 2;
    scene.lights[0].position = {at[0], at[1], at[2], 1};
    update_worst(worst, scene.error_in_levels());
  }
  expect_within("light at the vertex or at the eye", worst, 1, "levels of 255");
}

// 1 / (kc + kl d + kq d^2); 10^6 if the denominator is not positive.
TEST(LightingAccuracy, AttenuationWithoutAPositiveDenominatorIsOneMillion) {
  LitPatches scene;
  lie_flat(scene);
  scene.material = {.ambient = {1, 1, 1, 1}, .diffuse = {1, 1, 1, 1}};
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
    for (const std::array<float, 3>& k :
         {std::array{0.0f, 0.0f, 0.0f}, std::array{-1.0f, 0.0f, 0.0f}, std::array{1.0f, -2.0f, 0.0f},
          std::array{0.0f, 0.0f, -1e30f}, std::array{1.0f, 1.0f, -8.0f}}) {
      scene.shading = shading;
      scene.lights = {Light{.ambient = {1e-7f, 2e-7f, 3e-7f, 1},
                            .diffuse = {3e-7f, 2e-7f, 1e-7f, 1},
                            .position = {0, 0, 2, 1},
                            .attenuation_constant = k[0],
                            .attenuation_linear = k[1],
                            .attenuation_quadratic = k[2]}};
      EXPECT_LE(scene.error_in_levels(), 0.501L)
          << name(shading) << " " << k[0] << " " << k[1] << " " << k[2];
    }
  EXPECT_GT(scene.unsaturated, std::size_t{14 * LitPatches::kCount});
}

// The ambient part of a light shows the extent of its cone: cutoff 0, 0.001 degrees below 90, 90, and 180 (no
// cone).
TEST(LightingAccuracy, ConesEndAtTheirCutoff) {
  LitPatches scene;
  lie_flat(scene);
  scene.material = {.ambient = {1, 1, 1, 1}, .diffuse = {0, 0, 0, 1}};
  const auto lit = [&](float cutoff, float z, Real slack, Shading shading, float spot_z = -1) {
    scene.shading = shading;
    scene.slack = slack;
    // The middle of a patch, or its last corner.
    const float middle = shading == Shading::phong ? 0.0625f : 0.125f;
    scene.lights = {Light{.ambient = {1, 0.5f, 0.25f, 1},
                          .position = {middle, middle, z, 1},
                          .spot_direction = {0, 0, spot_z},
                          .spot_cutoff = cutoff}};
    EXPECT_LE(scene.error_in_levels(), 0.501L) << cutoff << " " << z;
    return std::count_if(scene.levels.begin(), scene.levels.end(),
                         [](const std::array<int, 3>& c) { return c[0] > 0; });
  };
  for (const Shading shading : {Shading::flat, Shading::phong}) {
    EXPECT_EQ(lit(0, 1, 0, shading), 1) << "the patch straight below";
    EXPECT_EQ(lit(0, 0x1p-20f, 0, shading), 1);
    // The height is the tangent of the remaining 0.001 degrees, so the cone has radius 1 in the plane of the
    // patches.
    const auto inside = lit(89.999f, 1.7453e-5f, kCosineSlack, shading);
    EXPECT_TRUE(inside > 100 && inside < 250) << inside;
    EXPECT_EQ(lit(90, 0x1p-20f, 0, shading), LitPatches::kCount);
    EXPECT_EQ(lit(90, 0, 0, shading), 0) << "V.D is 0";
    EXPECT_EQ(lit(90, -0x1p-20f, 0, shading), 0);
    EXPECT_EQ(lit(90, -0x1p-20f, 0, shading, 1), LitPatches::kCount);
    EXPECT_EQ(lit(180, -1, 0, shading), LitPatches::kCount);
    EXPECT_EQ(lit(180, 0, 0, shading), LitPatches::kCount);
  }
}

// Down to angles that float cosines cannot resolve: 1 - 2^-24 is 0.02 degrees. Cones are widened by 2^-22; L
// and D have their own roundings.
TEST(LightingAccuracy, NarrowConesEndAtTheirCutoff) {
  constexpr double kDegree = std::numbers::pi / 180;
  LightingRng rng{std::mt19937(15)};
  LitPatches scene;
  lie_flat(scene);
  scene.material = {.ambient = {1, 1, 1, 1}, .diffuse = {0, 0, 0, 1}};
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
    for (const float cutoff : {0.001f, 0.01f, 0.014f, 0.1f, 0.5f, 0.999f}) {
      const double radius = 0.5;
      const double distance = radius / std::tan(cutoff * kDegree);
      const double slack = 0x1p-21;
      const auto [x, y, z] = rng.direction();
      const double d[3] = {x / 3, y / 3, std::abs(z) + 0.2};
      const double length = std::hypot(d[0], d[1], d[2]);
      Light light{.ambient = {1, 0.5f, 0.25f, 1}, .position = {0, 0, 0, 1}, .spot_cutoff = cutoff};
      for (std::size_t c = 0; c < 3; ++c) {
        light.position[c] = static_cast<float>(distance * d[c] / length);
        light.spot_direction[c] = static_cast<float>(-d[c] / length);
      }
      scene.shading = shading;
      scene.lights = {light};
      scene.slack = static_cast<Real>(std::sin(cutoff * kDegree) * slack + slack * slack / 2);
      EXPECT_LE(scene.error_in_levels(), 0.501L) << cutoff << " " << static_cast<int>(shading);
      const auto lit = std::count_if(scene.levels.begin(), scene.levels.end(),
                                     [](const std::array<int, 3>& c) { return c[0] > 0; });
      EXPECT_TRUE(lit > 40 && lit < 90)
          << lit << " patches lit, expected 40 to 90: a foreshortened circle of area 50";
    }
}

// The normals of two corners nearly cancel out in the middle. Their rounding errors (2^-24 each, and 2 more
// from interpolation) are then relative to the small remainder. If nothing remains there is no diffuse light.
TEST(LightingAccuracy, OppositeNormalsUseTheirRemainder) {
  LightingRng rng{std::mt19937(14)};
  Real worst = 0;
  LitPatches scene;
  scene.shading = Shading::phong;
  scene.slack = 0;
  scene.material = {.ambient = {0.5f, 0, 0, 1}, .diffuse = {0, 1, 0.5f, 1}};
  for (int exponent = -24; exponent <= 0; ++exponent) {
    const Real left = exponent == -24 ? 0 : std::ldexp(1.0L, exponent);  // twice the length of the mean
    for (Patch& patch : scene.patches) {
      const std::array<float, 3> normal = rng.direction();
      const std::array<float, 3> other = rng.direction();
      const Real3 n = real3(normal);
      const Real3 across = normalized(real3(other) - n * dot(real3(other), n));
      patch.normals = {normal, other, {}, other};
      for (std::size_t c = 0; c < 3; ++c) patch.normals[2][c] = static_cast<float>(left * across[c] - n[c]);
    }
    const std::array<float, 3> l = rng.direction();
    scene.lights = {Light{.ambient = {1, 1, 1, 1}, .position = {l[0], l[1], l[2], 0}}};
    const Real error = scene.error_in_levels() - 0.5L;
    if (left == 0) EXPECT_LE(error, 0.001L);
    else update_worst(worst, error / 255 / (3 * 0x1p-24L / (left / 2) + kCosineSlack));
  }
  expect_within("Phong between opposite normals, of 3 * 2^-24 over the length of their mean", worst, 1, "");
}

}  // namespace
}  // namespace tessera::test::lighting_test
