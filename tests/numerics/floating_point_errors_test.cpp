// Errors in any floating-point mode of the caller: invalid input gives the same message, no trap fires, and
// the mode is restored.
#include <gtest/gtest.h>

#include "tests/numerics/every_host_mode.h"

#if defined(__x86_64__)

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>

#include "tests/engine/frame/api_support.h"

namespace tessera::test::floating_point_errors_test {
using namespace program;
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kDenormal = 1e-40f;

// Invalid input is rejected with the same message: no trap may fire for a comparison with NaN. Dropped
// primitives fire no trap either.
TEST(FloatingPointErrors, NeitherTrapsOnNorChangesInvalidInput) {
  std::vector<std::function<void()>> wrong;
  const auto draw = [&](const std::function<void(DrawState&)>& change) {
    DrawState state;
    change(state);
    wrong.push_back([state] {
      FrameBuffer buffer({.width = 8, .height = 8});
      static const MeshData mesh = whole_window();
      Frame(buffer).draw(mesh.view(), state);
    });
  };
  for (const float odd : {kNan, kInfinity, -kInfinity}) {
    draw([&](DrawState& s) { s.depth_near = double{odd}; });
    draw([&](DrawState& s) { s.material.diffuse.g = odd; });
    draw([&](DrawState& s) { s.material.shininess = odd; });
    draw([&](DrawState& s) { s.transform.m[7] = double{odd}; });
    draw([&](DrawState& s) { s.point_size = odd; });
    draw([&](DrawState& s) { s.polygon_offset.units = odd; });
    draw([&](DrawState& s) { s.alpha_test = AlphaTest{.ref = odd}; });
    draw([&](DrawState& s) { s.blend = BlendState{.color = {odd, 0, 0, 0}}; });
    draw([&](DrawState& s) { s.shadow_on = ShadowOn{.plane = {0, double{odd}, 0, 1}}; });
    const Clear clear{.depth = double{odd}};
    const Clear color{.color = Color{odd, 0, 0, 1}};
    const Accum accum{.value = double{odd}};
    Camera camera;
    camera.projection.m[3] = double{odd};
    Light light;
    light.spot_cutoff = odd;
    const Bitmap bitmap{
        .bits = reinterpret_cast<const std::uint8_t*>("x"), .width = 1, .height = 1, .x = double{odd}};
    const PixelImage image{.pixels = reinterpret_cast<const std::uint8_t*>("abcd"),
                           .width = 1,
                           .height = 1,
                           .zoom_x = double{odd}};
    wrong.push_back([=] {
      FrameBuffer b({.width = 8, .height = 8});
      Frame(b).clear(clear);
    });
    wrong.push_back([=] {
      FrameBuffer b({.width = 8, .height = 8});
      Frame(b).clear(color);
    });
    wrong.push_back([=] {
      FrameBuffer b({.width = 8, .height = 8, .accumulation_bits = 16});
      Frame(b).accumulate(accum);
    });
    wrong.push_back([=] {
      FrameBuffer b({.width = 8, .height = 8});
      Frame(b).set_camera(camera);
    });
    wrong.push_back([=] {
      FrameBuffer b({.width = 8, .height = 8});
      Frame(b).set_lights({light});
    });
    wrong.push_back([=] {
      FrameBuffer b({.width = 8, .height = 8});
      Frame(b).draw_bitmap(bitmap);
    });
    wrong.push_back([=] {
      FrameBuffer b({.width = 8, .height = 8});
      Frame(b).draw_image(image);
    });
    wrong.push_back([=] {
      FrameBuffer b({.width = 8,
                     .height = 8,
                     .color_mode = ColorMode::index,
                     .color_bits = 2,
                     .palette = {{odd, 0, 0, 1}}});
    });
    wrong.push_back([=] { (void)perspective(double{odd}, 1, 0.1, 10); });
    wrong.push_back([=] { (void)look_at({0, 0, double{odd}}, {0, 0, 0}, {0, 1, 0}); });
    wrong.push_back([=] { (void)rotate(10, double{odd}, 0, 1); });
    wrong.push_back([=] { (void)orthographic(double{odd}, 1, 0, 1, 0, 1); });
    wrong.push_back([=] { (void)frustum(0, double{odd}, 0, 1, 0.1, 1); });
    wrong.push_back([=] { (void)calibrated_camera({1, double{odd}, 0, 0, 4, 4}, {}, 0.1, 10); });
  }
  std::vector<std::string> messages;
  expect_the_same_in_every_mode(
      [&] {
        messages.clear();
        for (const auto& act : wrong) messages.push_back(error_of(act).value_or("no error"));
      },
      [&] { return messages; });
  EXPECT_EQ(std::count(messages.begin(), messages.end(), "no error"), 0);

  // A mesh of such vertices, with such normals and texture coordinates.
  MeshData mesh = whole_window();
  mesh.normals = {0, 0, 1, kNan, 0, 1, 0, kInfinity, 0, 0, 0, 1};
  mesh.texcoords = {0, 0, kNan, 0, 3e38f, -3e38f, kDenormal, 0};
  mesh.positions[4] = 3e38f;
  FrameStats stats;
  std::vector<std::uint32_t> words(64);
  expect_the_same_in_every_mode(
      [&] {
        FrameBuffer buffer({.width = 8, .height = 8});
        Frame frame(buffer);
        frame.draw(mesh.view());
        stats = Renderer({.threads = 1}).finish(frame);
        buffer.read_packed_colors(words);
      },
      [&] { return std::pair(words, stats.dropped_non_finite); });
}

TEST(FloatingPointErrors, IsRestoredAfterAFailedFrame) {
  FrameBuffer buffer({.width = 80, .height = 80});
  FrameBuffer lost({.width = 8, .height = 8});
  const MeshData mesh = whole_window();
  bool stops = false;
  Renderer renderer({.threads = 1, .progress = [&](double) { return !stops; }});
  Renderer logs({.threads = 1, .log = [](LogLevel level, std::string_view) {
                   if (level == LogLevel::debug) throw std::runtime_error("full");
                 }});
  Frame frame(lost);
  frame.clear({.color = Color{}});
  frame.keep({});
  renderer.finish(frame);
  stops = true;
  int failures = 0;
  expect_the_same_in_every_mode(
      [&] {
        failures = 0;
        Frame missing(lost);
        Frame cancelled(buffer);
        Frame logged(buffer);
        missing.draw(mesh.view());
        cancelled.draw(mesh.view());
        logged.draw(mesh.view());
        try {
          renderer.finish(missing);
        } catch (const Error&) {
          ++failures;
        }
        try {
          renderer.finish(cancelled);
        } catch (const Cancelled&) {
          ++failures;
        }
        try {
          logs.finish(logged);
        } catch (const std::runtime_error&) {
          ++failures;
        }
      },
      [&] { return failures; });
  EXPECT_EQ(failures, 3);
}

}  // namespace
}  // namespace tessera::test::floating_point_errors_test

#endif
