// Captured draw numbers, primitive numbers and normals, and fragment counts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/program/scene/builtin_mesh.h"
#include "tests/engine/frame/api_random_frame.h"

namespace tessera::capture_test {
using namespace program;
namespace {

using namespace test;

constexpr FrameBufferFormat kFormat{.width = 150, .height = 110};

struct Pixels {
  std::vector<std::uint32_t> draw_ids;
  std::vector<std::uint32_t> primitive_ids;
  std::vector<float> normals;
  explicit Pixels(const FrameBuffer& buffer)
      : draw_ids(pixel_count(buffer), 7),
        primitive_ids(pixel_count(buffer), 7),
        normals(3 * pixel_count(buffer), 7.0f) {}
  Capture all() { return {.draw_ids = draw_ids, .primitive_ids = primitive_ids, .normals = normals}; }
};

// Oracle: each triangle is a separate unlit draw whose colour is its number.
TEST(Capture, NamesTheTriangleThatColoredThePixel) {
  const RandomFrame scene(kFormat, 400);
  for (const int tile_size : {32, 64, 128}) {
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
      Renderer renderer({.threads = 2, .tile_size = tile_size});
      FrameBuffer buffer(kFormat);
      FrameBuffer numbered(kFormat);
      Frame frame(buffer);
      Frame numbers(numbered);
      std::vector<MeshData> single;
      single.reserve(1000);
      std::vector<std::pair<std::uint32_t, std::uint32_t>> origins;  // number -> (draw, primitive)
      std::uint32_t object = 0;
      for (Frame* f : {&frame, &numbers}) {
        f->clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
        f->set_camera(scene.camera);
      }
      for (const MeshData* mesh : {&scene.triangles, &scene.strip}) {
        DrawState state;
        state.shading = shading;
        state.cull = object == 0 ? Cull::none : Cull::back;
        frame.draw(mesh->view(), state);
        for (std::uint32_t t = 0; t < mesh->triangle_count(); ++t) {
          origins.emplace_back(object, t);
          MeshData& one = single.emplace_back();
          for (std::uint32_t k = 0; k < 3; ++k) {
            const std::size_t v = mesh->indices.empty() ? 3 * t + k : mesh->indices[3 * t + k];
            one.positions.insert(one.positions.end(), {mesh->positions[3 * v], mesh->positions[3 * v + 1],
                                                       mesh->positions[3 * v + 2]});
          }
          const auto number = static_cast<std::uint32_t>(origins.size());
          DrawState plain =
              unlit({static_cast<float>(number >> 16 & 255) / 255,
                     static_cast<float>(number >> 8 & 255) / 255, static_cast<float>(number & 255) / 255, 1});
          plain.cull = state.cull;
          numbers.draw(one.view(), plain);
        }
        ++object;
      }
      Pixels pixels(buffer);
      frame.capture(pixels.all());
      renderer.finish(frame);
      renderer.finish(numbers);
      const std::vector<std::uint32_t> words = packed_colors(numbered);
      std::size_t drawn = 0;
      for (std::size_t i = 0; i < words.size(); ++i) {
        const bool nothing = words[i] == 0;
        ASSERT_EQ(pixels.draw_ids[i], nothing ? Capture::kNothing : origins[words[i] - 1].first) << i;
        ASSERT_EQ(pixels.primitive_ids[i], nothing ? Capture::kNothing : origins[words[i] - 1].second) << i;
        const double length =
            std::hypot(pixels.normals[3 * i], pixels.normals[3 * i + 1], pixels.normals[3 * i + 2]);
        ASSERT_NEAR(length, nothing ? 0 : 1, 1e-5) << i;
        drawn += nothing ? 0 : 1;
      }
      EXPECT_GT(drawn, words.size() / 4);
    }
  }
}

TEST(Capture, KeepsThePictureAndAppliesToOneFrame) {
  const RandomFrame scene(kFormat, 400);
  Renderer renderer({.threads = 2});
  FrameBuffer plain(kFormat);
  FrameBuffer captured(kFormat);
  Frame frame(plain);
  Frame with(captured);
  scene.record(frame);
  scene.record(with);
  Pixels pixels(captured);
  with.capture(pixels.all());
  const FrameStats stats_without = renderer.finish(frame);
  const FrameStats stats_with = renderer.finish(with);
  EXPECT_EQ(fingerprint(plain), fingerprint(captured));
  EXPECT_EQ(stats_without.shaded_pixels, stats_with.shaded_pixels);
  const Pixels first = pixels;
  with.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  renderer.finish(with);
  EXPECT_EQ(pixels.draw_ids, first.draw_ids) << "not requested again";
}

// Neither the colour mode nor deferred shading affects which triangle is visible.
TEST(Capture, IsTheSameForIndicesAndForImmediateShading) {
  const RandomFrame scene(kFormat, 400);
  FrameBufferFormat indices = kFormat;
  indices.color_mode = ColorMode::index;
  indices.color_bits = 4;
  std::optional<Pixels> first;
  for (const FrameBufferFormat& format : {kFormat, indices})
    for (const bool defer : {true, false}) {
      Renderer renderer({.threads = 2, .debug = {.defer_shading = defer}});
      FrameBuffer buffer(format);
      Frame frame(buffer);
      scene.record(frame);
      Pixels pixels(buffer);
      frame.capture(pixels.all());
      renderer.finish(frame);
      if (!first) first = pixels;
      EXPECT_EQ(pixels.draw_ids, first->draw_ids);
      EXPECT_EQ(pixels.primitive_ids, first->primitive_ids);
      EXPECT_EQ(pixels.normals, first->normals);
      EXPECT_GT(std::count(pixels.draw_ids.begin(), pixels.draw_ids.end(), 0u), 1000);
    }
}

TEST(Capture, NormalsMatchThoseOfASphere) {
  const MeshData sphere = builtin_mesh("sphere", 48);
  for (const bool given : {true, false}) {
    for (const Shading shading : {Shading::flat, Shading::phong}) {
      Renderer renderer({.threads = 1});
      FrameBuffer buffer({.width = 101, .height = 101});
      Frame frame(buffer);
      frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
      // A rotated view: eye space differs from world space.
      frame.set_camera(
          {.view = rotate(70, 1, 2, 3), .projection = orthographic(-1.1, 1.1, -1.1, 1.1, -2, 2)});
      Mesh mesh = sphere.view();
      if (!given) mesh.normals = {};
      frame.draw(mesh, {.shading = shading});
      Pixels pixels(buffer);
      frame.capture({.normals = pixels.normals});
      renderer.finish(frame);
      double radius = 0;
      for (const float p : sphere.positions) radius = std::max<double>(radius, std::abs(p));
      int checked = 0;
      for (int y = 0; y < 101; ++y)
        for (int x = 0; x < 101; ++x) {
          const double nx = (x - 50) * (2.2 / 101) / radius;
          const double ny = (50 - y) * (2.2 / 101) / radius;
          const double squared = nx * nx + ny * ny;
          if (squared > 0.8) continue;
          const float* n = &pixels.normals[3 * static_cast<std::size_t>(101 * y + x)];
          ASSERT_NEAR(n[0], nx, 0.01) << x << ' ' << y;
          ASSERT_NEAR(n[1], ny, 0.01);
          ASSERT_NEAR(n[2], std::sqrt(1 - squared), 0.01);
          ++checked;
        }
      EXPECT_GT(checked, 3000);
    }
  }
}

TEST(Capture, FollowsClearsMasksAndLaterDraws) {
  Renderer renderer({.threads = 1});
  FrameBuffer buffer({.width = 8, .height = 8});
  Frame frame(buffer);
  const MeshData whole = whole_window();
  const MeshData left = rectangle(-1, -1, 0, 1, 0.5f);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  frame.draw(whole.view(), {});
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0, .scissor = Rect{0, 0, 8, 4}});
  frame.draw(left.view(), {.color_mask = {false, false, false, false}});  // depth only
  frame.draw(left.view(), {.depth = {.test = Compare::equal}});
  frame.draw(MeshData{}.view(), {});
  frame.draw(whole.view(), {.depth = {.test = Compare::never}});
  Pixels pixels(buffer);
  frame.capture({.draw_ids = pixels.draw_ids, .primitive_ids = pixels.primitive_ids});
  renderer.finish(frame);
  for (std::size_t y = 0; y < 8; ++y)
    for (std::size_t x = 0; x < 8; ++x) {
      const std::uint32_t lower = x < 4 ? 2u : Capture::kNothing;
      EXPECT_EQ(pixels.draw_ids[8 * y + x], y < 4 ? 0u : lower) << x << ' ' << y;
    }
  EXPECT_EQ(pixels.normals[0], 7.0f) << "not requested";
}

