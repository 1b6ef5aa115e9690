// Renderers, frames and frame buffers: used repeatedly, on separate threads, and moved, without growing.
#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "engine/program/threads/thread_limit.h"
#include "tests/engine/frame/api_random_frame.h"

#if defined(__linux__)
#include <unistd.h>
#endif

namespace tessera::renderer_reuse_test {
using namespace detail;
using namespace program;
namespace {

using namespace test;

Fingerprint picture(Renderer& renderer, const RandomFrame& random) {
  FrameBuffer buffer(random.format);
  Frame frame(buffer);
  random.record(frame);
  renderer.finish(frame);
  return fingerprint(buffer);
}
RandomFrame frame_of(int width, int height, ColorMode mode = ColorMode::rgb, int bits = 24,
                     DepthFormat depth = DepthFormat::unorm24) {
  return RandomFrame(
      {.width = width, .height = height, .color_mode = mode, .color_bits = bits, .depth = depth}, 300);
}

TEST(RendererReuse, GiveTheSameBitsOnSeparateThreads) {
  const ThreadLimit limit(4);
  const RandomFrame wide = frame_of(200, 90);
  const RandomFrame high = frame_of(90, 170, ColorMode::index, 8, DepthFormat::float32);
  Renderer alone({.threads = 1});
  const Fingerprint expected[2] = {picture(alone, wide), picture(alone, high)};
  int wrong[4] = {};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      Renderer own({.threads = 1 + t % 3});
      for (int round = 0; round < 10; ++round) {
        const int which = (t + round) % 2;
        if (picture(own, which == 0 ? wide : high) != expected[which]) ++wrong[t];
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const int count : wrong) EXPECT_EQ(count, 0);
}

TEST(RendererReuse, DrawFramesOfDifferentSizes) {
  const RandomFrame frames[] = {
      frame_of(300, 200), frame_of(1, 1), frame_of(700, 20, ColorMode::rgb, 8, DepthFormat::none),
      frame_of(33, 400, ColorMode::index, 4), frame_of(64, 64, ColorMode::rgb, 1, DepthFormat::unorm32)};
  Renderer kept({.threads = 2});
  for (int round = 0; round < 2; ++round)
    for (const RandomFrame& random : frames) {
      Renderer fresh({.threads = 1});
      EXPECT_EQ(picture(kept, random), picture(fresh, random))
          << random.format.width << " x " << random.format.height;
    }
}

TEST(RendererReuse, DrawIntoManyBuffersInTurn) {
  const RandomFrame random = frame_of(80, 60);
  Renderer renderer({.threads = 1});
  FrameBuffer first(random.format), second(random.format);
  Frame to_first(first);
  Frame to_second(second);
  random.record(to_first);
  random.record(to_second);
  renderer.finish(to_second);
  EXPECT_NE(fingerprint(first), fingerprint(second)) << "only the second was finished";
  renderer.finish(to_first);
  EXPECT_EQ(fingerprint(first), fingerprint(second));
}

TEST(RendererReuse, ReportTheirOptions) {
  const ThreadLimit limit(6);
  EXPECT_EQ(Renderer({.threads = 5}).options().threads, 5);
  EXPECT_GE(Renderer().options().threads, 1);
  EXPECT_EQ(Renderer().options().instruction_set, available_instruction_sets().front());
  EXPECT_EQ(Renderer({.instruction_set = InstructionSet::scalar}).options().instruction_set,
            InstructionSet::scalar);
  EXPECT_EQ(Renderer({.tile_size = 32}).options().tile_size, 32);
  EXPECT_FALSE(Renderer({.debug = {.defer_shading = false}}).options().debug.defer_shading);
}

TEST(MovedObjects, FrameStaysValidIfItsFrameBufferIsMoved) {
  const RandomFrame random = frame_of(80, 60);
  Renderer renderer({.threads = 1});
  const Fingerprint expected = picture(renderer, random);
  FrameBuffer buffer(random.format);
  Frame frame(buffer);
  random.record(frame);
  FrameBuffer moved(std::move(buffer));
  std::vector<FrameBuffer> many;
  many.push_back(std::move(moved));
  many.reserve(many.capacity() + 10);
  EXPECT_FALSE(frame.explain(0).empty());
  renderer.finish(frame);
  EXPECT_EQ(fingerprint(many[0]), expected);
  random.record(frame);
  renderer.finish(frame);
  EXPECT_EQ(fingerprint(many[0]), expected);
}

TEST(MovedObjects, AssignedFrameBufferKeepsItsPixelsAndFrames) {
  const RandomFrame random = frame_of(80, 60);
  Renderer renderer({.threads = 1});
  FrameBuffer source(random.format);
  FrameBuffer target({.width = 3, .height = 3});
  Frame frame(source);
  random.record(frame);
  renderer.finish(frame);
  const Fingerprint drawn = fingerprint(source);
  target = std::move(source);
  EXPECT_EQ(target.format().width, 80);
  EXPECT_EQ(fingerprint(target), drawn);
  frame.clear({.color = Color{1, 1, 1, 1}});
  renderer.finish(frame);
  EXPECT_EQ(packed_colors(target)[0], 0xffffffu);
}

TEST(MovedObjects, FrameKeepsItsRecording) {
  const RandomFrame random = frame_of(80, 60);
  Renderer renderer({.threads = 1});
  const Fingerprint expected = picture(renderer, random);
  FrameBuffer buffer(random.format);
  FrameBuffer unused({.width = 2, .height = 2});
  Frame first(buffer);
  Frame last(unused);
  random.record(first);
  const std::size_t draws = first.draw_count();
  Frame second(std::move(first));
  last = std::move(second);
  EXPECT_EQ(last.draw_count(), draws);
  renderer.finish(last);
  EXPECT_EQ(fingerprint(buffer), expected);
}

TEST(MovedObjects, RendererWorksAfterAMove) {
  const RandomFrame random = frame_of(80, 60);
  Renderer first({.threads = 2, .tile_size = 32});
  const Fingerprint expected = picture(first, random);
  Renderer second(std::move(first));
  EXPECT_EQ(picture(second, random), expected);
  Renderer third({.threads = 1});
  third = std::move(second);
  EXPECT_EQ(third.options().tile_size, 32);
  EXPECT_EQ(picture(third, random), expected);
}

TEST(FrameReuse, KeepCameraLightsAndModelForTheNextRecording) {
  FrameBuffer buffer({.width = 40, .height = 30});
  Renderer renderer({.threads = 1});
  const MeshData mesh = rectangle(-1, -1, 1, 1, -2);
  Frame frame(buffer);
  Camera camera;
  camera.projection = perspective(40, 4.0 / 3, 1, 10);
  Light light;
  light.diffuse = {1, 0, 0, 1};
  frame.set_camera(camera);
  frame.set_lights({&light, 1});
  frame.set_light_model({.ambient = {0, 0, 0.5f, 1}});
  std::vector<Fingerprint> prints;
  for (int round = 0; round < 2; ++round) {
    frame.clear({.color = Color{}, .depth = 1.0});
    frame.draw(mesh.view(), {});
    renderer.finish(frame);
    prints.push_back(fingerprint(buffer));
  }
  EXPECT_EQ(prints[0], prints[1]);
  Frame fresh(buffer);
  fresh.clear({.color = Color{}, .depth = 1.0});
  fresh.draw(mesh.view(), {});
  renderer.finish(fresh);
  EXPECT_NE(fingerprint(buffer), prints[0]) << "a new frame has the default camera and lights";
}

#if defined(__linux__) && !defined(TESSERA_CHECKED)  // sanitizers delay the reuse of freed memory
std::size_t resident_bytes() {
  std::size_t whole = 0;
  std::size_t resident = 0;
  std::ifstream("/proc/self/statm") >> whole >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST(RendererMemory, DoesNotGrowOverEqualFrames) {
  const RandomFrame random = frame_of(300, 200);
  Renderer renderer({.threads = 2});
  const auto frames = [&](int count) {
    for (int i = 0; i < count; ++i) {
      FrameBuffer buffer(random.format);
      Image image(buffer);
      Frame frame(buffer);
      random.record(frame);
      if (i % 2 == 0) frame.keep({Buffer::color, Buffer::depth});
      renderer.finish(frame, image.target());
    }
  };
  frames(20);
  const std::size_t before = resident_bytes();
  frames(200);
  EXPECT_LT(resident_bytes(), before + (std::size_t{4} << 20));
}
#endif

}  // namespace
}  // namespace tessera::renderer_reuse_test
