// Lighting in colour-index mode; small cases are computed by hand.
#include <array>

#include "tests/engine/frame/index_pictures.h"

namespace tessera::index_lighting_test {
namespace {

using namespace test;

// L = S = (0, 0, 1), n = (0.6, 0, 0.8): d is 0.8 and s is 0.64, each times a luminance.
TEST(IndexLighting, MatchesTheFormula) {
  const MeshData mesh = with_normals(0.6f, 0, 0.8f);
  const auto light = [](Color diffuse, Color specular) {
    return Light{.ambient = {9, 9, 9, 1}, .diffuse = diffuse, .specular = specular};
  };
  const Color black{0, 0, 0, 1};
  const Color white{1, 1, 1, 1};
  struct Case {
    std::array<float, 3> indexes;
    std::vector<Light> lights;
    std::uint32_t word;
  };
  const Case cases[] = {
      {{10, 30, 50}, {Light{}}, 41},                               // 10 + 0.8 0.36 20 + 0.64 40 = 41.36
      {{10, 30, 50}, {light({0.5f, 0, 0, 1}, {0, 1, 0, 1})}, 27},  // d 0.12, s 0.3776: 26.6
      {{10, 30, 50}, {light({0, 0, 0.5f, 1}, {0, 0, 1, 1})}, 14},  // d 0.044, s 0.0704: 13.6
      {{10, 30, 50}, {light(white, {2, 2, 2, 1})}, 50},  // s 1.28: 56.7, clamped to the specular index
      {{10, 30, 60}, {light({2, 2, 2, 1}, black), light(white, black)}, 58},  // d 2.4 is not clamped
      {{10, 30, 60}, {light(white, black), light({-1.5f, -1.5f, -1.5f, 1}, black)}, 2},  // d -0.4
      {{10, 30, 60}, {light({-1, -1, -1, 1}, black)}, 58},                               // d -0.8: -6, masked
      {{60, 100, 100}, {light(white, black)}, 28},                                       // 92, masked
      {{7, 30, 60}, {light(black, black)}, 7},
      {{70, 30, 90}, {}, 6},
      {{20, 20, 50}, {Light{}}, 39},  // d has no effect: 20 + 0.64 30
      {{30, 10, 30}, {Light{}}, 24},  // 30 - 0.8 0.36 20 = 24.24
      {{20, 20, 20}, {Light{}}, 20},
  };
  for (const auto& c : cases) {
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
      DrawState state;
      state.shading = shading;
      state.material = index_material(c.indexes[0], c.indexes[1], c.indexes[2], 2);
      state.material.emission = state.material.ambient = {1, 1, 1, 1};
      SCOPED_TRACE(c.word);
      expect_everywhere(c.word, mesh, state, kIndexFormat, c.lights);
    }
  }
}

TEST(IndexLighting, MeshesWithoutNormalsUseFaceNormals) {
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
    DrawState state;
    state.shading = shading;
    state.material = index_material(3, 33, 33, 0);
    Light light;
    light.position = {0, 0.6f, 0.8f, 0};
    light.specular = {0, 0, 0, 1};
    expect_everywhere(27, large_triangle(0, 0, 0), state, kIndexFormat, {light});  // 3 + 0.8 30
  }
}

TEST(IndexLighting, UsesTheMaterialOfEachFace) {
  const MeshData mesh = two_faces();
  Material white;
  white.ambient = white.diffuse = {0, 0, 0, 1};
  white.emission = {1, 1, 1, 1};
  const Material first = index_material(20, 40, 40, 0);
  const Material second = index_material(0, 33, 33, 0);
  struct Case {
    Material front;
    Material back;
    std::uint32_t left, right;
  };
  const Case cases[] = {
      {first, white, 40, 15}, {white, first, 15, 40}, {first, second, 40, 33}, {white, white, 15, 15}};
  Light matt;
  matt.specular = {0, 0, 0, 1};
  for (const Case& c : cases) {
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
      DrawState plain;
      plain.material = c.front;
      plain.back_material = c.back;
      plain.shading = shading;
      for (const DrawState& state : every_pixel_path(plain)) {
        const PackedColors words = drawn(kIndexFormat, [&](Frame& frame) {
          frame.set_light_model({.two_sided = true});
          frame.set_lights({matt});
          frame.draw(mesh.view(), state);
        });
        for (std::size_t i = 0; i < words.size(); ++i)
          ASSERT_EQ(words[i], i % 64 < 32 ? c.left : c.right)
              << "pixel " << i << ", shading " << static_cast<int>(shading);
      }
    }
  }
}

TEST(IndexLighting, ConstantFacesUseTheirMaterials) {
  const MeshData mesh = two_faces();
  DrawState state;
  state.material = index_material(20, 40, 40, 0);
  state.back_material = index_material(21, 40, 40, 0);
  const PackedColors words = drawn(kIndexFormat, [&](Frame& frame) {
    frame.set_light_model({.two_sided = true});
    frame.set_lights({});
    frame.draw(mesh.view(), state);
  });
  for (std::size_t i = 0; i < words.size(); ++i) ASSERT_EQ(words[i], i % 64 < 32 ? 20u : 21u);
}

}  // namespace
}  // namespace tessera::index_lighting_test
