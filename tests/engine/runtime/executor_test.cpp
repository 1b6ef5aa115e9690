// The picture does not depend on the executor.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <thread>
#include <tuple>
#include <vector>

#include "tests/engine/frame/api_random_frame.h"
#include "tests/engine/runtime/test_executors.h"

namespace tessera::executor_test {
namespace {

using namespace test;

class Idle : public Executor {
 public:
  int workers() const noexcept override { return 2; }
  void run(int, void (*)(void*, int), void*) override {}
};

class Throwing : public Executor {
 public:
  int workers() const noexcept override { return 2; }
  void run(int, void (*)(void*, int), void*) override { throw std::length_error("no threads today"); }
};

/// Also runs a worker index that was not requested.
class StrayWorker : public Executor {
 public:
  explicit StrayWorker(int stray) : stray_(stray) {}
  int workers() const noexcept override { return 4; }
  void run(int count, void (*work)(void*, int), void* context) override {
    work(context, stray_);
    for (int k = 0; k < count; ++k) work(context, k);
  }

 private:
  int stray_;
};

class NoWorkers : public Executor {
 public:
  int workers() const noexcept override { return 0; }
  void run(int, void (*)(void*, int), void*) override {}
};

Fingerprint drawn(RendererOptions options) {
  const RandomFrame scene({.width = 210, .height = 130}, 300);
  Renderer renderer(std::move(options));
  FrameBuffer buffer(scene.format);
  Frame frame(buffer);
  scene.record(frame);
  renderer.finish(frame);
  return fingerprint(buffer);
}

TEST(Executors, GiveTheSameBits) {
  const Fingerprint expected = drawn({.threads = 1});
  EXPECT_EQ(drawn({.executor = serial_executor()}), expected);
  const auto own = std::make_shared<ThreadPerCallExecutor>(3);
  EXPECT_EQ(drawn({.executor = own}), expected);
  EXPECT_GT(own->runs, 2);
  EXPECT_EQ(drawn({.executor = std::make_shared<SingleThreadExecutor>(5, 4)}), expected);
}

/// Small triangles on the left, then clipped ones everywhere, then small lines and points on the right, then
/// a triangle everywhere. Most tiles therefore find entries in a non-contiguous subset of many batches.
struct ManyBatches {
  static constexpr int kSmall = 30000;
  std::vector<float> triangles;
  std::vector<float> lines;
  std::vector<float> points;
  std::vector<float> colors;
  ManyBatches() {
    Random random(11);
    for (int i = 0; i < kSmall; ++i) {
      add(triangles, random.between(-1, -0.1f), random.between(-1, 1), random.between(-1, 1), 3);
      add(lines, random.between(0.1f, 1), random.between(-1, 1), random.between(-1, 1), 2);
      add(points, random.between(0.1f, 1), random.between(-1, 1), random.between(-1, 1), 1);
    }
    for (int i = 0; i < 3 * kSmall; ++i)
      for (int c = 0; c < 4; ++c) colors.push_back(random.between(0, 1));
  }
  static void add(std::vector<float>& positions, float x, float y, float z, int corners) {
    constexpr float kOffset[3][2] = {{0, 0}, {0.04f, 0.01f}, {0.01f, 0.05f}};
    for (int k = 0; k < corners; ++k)
      positions.insert(positions.end(), {x + kOffset[k][0], y + kOffset[k][1], z});
  }
  /// One renderer draws a frame, a smaller one of half of it, and the first one again: no state carries over.
  ///
  /// @param binned  batches of the last frame's first binning pass
  std::vector<Fingerprint> drawn(RendererOptions options, std::size_t& binned) const {
    options.trace = [&](std::span<const FrameTask> tasks) {
      const auto first = std::find_if(tasks.begin(), tasks.end(), [](const FrameTask& task) {
        return task.stage == FrameStage::binning;
      });
      binned = static_cast<std::size_t>(
          std::count_if(first, tasks.end(), [&](const FrameTask& task) { return task.pass == first->pass; }));
    };
    Renderer renderer(std::move(options));
    std::vector<Fingerprint> all;
    for (const auto& [width, height, share] :
         {std::tuple{300, 200, 1}, std::tuple{170, 90, 2}, std::tuple{300, 200, 1}}) {
      FrameBuffer buffer({.width = width, .height = height});
      Frame frame(buffer);
      record(frame, share);
      renderer.finish(frame);
      all.push_back(fingerprint(buffer));
    }
    return all;
  }

