// Buffers of one and two bits hold the luminance of colours clamped to 0 .. 1, for every source of colour.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/frame/api_support.h"

namespace tessera::test::luminance_test {
namespace {

std::vector<std::uint32_t> drawn(const MeshData& mesh, const DrawState& state, int bits) {
  FrameBuffer buffer({.width = 20, .height = 12, .color_bits = bits});
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  frame.set_lights({});
  frame.set_light_model({.ambient = {0, 0, 0, 1}});
  frame.draw(mesh.view(), state);
  Renderer({.threads = 1}).finish(frame);
  return packed_colors(buffer);
}

TEST(Luminance, IsComputedFromClampedColors) {
  const Color colors[] = {{2, 0, 0, 1},     {-1, 1, 0, 1}, {0, 0, 5, 1},         {0.2f, -3, 9, 1},
                          {0, 1.5f, -2, 1}, {7, 7, 7, 1},  {0.4f, 0.6f, 0.5f, 1}};
  for (const int bits : {1, 2})
    for (const Color& c : colors) {
      const auto clamped = [](float x) { return static_cast<double>(std::clamp(x, 0.0f, 1.0f)); };
      const double luminance = 0.30 * clamped(c.r) + 0.59 * clamped(c.g) + 0.11 * clamped(c.b);
      const auto expected = static_cast<std::uint32_t>(std::lround(luminance * ((1 << bits) - 1)));
      const MeshData plain = whole_window();
      MeshData colored = plain;
      for (std::size_t v = 0; v < plain.positions.size() / 3; ++v)
        colored.colors.insert(colored.colors.end(), {c.r, c.g, c.b, c.a});
      DrawState unlit_state = unlit(c);
      DrawState tested = unlit_state;
      DrawState lit;
      DrawState per_pixel;
      tested.alpha_test = AlphaTest{.func = Compare::gequal, .ref = 0};
      lit.material.emission = per_pixel.material.emission = c;
      per_pixel.shading = Shading::phong;
      const struct {
        const char* what;
        const MeshData& mesh;
        const DrawState& state;
      } ways[] = {{"material", plain, unlit_state},
                  {"alpha test", plain, tested},
                  {"vertex colours", colored, unlit_state},
                  {"emission", plain, lit},
                  {"emission, per pixel", plain, per_pixel}};
      for (const auto& way : ways) {
        const std::vector<std::uint32_t> words = drawn(way.mesh, way.state, bits);
        EXPECT_EQ(std::count(words.begin(), words.end(), expected), 20 * 12)
            << way.what << ": " << c.r << " " << c.g << " " << c.b << ", " << bits << " bits";
      }
    }
}

}  // namespace
}  // namespace tessera::test::luminance_test