TEST(Capture, SpansOfAnotherSizeAreRefused) {
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  std::vector<std::uint32_t> ids(10);
  std::vector<float> normals(pixel_count(buffer));
  EXPECT_THAT(
      error_of([&] { frame.capture({.draw_ids = ids}); }).value_or(""),
      testing::AllOf(testing::HasSubstr("draw_ids"), testing::HasSubstr("10"), testing::HasSubstr("16500")));
  EXPECT_THAT(error_of([&] { frame.capture({.primitive_ids = ids}); }).value_or(""),
              testing::HasSubstr("primitive_ids"));
  EXPECT_THAT(error_of([&] { frame.capture({.normals = normals}); }).value_or(""),
              testing::HasSubstr("49500"));
}

TEST(Fragments, AreCountedBeforeAnyTestAndOnlyOnRequest) {
  FrameBuffer buffer({.width = 37, .height = 21});
  const MeshData near = whole_window(-0.5f);
  const MeshData far = whole_window(0.5f);
  const MeshData half = rectangle(-1, -1, 1, 0, 0);
  for (const bool count : {false, true}) {
    Renderer renderer({.threads = 1, .debug = {.count_fragments = count}});
    Frame frame(buffer);
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    frame.draw(near.view(), unlit({1, 1, 1, 1}));
    frame.draw(far.view(), {.shading = Shading::phong});
    DrawState cut = unlit({1, 0, 0, 1});
    cut.scissor = Rect{3, 2, 11, 9};
    frame.draw(half.view(), cut);
    frame.draw(half.view(), {.cull = Cull::front});
    const FrameStats stats = renderer.finish(frame);
    EXPECT_EQ(stats.fragments, count ? 2u * 37 * 21 + 11 * 9 : 0u);
  }
}

TEST(Capture, HoldsNothingWhereAClearIsDithered) {
  FrameBuffer buffer({.width = 20, .height = 20, .color_bits = 3, .dither = Dither::bayer4});
  std::vector<std::uint32_t> draw_ids(pixel_count(buffer));
  Frame frame(buffer);
  frame.clear({.color = Color{0.4f, 0.5f, 0.6f, 1}});
  frame.capture({.draw_ids = draw_ids});
  Renderer({.threads = 1}).finish(frame);
  EXPECT_THAT(draw_ids, testing::Each(Capture::kNothing));
}

}  // namespace
}  // namespace tessera::capture_test
