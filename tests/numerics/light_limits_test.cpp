// Lights, scenes and normals of any size: lights at the limits of float, scenes from 2^-60 to 2^60, normals
// of any length. Lit colours are within 0..1 for any kernel input.
#include <gtest/gtest.h>

#include <bit>
#include <vector>

#include "shading/lighting.h"
#include "shading/lighting_reference.h"
#include "tests/numerics/bounds.h"
#include "tests/numerics/random_lit_scenes.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::light_limits_test {
using namespace detail;
namespace {

// Very distant lights match directional lights, scaled by attenuation. xyz / w is computed in double.
TEST(LightLimits, DistantLightsMatchDirectionalLights) {
  LightingRng rng{std::mt19937(31)};
  Real worst = 0;
  LitPatches scene;
  for (int n = 0; n < 200 * (long_tests() ? 30 : 1); ++n) {
    scene.shading = rng.of({Shading::flat, Shading::gouraud, Shading::phong});
    scene.model = {.ambient = {0, 0, 0, 1},
                   .local_viewer = rng.one_in(2),
                   .specular = rng.of({SpecularModel::blinn, SpecularModel::phong})};
    scene.material = random_material(rng);
    randomize_patches(rng, scene);
    scene.lights = {random_light(rng, 1, 1)};
    Light& light = scene.lights[0];
    const auto [x, y, z] = rng.direction();
    const auto size = static_cast<float>(std::pow(10, rng.between(-2, 38)));
    const auto w = static_cast<float>(rng.of({1, -1}) * std::pow(10, rng.between(-38, 2)));
    light.position = {x * size, y * size, z * size, w};
    const double distance = static_cast<double>(size) / static_cast<double>(std::abs(w));
    const auto spread = [&](double k) { return static_cast<float>(k > 1e-38 && k < 1e38 ? k : 0); };
    light.attenuation_constant = 1;
    light.attenuation_linear = rng.one_in(3) ? spread(1 / distance) : 0;
    light.attenuation_quadratic = rng.one_in(3) ? spread(1 / (distance * distance)) : 0;
    const Real sign = w < 0 ? 1 : -1;
    for (std::size_t c = 0; c < 3; ++c)
      light.spot_direction[c] = static_cast<float>(sign * std::array{x, y, z}[c]);
    if (light.spot_cutoff < 10 || light.spot_cutoff > 80) light.spot_cutoff = 180;
    if (light.spot_cutoff == 180 && rng.one_in(3)) light.spot_cutoff = 90;
    light.spot_exponent = std::min(light.spot_exponent, 20.0f);
    update_worst(worst, scene.error_in_levels());
  }
  expect_within("lights from 10^-4 to 10^76 away", worst, 1, "levels of 255");
  EXPECT_GT(scene.unsaturated, std::size_t{40 * LitPatches::kCount});
}

TEST(LightLimits, ScenesOfAnySize) {
  LightingRng rng{std::mt19937(32)};
  Real worst = 0;
  LitPatches scene;
  for (int exponent = -60; exponent <= 53; ++exponent)  // Lights are up to 2^7 times as far away.
    for (int n = 0; n < 2 * (long_tests() ? 30 : 1); ++n) {
      scene.extent = std::ldexp(1.0, exponent);
      scene.shading = rng.of({Shading::flat, Shading::gouraud, Shading::phong});
      scene.model = {.ambient = {0, 0, 0, 1},
                     .local_viewer = rng.one_in(2),
                     .specular = rng.of({SpecularModel::blinn, SpecularModel::phong})};
      scene.material = random_material(rng);
      randomize_patches(rng, scene);
      scene.lights = {random_light(rng, 2, scene.extent), random_light(rng, 2, scene.extent)};
      update_worst(worst, scene.error_in_levels());
    }
  expect_within("scenes from 2^-60 to 2^60", worst, 1, "levels of 255");
}

// If normals are normalized at the vertices, any length works; so it does if Phong shading renormalizes them,
// provided that all normals of a mesh have similar lengths.
TEST(LightLimits, NormalsOfAnyLength) {
  LightingRng rng{std::mt19937(33)};
  Real worst = 0;
  LitPatches scene;
  for (int exponent = -120; exponent <= 126; ++exponent)
    for (const bool normalize : {true, false}) {
      scene.normalize = true;
      randomize_patches(rng, scene);
      for (Patch& patch : scene.patches)
        for (std::array<float, 3>& n : patch.normals) {
          const Real3 unit = normalized(real3(n));
          for (std::size_t c = 0; c < 3; ++c) n[c] = static_cast<float>(std::ldexp(unit[c], exponent));
        }
      scene.normalize = normalize;
      scene.shading = normalize ? rng.of({Shading::flat, Shading::gouraud, Shading::phong}) : Shading::phong;
      scene.material = random_material(rng);
      scene.material.shininess = std::min(scene.material.shininess, 128.0f);
      scene.lights = {random_light(rng, 2, 1), random_light(rng, 2, 1)};
      update_worst(worst, scene.error_in_levels());
    }
  expect_within("normals from 2^-120 to 2^126", worst, 1, "levels of 255");
}

// Flat and Gouraud shading use unnormalized normals as given. A zero normal receives neither diffuse light
// nor highlights.
TEST(LightLimits, UnnormalizedNormalsAreUsedAsGiven) {
  LitPatches scene;
  scene.material = {
      .ambient = {0.25f, 0, 0, 1}, .diffuse = {1, 1, 0, 1}, .specular = {0, 0, 0.5f, 1}, .shininess = 2};
  scene.lights = {Light{.ambient = {1, 1, 1, 1}, .diffuse = {0.5f, 0.5f, 0.5f, 1}}};
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
    for (const float size : {0.0f, 1e-45f, 1e-30f, 0.1f, 0.5f, 1.0f, 1e30f, 3e38f}) {
      scene.normalize = size == 0 && shading != Shading::flat;
      if (shading == Shading::phong && size != 0) continue;
      for (Patch& patch : scene.patches)
        patch = {
            .normals = {{{0, 0, size}, {0, 0, size}, {0, 0, size}, {0, 0, size}}}, .z = {}, .front = true};
      scene.shading = shading;
      EXPECT_LE(scene.error_in_levels(), 0.501L) << size;
    }
}

// Points have arbitrary bits; lights and materials have any values that draws accept. Results equal those of
// the scalar twin.
TEST(LightLimits, AnyInputIsLitWithinZeroAndOne) {
  LightingRng rng{std::mt19937(34)};
  const auto any = [&](bool finite) {
    for (;;) {
      const float odd[] = {0, -0.0f, 1, -1, 1e-45f, 0x1p-126f, 3.4028235e38f, -3.4028235e38f, 1e19f, -1e-23f};
      const float f =
          rng.one_in(3) ? rng.of(odd) : std::bit_cast<float>(static_cast<std::uint32_t>(rng.random()));
      if (!finite || std::isfinite(f)) return f;
    }
  };
  const auto fill = [&](std::array<float, 3>& v, bool finite) {
    for (float& f : v) f = any(finite);
  };
  std::size_t between = 0;
  for (int n = 0; n < 20000 * (long_tests() ? 100 : 1); ++n) {
    SurfaceMaterial material{.shininess = rng.of({0.0f, 0.01f, 0.5f, 128.0f, 16384.0f})};
    for (Rgb* c : {&material.ambient, &material.diffuse, &material.specular, &material.emission})
      rng.one_in(2) ? fill(*c, true) : c->fill(static_cast<float>(rng.unit()));
    std::vector<EyeLight> lights(1 + rng.random() % 3);
    for (EyeLight& l : lights) {
      for (std::array<float, 3>* v : {&l.ambient, &l.diffuse, &l.specular, &l.attenuation})
        rng.one_in(2) ? fill(*v, true) : v->fill(static_cast<float>(rng.unit()));
      l.directional = rng.one_in(3);
      l.position = l.spot_direction = rng.direction();
      if (!l.directional) fill(l.position, true);
      l.spot_cutoff = rng.of({0.0f, 45.0f, 90.0f, 180.0f});
      l.spot_exponent = rng.of({0.0f, 0.5f, 1.0f, 2.0f, 64.0f, 128.0f, 16384.0f});
    }
    const bool renormalize = rng.one_in(2);
    LightingProgram program =
        plan_lighting(material, {.ambient = rng.one_in(4), .diffuse = rng.one_in(4)}, lights,
                      {.local_viewer = rng.one_in(2),
                       .phong_highlight = rng.one_in(2),
                       .unit_normals = renormalize && rng.one_in(2)},
                      nullptr);
    program.renormalize = renormalize;
    program.negate_normal = rng.one_in(2);
    ShadingBatch batch{};
    for (auto& field : batch.field)
      for (int i = 0; i < 16; ++i) field[i] = any(rng.one_in(2));
    PointReference given[16];
    for (int i = 0; i < 16; ++i)
      for (int c = 0; c < 3; ++c) {
        const auto k = static_cast<std::size_t>(c);
        given[i].normal[k] = batch.field[kNormalX + c][i];
        given[i].position[k] = batch.field[kPositionX + c][i];
        given[i].vertex[k] = batch.field[kVertexR + c][i];
      }
    light_points(rng.one_in(4) ? available_isas().back() : available_isas().front())(program, batch, 16);
    for (const int field : {kColorR, kColorG, kColorB})
      for (int i = 0; i < 16; ++i) {
        const float c = batch.field[field][i];
        ASSERT_TRUE(c >= 0 && c <= 1) << c;
        ASSERT_EQ(std::bit_cast<std::uint32_t>(c),
                  std::bit_cast<std::uint32_t>(
                      light_point_reference(program, given[i])[static_cast<std::size_t>(field - kColorR)]));
        between += c > 0 && c < 1;
      }
  }
  EXPECT_GT(between, std::size_t{10000});
}

}  // namespace
}  // namespace tessera::test::light_limits_test