 private:
  /// Part `i` of `share` parts of each mesh.
  void record(Frame& frame, std::size_t share) const {
    static constexpr float kClipped[] = {-3, -2, -4,   3, -2, 0.9f, 0, 5,  0.2f,
                                         -2, 3,  0.1f, 2, 3,  3,    0, -4, 0.3f};
    static constexpr float kWide[] = {-0.9f, -0.8f, 0.2f, 0.9f, -0.7f, -0.4f, 0.1f, 0.95f, 0.1f};
    const auto draw = [&](Primitive primitive, std::span<const float> positions) {
      frame.draw({.primitive = primitive,
                  .positions = positions,
                  .colors = std::span(colors).first(positions.size() / 3 * 4)},
                 {.lighting = false});
    };
    const auto part = [&](const std::vector<float>& positions) {
      return std::span<const float>(positions).first(positions.size() / share);
    };
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    draw(Primitive::triangles, part(triangles));
    draw(Primitive::triangles, kClipped);
    draw(Primitive::lines, part(lines));
    draw(Primitive::points, part(points));
    draw(Primitive::triangles, kWide);
  }
};

TEST(Executors, ManyWorkersGiveTheSameBits) {
  const ManyBatches scene;
  std::size_t batches = 0;
  const std::vector<Fingerprint> expected = scene.drawn({.threads = 1, .tile_size = 32}, batches);
  EXPECT_EQ(batches, 4);
  for (const int workers : {3, 17, 32, 64}) {
    EXPECT_TRUE(scene.drawn({.tile_size = 32,
                             .executor = std::make_shared<SingleThreadExecutor>(workers, workers - 1)},
                            batches) == expected)
        << workers;
    EXPECT_EQ(batches, std::min(4 * workers, 3 * ManyBatches::kSmall / 1024)) << workers;
  }
}

TEST(Executors, NumberOfWorkersIsTheNumberOfThreads) {
  EXPECT_EQ(Renderer({.executor = std::make_shared<ThreadPerCallExecutor>(3)}).options().threads, 3);
  EXPECT_EQ(
      Renderer({.threads = 2, .executor = std::make_shared<ThreadPerCallExecutor>(3)}).options().threads, 2);
  EXPECT_EQ(
      Renderer({.threads = 9, .executor = std::make_shared<ThreadPerCallExecutor>(3)}).options().threads, 3);
}

TEST(Executors, FaultyExecutorsAreNamed) {
  EXPECT_THAT(error_of([] { drawn({.executor = std::make_shared<Idle>()}); }).value_or(""),
              testing::HasSubstr("executor returned before its work was done"));
  EXPECT_THAT(error_of([] { Renderer({.executor = std::make_shared<NoWorkers>()}); }).value_or(""),
              testing::HasSubstr("0 workers"));
  EXPECT_THAT(error_of([] { drawn({.executor = std::make_shared<StrayWorker>(4)}); }).value_or(""),
              testing::HasSubstr("executor called work for worker 4, run() must call it for 0 .. "));
  EXPECT_THAT(error_of([] { drawn({.executor = std::make_shared<StrayWorker>(-1)}); }).value_or(""),
              testing::HasSubstr("executor called work for worker -1, run() must call it for 0 .. "));
  EXPECT_THROW(drawn({.executor = std::make_shared<Throwing>()}), std::length_error)
      << "its exceptions pass through";
}

}  // namespace
}  // namespace tessera::executor_test
