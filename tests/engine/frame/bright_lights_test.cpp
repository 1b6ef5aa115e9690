// Lights far brighter than 1 make the edges of their highlights visible, where the power alone is close to 0.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/engine/frame/api_support.h"

namespace tessera::test::bright_lights_test {
namespace {

struct Bright {
  const char* name;
  float brightness;      // colour of the light or the vertices
  double attenuation;    // constant attenuation of the light
  bool colors_vertices;  // the specular colour comes from the vertices
};

// Minimum and maximum red of a triangle. The light and the viewer lie in the same direction, so the half
// vector, too, has this cosine with the normals.
std::pair<double, double> red_of(const Bright& light_and_colors, float cosine, float shininess,
                                 Shading shading) {
  MeshData mesh;
  mesh.positions = {-1, -1, 0, 3, -1, 0, -1, 3, 0};
  for (int vertex = 0; vertex < 3; ++vertex) {
    mesh.normals.insert(mesh.normals.end(), {std::sqrt(1 - cosine * cosine), 0, cosine});
    if (light_and_colors.colors_vertices)
      mesh.colors.insert(mesh.colors.end(), {light_and_colors.brightness, 0, 0, 1});
  }
  Light light;
  light.ambient = light.diffuse = {0, 0, 0, 1};
  light.specular = {light_and_colors.colors_vertices ? 1.0f : light_and_colors.brightness, 0, 0, 1};
  light.position = {0, 0, 1, 0};
  if (light_and_colors.attenuation != 1) {
    light.position = {0, 0, 1e6f, 1};
    light.attenuation_constant = static_cast<float>(light_and_colors.attenuation);
  }
  DrawState state{.shading = shading};
  state.material.ambient = state.material.diffuse = state.material.emission = {0, 0, 0, 1};
  state.material.specular = {1, 1, 1, 1};
  state.material.shininess = shininess;
  if (light_and_colors.colors_vertices) state.color_material = ColorMaterial::specular;
  FrameBuffer buffer({.width = 16, .height = 16});
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  frame.set_lights({light});
  frame.set_light_model({.ambient = {0, 0, 0, 1}});
  frame.draw(mesh.view(), state);
  Renderer({.threads = 1}).finish(frame);
  const std::vector<std::uint32_t> words = packed_colors(buffer);
  const auto [min_red, max_red] = std::minmax_element(words.begin(), words.end());
  return {*min_red >> 16, *max_red >> 16};
}

TEST(BrightLights, ShowTheEdgesOfTheirHighlights) {
  for (const Bright& bright :
       {Bright{"light", 2e9f, 1, false}, Bright{"brighter", 3e20f, 1, false},
        Bright{"attenuation", 1, 5e-10, false}, Bright{"vertex colours", 2e9f, 1, true}})
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
      for (const float shininess : {10.0f, 60.0f})
        for (const double share : {0.1, 0.4, 0.8}) {  // expected red, as a fraction of the maximum
          const double factor = bright.brightness / bright.attenuation;
          const auto cosine = static_cast<float>(std::pow(share / factor, 1 / double{shininess}));
          const double expected = 255 * factor * std::pow(double{cosine}, double{shininess});
          const auto [min_red, max_red] = red_of(bright, cosine, shininess, shading);
          EXPECT_NEAR(min_red, expected, 1)
              << bright.name << ", exponent " << shininess << ", " << static_cast<int>(shading);
          EXPECT_NEAR(max_red, expected, 1)
              << bright.name << ", exponent " << shininess << ", " << static_cast<int>(shading);
        }
}

}  // namespace
}  // namespace tessera::test::bright_lights_test
