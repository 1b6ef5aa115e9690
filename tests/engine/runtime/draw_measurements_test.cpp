// Renderer::draw_measurements: counts against independent ones, times against the frame's, the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <span>
#include <vector>

#include "engine/program/threads/thread_limit.h"
#include "tests/engine/frame/api_random_frame.h"
#include "tests/engine/frame/api_random_operations.h"
#include "tests/engine/stages/bin_overflow_scene.h"

namespace tessera::draw_measurements_test {
namespace {

using namespace program;
using namespace test;

const DebugOptions kMeasured{.count_fragments = true, .measure_draws = true};

struct MeasuredFrame {
  FrameStats stats;
  std::vector<DrawMeasurement> draws;
  double seconds = 0;
  int threads = 0;
  Fingerprint bits;
};

template <class Scene>
MeasuredFrame measured_frame(const Scene& scene, const RendererOptions& options) {
  FrameBuffer buffer(scene.format);
  Frame frame(buffer);
  scene.record(frame);
  Renderer renderer(options);
  MeasuredFrame result;
  const auto begin = std::chrono::steady_clock::now();
  result.stats = renderer.finish(frame);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.threads = renderer.options().threads;
  result.draws.assign(renderer.draw_measurements().begin(), renderer.draw_measurements().end());
  result.bits = fingerprint(buffer);
  return result;
}

/// Three rectangles side by side and behind each other, and a bitmap.
struct Layers {
  FrameBufferFormat format{.width = 200, .height = 100};
  MeshData near = rectangle(-0.5f, -1, 0.2f, 1, -0.5f);
  MeshData far = whole_window(0.5f);
  std::vector<std::uint8_t> bits = std::vector<std::uint8_t>(8, 0xff);
  Shading shading = Shading::phong;

