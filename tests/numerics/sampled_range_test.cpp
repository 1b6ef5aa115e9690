// With several samples a pixel's centre may lie outside of the triangle that covers some of its samples, for
// a sliver by many times its width. The colour shaded there still stays within the range of the vertices. The
// mean of samples within a range, and of a clear value within it, is within the range, too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/engine/frame/api_support.h"
#include "tests/numerics/bounds.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::sampled_range_test {
namespace {

// Levels of 255.
constexpr int kSide = 64;
constexpr int kLow = 102;
constexpr int kHigh = 153;

// Triangles of any shape, half of them slivers, under perspective. Colours, and texels equal to their
// coordinates, are from kLow to kHigh.
MeshData any_triangles(Random& random) {
  MeshData mesh;
  mesh.position_components = 4;
  for (int i = 0; i < 40; ++i) {
    const float thin = i % 2 == 0 ? 0.02f : 1;
    const float x = random.between(-1, 1), y = random.between(-1, 1);
    for (int k = 0; k < 3; ++k) {
      const float w = i % 3 == 0 ? 1 : random.between(0.1f, 4);
      const float value = (kLow + static_cast<float>(random.next() % (kHigh - kLow + 1))) / 255;
      for (const float c : {(x + thin * random.between(-1, 1)) * w, (y + random.between(-1, 1)) * w, 0.0f, w})
        mesh.positions.push_back(c);
      for (const float c : {value, value, value, 1.0f}) mesh.colors.push_back(c);
      mesh.texcoords.insert(mesh.texcoords.end(), {(value * 255 + 0.5f) / 256, 0.5f});
    }
  }
  return mesh;
}

// Per-pixel lighting with cosines and distances that give levels from kLow to kHigh.
constexpr float kLit = kHigh / 255.0f;
constexpr float kDepths = 30;
constexpr float kAttenuation = 0.0005f;  // 153 / (1 + 0.0005 (30² + 2² + 2²)) = 105

// Normals of any length around z, with cosines of at least 0.675.
void tilt(MeshData& mesh, Random& random) {
  for (std::size_t i = 0; i < mesh.positions.size() / 4; ++i) {
    const float z = random.between(0.675f, 1);
    const float around = random.between(0, 6.2831853f);
    const float length = random.between(0.1f, 10);
    const float side = std::sqrt(1 - z * z);
    for (const float c : {side * std::cos(around), side * std::sin(around), z})
      mesh.normals.push_back(length * c);
  }
}
// Planes at any angle to the screen, up to kDepths in front of and behind the light.
void deepen(MeshData& mesh, Random& random) {
  for (std::size_t i = 0; i < mesh.positions.size(); i += 4)
    mesh.positions[i + 2] = mesh.positions[i + 3] * random.between(-kDepths, kDepths);
}

struct Subject {
  std::function<void(MeshData&, Random&)> shape;  // optional
  std::function<void(Frame&, DrawState&)> set_up;
};

void expect_range(const std::string& what, const Subject& subject) {
  int worst = 0;
  std::size_t colored_pixels = 0;
  for (const int samples : {1, 4, 8})
    for (const bool defer : {false, true}) {
      Random random(7);
      Renderer renderer({.threads = 1, .debug = {.defer_shading = defer}});
      for (int n = 0; n < (long_tests() ? 2000 : 40); ++n) {
        FrameBuffer buffer({.width = kSide, .height = kSide, .samples = samples});
        Frame frame(buffer);
        constexpr float kBetween = 127 / 255.0f;
        frame.clear({.color = Color{kBetween, kBetween, kBetween, 1}, .depth = 1.0});
        DrawState state;
        state.texture_env = TextureEnv::replace;
        subject.set_up(frame, state);
        MeshData mesh = any_triangles(random);
        if (subject.shape) subject.shape(mesh, random);
        frame.draw(mesh.view(), state);
        renderer.finish(frame);
        for (const std::uint32_t word : packed_colors(buffer))
          for (const int shift : {0, 8, 16}) {
            const int level = static_cast<int>(word >> shift & 255);
            worst = std::max({worst, kLow - level, level - kHigh});
            colored_pixels += level != 127 ? 1 : 0;
          }
      }
    }
  EXPECT_GT(colored_pixels, 1000u);
  expect_within("1, 4 and 8 samples, " + what + ": beyond the vertices' own", worst, 0, "levels");
}

const AlphaTest kAlwaysPasses{.func = Compare::gequal, .ref = 0};

void unlit(const std::string& what, const std::function<void(DrawState&)>& set_up) {
  expect_range(what, {.shape = {}, .set_up = [&](Frame&, DrawState& s) {
                        s.lighting = false;
                        set_up(s);
                      }});
}
void of_texels(const std::string& what, const std::function<void(DrawState&)>& set_up) {
  std::vector<std::uint8_t> texels(256);
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<std::uint8_t>(i);
  const Texture nearest({.pixels = texels.data(), .width = 256, .height = 1, .channels = 1},
                        {.mag = TextureFilter::nearest, .min = TextureFilter::nearest});
  unlit(what, [&](DrawState& s) {
    s.texture = &nearest;
    set_up(s);
  });
}

TEST(SampledRange, ColorsStayInRange) {
  unlit("colours", [](DrawState&) {});
  unlit("colours that are blended", [](DrawState& s) {
    s.blend = BlendState{.src = BlendFactor::one, .dst = BlendFactor::one_minus_src_alpha};
  });
  unlit("colours under an alpha test", [](DrawState& s) { s.alpha_test = kAlwaysPasses; });
}
TEST(SampledRange, TexelsStayInRange) {
  of_texels("nearest texels", [](DrawState&) {});
  of_texels("nearest texels under an alpha test", [](DrawState& s) { s.alpha_test = kAlwaysPasses; });
}

void lit_by(const Light& light, Frame& frame, DrawState& state) {
  frame.set_lights({light});
  frame.set_light_model({.ambient = {0, 0, 0, 1}});
  frame.set_camera({.view = {}, .projection = orthographic(-1, 1, -1, 1, -100, 100)});
  state.shading = Shading::phong;
  state.material = {.ambient = {kLit, kLit, kLit, 1}, .diffuse = {kLit, kLit, kLit, 1}};
}
void tilted(Frame& frame, DrawState& state) { lit_by({.position = {0, 0, 1, 0}}, frame, state); }
void deep(Frame& frame, DrawState& state) {
  lit_by({.ambient = {1, 1, 1, 1},
          .diffuse = {0, 0, 0, 1},
          .position = {0, 0, 0, 1},
          .attenuation_quadratic = kAttenuation},
         frame, state);
}

// Interpolated normals stay within a convex cone (all cosines above 0), and positions within a sphere.
TEST(SampledRange, NormalsStayInRange) {
  expect_range("normals", {.shape = tilt, .set_up = tilted});
  expect_range("normals under an alpha test", {.shape = tilt, .set_up = [](Frame& f, DrawState& s) {
                                                 tilted(f, s);
                                                 s.alpha_test = kAlwaysPasses;
                                               }});
}
TEST(SampledRange, PositionsStayInRange) {
  expect_range("positions", {.shape = deepen, .set_up = deep});
  expect_range("positions under an alpha test", {.shape = deepen, .set_up = [](Frame& f, DrawState& s) {
                                                   deep(f, s);
                                                   s.alpha_test = kAlwaysPasses;
                                                 }});
}

}  // namespace
}  // namespace tessera::test::sampled_range_test
