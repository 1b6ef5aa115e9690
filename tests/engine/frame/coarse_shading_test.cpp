// Coarse shading (phong_2x2, phong_4x4): against an independent computation in double, bounds of its error,
// and what stays per pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/engine/frame/api_support.h"
#include "tests/engine/frame/texture_support.h"

namespace tessera::coarse_shading_test {
namespace {

using namespace test;

constexpr int kWidth = 96, kHeight = 80;

struct Levels {
  std::vector<std::uint32_t> words;
  int operator()(int x, int row, int component) const {
    const std::uint32_t word = words[static_cast<std::size_t>(row * kWidth + x)];
    return static_cast<int>(word >> (8 * (2 - component)) & 255);
  }
};

struct CoarseScene {
  MeshData mesh;
  DrawState state;
  std::vector<Light> lights;
  LightModel model{.ambient = {0, 0, 0, 1}};
  FrameBufferFormat format{.width = kWidth, .height = kHeight};

  Levels drawn(const Quality& quality, const RendererOptions& options = {.threads = 1}) const {
    FrameBuffer buffer(format);
    Frame frame(buffer);
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    frame.set_lights(lights);
    frame.set_light_model(model);
    frame.set_quality(quality);
    frame.draw(mesh.view(), state);
    Renderer(options).finish(frame);
    return {packed_colors(buffer)};
  }
};

Quality coarse(int size) { return {.shading = size == 2 ? ShadingCap::phong_2x2 : ShadingCap::phong_4x4}; }

/// The window as a quad of two triangles at z = 0 with normals that differ, and a near light with a
/// highlight.
CoarseScene shiny_window() {
  CoarseScene scene;
  scene.mesh = whole_window();
  scene.mesh.normals = {-0.6f, -0.5f, 0.6f, 0.7f, -0.4f, 0.6f, 0.5f, 0.6f, 0.6f, -0.5f, 0.6f, 0.6f};
  scene.state.shading = Shading::phong;
  scene.state.material.ambient = {0, 0, 0, 1};
  scene.state.material.diffuse = {0.7f, 0.5f, 0.2f, 1};
  scene.state.material.specular = {0.3f, 0.4f, 0.5f, 1};
  scene.state.material.shininess = 20;
  Light light;
  light.position = {0.3f, 0.2f, 0.9f, 1};
  scene.lights = {light};
  return scene;
}

using Vec = std::array<double, 3>;
double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec unit(const Vec& v) {
  const double length = std::sqrt(dot(v, v));
  return {v[0] / length, v[1] / length, v[2] / length};
}

/// Colour of shiny_window() at a point of the window, in pixels from the top left corner, in double. NaN on
/// the diagonal, where the triangles meet.
Vec exact_color(const CoarseScene& scene, double column, double row) {
  const double x = 2 * column / kWidth - 1, y = 1 - 2 * row / kHeight;
  // Triangles 0 1 2 and 0 2 3: below and above the diagonal y = x of clip space.
  const std::size_t corners[2][3] = {{0, 1, 2}, {0, 2, 3}};
  const std::size_t(&corner)[3] = corners[y < x ? 0 : 1];
  const auto position = [&](std::size_t k, std::size_t c) {
    return double{scene.mesh.positions[3 * corner[k] + c]};
  };
  const double ax = position(1, 0) - position(0, 0), ay = position(1, 1) - position(0, 1);
  const double bx = position(2, 0) - position(0, 0), by = position(2, 1) - position(0, 1);
  const double px = x - position(0, 0), py = y - position(0, 1);
  const double b1 = (px * by - py * bx) / (ax * by - ay * bx), b2 = (ax * py - ay * px) / (ax * by - ay * bx);
  Vec n{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto normal = [&](std::size_t k) {
      const float* const at = scene.mesh.normals.data() + 3 * corner[k];
      return unit({at[0], at[1], at[2]})[c];
    };
    n[c] = (1 - b1 - b2) * normal(0) + b1 * normal(1) + b2 * normal(2);
  }
  n = unit(n);
  const Light& light = scene.lights[0];
  const Vec to_light = unit({light.position[0] - x, light.position[1] - y, double{light.position[2]}});
  const Vec half = unit({to_light[0], to_light[1], to_light[2] + 1});
  const double diffuse = std::max(dot(n, to_light), 0.0);
  const double highlight =
      diffuse > 0 ? std::pow(std::max(dot(n, half), 0.0), double{scene.state.material.shininess}) : 0;
  const Material& m = scene.state.material;
  return {std::min(diffuse * m.diffuse.r + highlight * m.specular.r, 1.0),
          std::min(diffuse * m.diffuse.g + highlight * m.specular.g, 1.0),
          std::min(diffuse * m.diffuse.b + highlight * m.specular.b, 1.0)};
}

TEST(CoarseShading, LightsCellsAtTheirCentre) {
  const CoarseScene scene = shiny_window();
  for (const int size : {2, 4}) {
    const Levels levels = scene.drawn(coarse(size));
    int cells = 0;
    for (int row = 0; row < kHeight; row += size)
      for (int column = 0; column < kWidth; column += size) {
        // Cells of two triangles are left to other tests.
        const auto above = [](double c, double r) { return 1 - 2 * r / kHeight > 2 * c / kWidth - 1; };
        const bool first = above(column, row);
        if (above(column + size, row) != first || above(column, row + size) != first ||
            above(column + size, row + size) != first)
          continue;
        ++cells;
        const Vec expected = exact_color(scene, column + size / 2.0, row + size / 2.0);
        for (int y = row; y < row + size; ++y)
          for (int x = column; x < column + size; ++x)
            for (int c = 0; c < 3; ++c)
              ASSERT_NEAR(levels(x, y, c), 255 * expected[static_cast<std::size_t>(c)], 0.51)
                  << "cell of " << size << ", pixel " << x << " " << y;
      }
    EXPECT_GT(cells, kWidth * kHeight / (size * size) * 8 / 10);
  }
}

TEST(CoarseShading, KeepsDrawsThatAskForLess) {
  CoarseScene scene = shiny_window();
  for (const Shading shading : {Shading::flat, Shading::gouraud}) {
    scene.state.shading = shading;
    EXPECT_EQ(scene.drawn(coarse(2)).words, scene.drawn({}).words);
  }
}

/// Random triangles in the plane z = 0, from slivers to half of the window, whose colour under a light along
/// +z is a function of the position: the z of their normals, which are not normalized.
CoarseScene ramp_scene(std::uint64_t seed, const std::function<float(float x, float y)>& ramp) {
  CoarseScene scene;
  Random random(seed);
  for (int i = 0; i < 300; ++i) {
    const float size = i % 10 == 0 ? 1.0f : 0.12f;
    const float thin = i % 3 == 0 ? 0.02f : 1.0f;
    const float center[2] = {random.between(-1, 1), random.between(-1, 1)};
    for (int k = 0; k < 3; ++k) {
      const float x = std::clamp(center[0] + random.between(-size, size), -1.0f, 1.0f);
      const float y = std::clamp(center[1] + thin * random.between(-size, size), -1.0f, 1.0f);
      scene.mesh.positions.insert(scene.mesh.positions.end(), {x, y, -static_cast<float>(i) / 400});
      scene.mesh.normals.insert(scene.mesh.normals.end(), {0, 0, ramp(x, y)});
    }
  }
  scene.state.shading = Shading::phong;
  scene.state.normalize = false;
  scene.state.material.ambient = {0, 0, 0, 1};
  scene.state.material.diffuse = {1, 1, 1, 1};
  Light light;
  light.specular = {0, 0, 0, 1};
  scene.lights = {light};
  return scene;
}

// A pixel is lit inside of its cell: at the centre or at the centre of another pixel, so at most size - 1
// pixels away along each axis.
TEST(CoarseShading, ErrsOnARampByAtMostItsSlopeTimesTheCell) {
  const auto ramp_x = [](float x, float) { return 0.5f + 0.48f * x; };
  const auto ramp_y = [](float, float y) { return 0.5f - 0.45f * y; };
  const double slope_x = 255 * 2 * 0.48 / kWidth, slope_y = 255 * 2 * 0.45 / kHeight;  // levels per pixel
  for (std::uint64_t seed = 0; seed < 4; ++seed)
    for (const bool along_x : {true, false}) {
      const CoarseScene scene =
          ramp_scene(seed, along_x ? std::function<float(float, float)>(ramp_x) : ramp_y);
      const Levels exact = scene.drawn({.renormalize = false});
      for (const int size : {2, 4}) {
        Quality quality = coarse(size);
        quality.renormalize = false;
        const Levels levels = scene.drawn(quality);
        const double bound = (along_x ? slope_x : slope_y) * (size - 1) +
                             1.1;  // both are rounded to levels, and vertices are snapped
        int changed = 0;
        for (int row = 0; row < kHeight; ++row)
          for (int x = 0; x < kWidth; ++x) {
            ASSERT_LE(std::abs(levels(x, row, 0) - exact(x, row, 0)), bound)
                << "cell of " << size << ", pixel " << x << " " << row << ", seed " << seed;
            changed += levels(x, row, 0) != exact(x, row, 0) ? 1 : 0;
          }
        EXPECT_GT(changed, kWidth * kHeight / 4);
      }
    }
}

TEST(CoarseShading, DoesNotDependOnWhatHidesTheTriangle) {
  CoarseScene scene = ramp_scene(9, [](float x, float y) { return 0.5f + 0.3f * x + 0.15f * y; });
  scene.state.material.diffuse = {1, 1, 0, 1};
  const CoarseScene window = shiny_window();
  // The same draw behind a comb of thin unlit triangles: the pixels that remain keep their colours.
  MeshData comb;
  for (int i = 0; i < 60; ++i) {
    const float x = -1 + static_cast<float>(i) / 30;
    comb.positions.insert(comb.positions.end(), {x, -1, -0.9f, x + 0.017f, -1, -0.9f, x + 0.03f, 1, -0.9f});
  }
  for (const int samples : {1, 4})
    for (const int size : {2, 4}) {
      const auto drawn = [&](bool hidden) {
        FrameBufferFormat format = scene.format;
        format.samples = samples;
        FrameBuffer buffer(format);
        Frame frame(buffer);
        frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
        frame.set_lights(window.lights);
        frame.set_quality(coarse(size));
        if (hidden) frame.draw(comb.view(), unlit({0, 0, 1, 1}));
        frame.draw(scene.mesh.view(), scene.state);
        Renderer({.threads = 1}).finish(frame);
        return packed_colors(buffer);
      };
      const std::vector<std::uint32_t> free = drawn(false), hidden = drawn(true);
      int kept = 0;
      for (std::size_t i = 0; i < free.size(); ++i) {
        if ((hidden[i] & 255) != 0) continue;  // only the comb is blue
        ASSERT_EQ(hidden[i], free[i]) << "pixel " << i << ", cell of " << size;
        ++kept;
      }
      EXPECT_GT(kept, kWidth * kHeight / 10);
    }
}

TEST(CoarseShading, KeepsTexturesAndCoveragePerPixel) {
  // White light on a white material that is equally bright everywhere: only the texture shows.
  const Pixels pixels(64, 64, 3);
  const Texture texture(pixels.image(), {.mag = TextureFilter::nearest, .min = TextureFilter::nearest});
  CoarseScene scene = shiny_window();
  scene.mesh = textured_window(1.3f, 1.1f);
  scene.mesh.normals = {0, 0, 1, 0, 0, 1, 0, 0.001f, 1, 0, 0, 1};
  scene.state.texture = &texture;
  scene.state.material.diffuse = {0, 0, 0, 1};
  scene.state.material.specular = {0, 0, 0, 1};
  scene.state.material.emission = {1, 1, 1, 1};
  scene.state.material.ambient = {0.5f, 0.5f, 0.5f, 1};
  scene.lights[0].ambient = {0.5f, 0.5f, 0.5f, 1};
  for (const int samples : {1, 4}) {
    scene.format.samples = samples;
    const Levels fine = scene.drawn({});
    for (const int size : {2, 4}) EXPECT_EQ(scene.drawn(coarse(size)).words, fine.words);
  }
}

TEST(CoarseShading, StaysWithinTheColorsOfTheVertices) {
  // Slivers and needles across the eye's plane, where extrapolated values would explode.
  Random random(3);
  MeshData mesh;
  for (int i = 0; i < 2000; ++i) {
    const float center[3] = {random.between(-2, 2), random.between(-2, 2), random.between(-4, 0.5f)};
    const float size[3] = {random.between(0, 3), random.between(0, 0.02f), random.between(0, 3)};
    for (int k = 0; k < 3; ++k) {
      for (std::size_t c = 0; c < 3; ++c)
        mesh.positions.push_back(center[c] + random.between(-size[c], size[c]));
      mesh.normals.insert(mesh.normals.end(), {0, 0, random.between(0.25f, 0.75f)});
    }
  }
  for (const int samples : {1, 4, 8})
    for (const int size : {2, 4}) {
      FrameBuffer buffer({.width = kWidth, .height = kHeight, .samples = samples});
      Frame frame(buffer);
      frame.clear({.color = Color{0.5f, 0.5f, 0.5f, 1}, .depth = 1.0});
      frame.set_camera({.projection = perspective(80, 1.2, 0.001, 10)});
      Light light;
      light.specular = {0, 0, 0, 1};
      frame.set_lights({light});
      frame.set_light_model({.ambient = {0, 0, 0, 1}});
      Quality quality = coarse(size);
      quality.renormalize = false;
      frame.set_quality(quality);
      DrawState state;
      state.shading = Shading::phong;
      state.normalize = false;
      state.material.diffuse = {1, 1, 1, 1};
      frame.draw(mesh.view(), state);
      Renderer({.threads = 1}).finish(frame);
      int drawn = 0;
      for (const std::uint32_t word : packed_colors(buffer)) {
        const auto level = static_cast<int>(word & 255);
        ASSERT_GE(level, 63);
        ASSERT_LE(level, 192);
        drawn += level != 128 ? 1 : 0;
      }
      EXPECT_GT(drawn, kWidth * kHeight / 4);
    }
}

}  // namespace
}  // namespace tessera::coarse_shading_test