  void record(Frame& frame) const {
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    frame.set_lights({Light{.position = {0.5f, 0, 2, 1}}});  // deferred: colours differ between pixels
    frame.draw(far.view(), {.shading = shading});
    frame.draw(near.view(), {.shading = shading});
    frame.draw(near.view(), {.shading = shading, .scissor = Rect{0, 0, 0, 0}});
    frame.draw_bitmap({.bits = bits.data(), .width = 8, .height = 8, .x = 156, .y = 40});
  }
};

/// Pixels of each draw in the picture.
std::map<std::uint32_t, std::uint64_t> visible_pixels(const Layers& scene) {
  FrameBuffer buffer(scene.format);
  Frame frame(buffer);
  scene.record(frame);
  std::vector<std::uint32_t> ids(pixel_count(buffer));
  frame.capture({.draw_ids = ids});
  Renderer({.threads = 1}).finish(frame);
  std::map<std::uint32_t, std::uint64_t> pixels;
  for (const std::uint32_t id : ids) ++pixels[id];
  return pixels;
}

template <class Scene>
void expect_consistent(const Scene& scene, RendererOptions options) {
  const MeasuredFrame plain = measured_frame(scene, options);
  EXPECT_TRUE(plain.draws.empty());
  options.debug.count_fragments = options.debug.measure_draws = true;
  const MeasuredFrame measured = measured_frame(scene, options);
  EXPECT_EQ(measured.bits, plain.bits) << "measuring changes no bit";
  std::uint64_t shaded = 0, fragments = 0;
  double seconds = 0;
  for (const DrawMeasurement& draw : measured.draws) {
    shaded += draw.shaded_pixels;
    fragments += draw.fragments;
    for (const double part : {draw.vertex_seconds, draw.binning_seconds, draw.tile_seconds}) {
      EXPECT_GE(part, 0);
      seconds += part;
    }
  }
  EXPECT_EQ(shaded, measured.stats.shaded_pixels);
  EXPECT_EQ(shaded, plain.stats.shaded_pixels);
  EXPECT_EQ(fragments, measured.stats.fragments);
  EXPECT_GT(seconds, 0);
  EXPECT_LE(seconds, measured.seconds * measured.threads);
}

TEST(DrawMeasurements, PixelsAreThoseOfCaptures) {
  const Layers scene;
  std::map<std::uint32_t, std::uint64_t> visible = visible_pixels(scene);
  for (const int tile_size : {32, 64, 128}) {
    const MeasuredFrame measured =
        measured_frame(scene, {.threads = 1, .tile_size = tile_size, .debug = kMeasured});
    ASSERT_EQ(measured.draws.size(), 4u);
    for (std::uint32_t d = 0; d < 4; ++d)
      EXPECT_EQ(measured.draws[d].shaded_pixels,
                visible[d] + (d == 0 ? 64 : 0))  // the bitmap is drawn at once
          << "draw " << d;
    EXPECT_EQ(measured.draws[0].fragments, 200u * 100);
    EXPECT_EQ(measured.draws[1].fragments, 70u * 100);
    EXPECT_EQ(measured.draws[3].fragments, 64u);
  }
}

TEST(DrawMeasurements, CountTilesAndBatches) {
  Layers scene;
  const MeasuredFrame measured = measured_frame(scene, {.threads = 1, .tile_size = 32, .debug = kMeasured});
  ASSERT_EQ(measured.draws.size(), 4u);
  EXPECT_EQ(measured.draws[0].tiles, 7u * 4);
  EXPECT_EQ(measured.draws[1].tiles, 3u * 4);  // columns 1 to 3: pixels 50 to 119
  EXPECT_EQ(measured.draws[3].tiles, 2u);      // pixels 156 to 163
  EXPECT_EQ(measured.draws[0].vertex_batches, 1u);
  EXPECT_EQ(measured.draws[3].vertex_batches, 0u);
  const RandomFrame random;
  const MeasuredFrame many = measured_frame(random, {.threads = 1, .debug = kMeasured});
  EXPECT_EQ(many.draws[0].vertex_batches, (random.triangles.vertex_count() + 63) / 64);
}

TEST(DrawMeasurements, TileCountsOnceWhateverThePolygonModes) {
  struct Outlined : Layers {
    void record(Frame& frame) const {
      frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
      MeshData const* const mesh = &strip;
      frame.draw(mesh->view(), {.front_mode = PolygonMode::line, .back_mode = PolygonMode::point});
    }
    MeshData strip;
  } scene;
  // Front and back faces take turns.
  for (int i = 0; i < 100; ++i) {
    const float x = static_cast<float>(i) * 0.0001f;
    if (i % 2 == 0)
      scene.strip.positions.insert(scene.strip.positions.end(), {x, 0, 0, x, 0.1f, 0, 0.1f, 0, 0});
    else scene.strip.positions.insert(scene.strip.positions.end(), {x, 0, 0, 0.1f, 0, 0, x, 0.1f, 0});
  }
  const MeasuredFrame measured = measured_frame(scene, {.threads = 1, .tile_size = 128, .debug = kMeasured});
  EXPECT_EQ(measured.draws[0].tiles, 1u);
}

TEST(DrawMeasurements, SkippedDrawTakesNothing) {
  const MeasuredFrame measured = measured_frame(Layers(), {.threads = 1, .debug = kMeasured});
  ASSERT_EQ(measured.draws.size(), 4u);
  const DrawMeasurement& skipped = measured.draws[2];
  EXPECT_EQ(skipped.vertex_seconds, 0);
  EXPECT_EQ(skipped.binning_seconds, 0);
  EXPECT_EQ(skipped.tile_seconds, 0);
  EXPECT_EQ(skipped.vertex_batches + skipped.tiles + skipped.shaded_pixels + skipped.fragments, 0u);
  for (const std::size_t d : {0u, 1u, 3u}) EXPECT_GT(measured.draws[d].tile_seconds, 0) << "draw " << d;
}

// The costlier of two draws takes longer, in deferred shading too, where their pixels are shaded in turns.
TEST(DrawMeasurements, CostlierPixelsTakeLonger) {
  struct TwoHalves {
    FrameBufferFormat format{.width = 512, .height = 512};
    MeshData left = rectangle(-1, -1, 0, 1), right = rectangle(0, -1, 1, 1);
    std::vector<Light> lights;
    void record(Frame& frame) const {
      frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
      frame.set_lights(std::span(lights).first(1));
      frame.draw(left.view(), {.shading = Shading::phong});
      frame.set_lights(lights);
      frame.draw(right.view(), {.shading = Shading::phong});
    }
  } scene;
  for (int i = 0; i < 40; ++i) scene.lights.push_back({.position = {0.02f * static_cast<float>(i), 0, 2, 1}});
  for (const int samples : {1, 4}) {
    scene.format.samples = samples;
    double seconds[2] = {1e9, 1e9};  // the least of several frames: other processes may interrupt one
    for (int repetition = 0; repetition < 5; ++repetition) {
      const MeasuredFrame measured = measured_frame(scene, {.threads = 1, .debug = kMeasured});
      EXPECT_EQ(measured.draws[0].shaded_pixels, measured.draws[1].shaded_pixels);
      EXPECT_GE(measured.draws[0].shaded_pixels, 512u * 256);
      for (const std::size_t d : {0u, 1u}) seconds[d] = std::min(seconds[d], measured.draws[d].tile_seconds);
    }
    EXPECT_GT(seconds[1], 2 * seconds[0]);
  }
}

TEST(DrawMeasurements, AddUpAndChangeNoBit) {
  const ThreadLimit limit(4);
  for (const int threads : {1, 2, 4})
    for (const int samples : {1, 4})
      for (const bool defers : {true, false}) {
        SCOPED_TRACE(std::to_string(threads) + " threads, " + std::to_string(samples) + " samples");
        const RendererOptions options{.threads = threads, .debug = {.defer_shading = defers}};
        const FrameBufferFormat format{.width = 330, .height = 210, .samples = samples};
        expect_consistent(RandomFrame(format), options);
        expect_consistent(RandomOperations(format), options);
      }
  for (const InstructionSet set : available_instruction_sets())
    expect_consistent(RandomFrame(), {.threads = 2, .instruction_set = set});
}

TEST(DrawMeasurements, AddUpWhereBinsAreStreamed) {
  for (const int threads : {1, 2})
    expect_consistent(BinOverflowScene({.width = 100, .height = 80}),
                      {.threads = threads, .bin_memory = kMinBinMemory});
}

TEST(DrawMeasurements, AreThoseOfTheLastFrame) {
  const Layers scene;
  FrameBuffer buffer(scene.format);
  Frame frame(buffer);
  bool goes_on = true;
  Renderer renderer({.threads = 1, .debug = kMeasured, .progress = [&](double) { return goes_on; }});
  EXPECT_TRUE(renderer.draw_measurements().empty());
  for (int i = 0; i < 2; ++i) {
    scene.record(frame);
    renderer.finish(frame);
    ASSERT_EQ(renderer.draw_measurements().size(), 4u);
    EXPECT_EQ(renderer.draw_measurements()[0].fragments, 200u * 100);
  }
  frame.draw(scene.near.view());
  renderer.finish(frame);
  EXPECT_EQ(renderer.draw_measurements().size(), 1u);
  goes_on = false;
  scene.record(frame);
  EXPECT_THROW(renderer.finish(frame), Cancelled);
  EXPECT_TRUE(renderer.draw_measurements().empty());
}

}  // namespace
}  // namespace tessera::draw_measurements_test
