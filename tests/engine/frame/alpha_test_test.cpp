// The alpha test. A draw that stores no colour must leave the same depth and stencil values as the same draw
// with colour.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/engine/frame/api_support.h"

namespace tessera::test::alpha_test_test {
namespace {

const FrameBufferFormat kFormat{.width = 40, .height = 24, .stencil_bits = 8};

/// Stored values. The stencil counts the fragments that passed.
struct Stored {
  std::vector<std::uint32_t> depth;
  std::vector<std::uint8_t> stencil;
  friend bool operator==(const Stored&, const Stored&) = default;
};

Stored drawn(const Mesh& mesh, DrawState state, const LightModel& model, bool stores_color) {
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  frame.clear({.depth = 1.0, .stencil = 0u});
  frame.set_light_model(model);
  state.alpha_test = AlphaTest{.func = Compare::greater, .ref = 0.5f};
  state.stencil = StencilState{.front = {.zpass = StencilOp::incr}};
  if (!stores_color) state.color_mask = {false, false, false, false};
  frame.draw(mesh, state);
  Renderer().finish(frame);
  return {stored_depths(buffer), stencil_values(buffer)};
}

std::size_t passed_pixels(const Stored& stored) {
  return static_cast<std::size_t>(std::count(stored.stencil.begin(), stored.stencil.end(), 1));
}

/// Covers the window; vertex alpha rises from 0 at the left to 1 at the right.
MeshData alpha_ramp() {
  MeshData mesh = whole_window(0.25f);
  mesh.colors = {1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0};
  return mesh;
}

TEST(AlphaTestWithoutColor, TestsTheMaterialsAlpha) {
  const MeshData mesh = whole_window(0.25f);
  for (const bool lighting : {false, true})
    for (const float alpha : {0.2f, 0.8f}) {
      DrawState state = unlit({1, 1, 1, alpha});
      state.lighting = lighting;
      const Stored stored = drawn(mesh.view(), state, {}, false);
      EXPECT_EQ(passed_pixels(stored), alpha > 0.5f ? 40u * 24 : 0u) << alpha << (lighting ? " lit" : "");
      EXPECT_EQ(stored, drawn(mesh.view(), state, {}, true));
    }
}

TEST(AlphaTestWithoutColor, TestsVertexAlphaInEveryShading) {
  const MeshData mesh = alpha_ramp();
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
    for (const ColorMaterial mode : {ColorMaterial::none, ColorMaterial::diffuse,
                                     ColorMaterial::ambient_and_diffuse, ColorMaterial::specular})
      for (const bool lighting : {false, true}) {
        DrawState state;
        state.lighting = lighting;
        state.shading = shading;
        state.color_material = mode;
        state.material.diffuse.a = 0.1f;
        const Stored stored = drawn(mesh.view(), state, {}, false);
        EXPECT_EQ(stored, drawn(mesh.view(), state, {}, true))
            << static_cast<int>(shading) << " " << static_cast<int>(mode) << (lighting ? " lit" : "");
        const bool by_vertices =
            !lighting || mode == ColorMaterial::diffuse || mode == ColorMaterial::ambient_and_diffuse;
        if (shading != Shading::flat) {
          EXPECT_EQ(passed_pixels(stored), by_vertices ? 40u * 24 / 2 : 0u);
        }
      }
}

// Alpha is clamped where lighting is evaluated: at the vertices or at the pixels. It crosses 0.5 in different
// places.
TEST(AlphaTest, TestsAlphaClampedWhereLightingIsEvaluated) {
  MeshData mesh = whole_window(0.25f);
  mesh.colors = {1, 1, 1, -1, 1, 1, 1, 3, 1, 1, 1, 3, 1, 1, 1, -1};
  DrawState state;
  state.color_material = ColorMaterial::diffuse;
  for (const Shading shading : {Shading::gouraud, Shading::phong})
    for (const bool stores_color : {false, true}) {
      state.shading = shading;
      EXPECT_EQ(passed_pixels(drawn(mesh.view(), state, {}, stores_color)),
                (shading == Shading::phong ? 25u : 20u) * 24)
          << static_cast<int>(shading) << stores_color;
    }
  state.lighting = false;
  EXPECT_EQ(passed_pixels(drawn(mesh.view(), state, {}, false)), 20u * 24) << "unlit";
}

// Every pixel path clamps in the same way: immediate and deferred shading, samples, textures and outlines.
TEST(LitAlpha, IsClampedWhereLightingIsEvaluated) {
  MeshData mesh = rectangle(-1, -0.5f, 1, 0.5f, 0.25f);  // the lower side lies between rows 17 and 18
  mesh.primitive = Primitive::quads;
  mesh.indices = {0, 1, 2, 3};
  mesh.colors = {1, 1, 1, -1, 1, 1, 1, 3, 1, 1, 1, 3, 1, 1, 1, -1};
  mesh.texcoords = {0, 0, 1, 0, 1, 1, 0, 1};
  const std::array<std::uint8_t, 4> white{255, 255, 255, 255};
  const Texture texture({.pixels = white.data(), .width = 1, .height = 1, .channels = 4});
  for (const Shading shading : {Shading::gouraud, Shading::phong})
    for (const int samples : {1, 4})
      for (const Texture* const white_texture : {static_cast<const Texture*>(nullptr), &texture})
        for (const PolygonMode mode : {PolygonMode::fill, PolygonMode::line}) {
          DrawState state{.shading = shading, .color_material = ColorMaterial::diffuse};
          state.material.emission = {1, 1, 1, 1};
          state.blend = BlendState{};
          state.texture = white_texture;
          state.front_mode = state.back_mode = mode;
          state.line_width = 4;
          state.depth.enabled = false;
          FrameBuffer buffer({.width = 40, .height = 24, .samples = samples});
          Frame frame(buffer);
          frame.clear({.color = Color{0, 0, 0, 1}});
          frame.draw(mesh.view(), state);
          Renderer().finish(frame);
          const std::vector<std::uint32_t> words = packed_colors(buffer);
          for (std::size_t x = 3; x < 37; ++x) {  // columns not covered by the left and right sides
            const double along = (static_cast<double>(x) + 0.5) / 40;
            const double alpha = std::clamp(shading == Shading::phong ? -1 + 4 * along : along, 0.0, 1.0);
            ASSERT_NEAR(words[17 * 40 + x] >> 16 & 255, 255 * alpha, 1)
                << x << ", " << static_cast<int>(shading) << " " << samples << " "
                << (white_texture != nullptr) << " " << static_cast<int>(mode);
          }
        }
}

TEST(AlphaTestWithoutColor, TestsTheMaterialOfEachFace) {
  const MeshData mesh = whole_window(0.25f);
  for (const FrontFace front : {FrontFace::ccw, FrontFace::cw}) {
    DrawState state;
    state.front_face = front;
    state.material.diffuse.a = 0.2f;
    state.back_material = Material{.diffuse = {1, 1, 1, 0.8f}};
    EXPECT_EQ(passed_pixels(drawn(mesh.view(), state, {.two_sided = true}, false)),
              front == FrontFace::cw ? 40u * 24 : 0u);
    EXPECT_EQ(passed_pixels(drawn(mesh.view(), state, {.two_sided = false}, false)), 0u);
  }
}

}  // namespace
}  // namespace tessera::test::alpha_test_test
