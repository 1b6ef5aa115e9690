// RendererOptions::trace: what the workers of a frame did.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/engine/api_support.h"

namespace tessera {
namespace {

using namespace test;

constexpr FrameBufferFormat kFormat{.width = 300, .height = 170};

/// Many small triangles, in two draws.
struct Scattered {
  std::vector<float> positions;
  Scattered() {
    Random random(5);
    for (int i = 0; i < 3000 * 9; i += 9) {
      const float x = random.between(-1, 1), y = random.between(-1, 1);
      for (const float offset : {0.0f, 0.1f, 0.0f, 0.1f, 0.1f, 0.0f, 0.0f, 0.0f, 0.1f}) positions.push_back(positions.size() % 3 == 0 ? x + offset : positions.size() % 3 == 1 ? y + offset : 0.5f);
    }
  }
};

using Tasks = std::vector<FrameTask>;

struct Traced {
  Tasks tasks;
  int calls = 0;
  FrameStats stats;
};
Traced traced(RendererOptions options) {
  static const Scattered mesh;
  Traced result;
  options.trace = [&](std::span<const FrameTask> tasks) {
    ++result.calls;
    result.tasks.assign(tasks.begin(), tasks.end());
  };
  FrameBuffer buffer(kFormat);
  Renderer renderer(options);
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  for (int i = 0; i < 2; ++i) frame.draw({.positions = mesh.positions}, {.shading = Shading::flat, .lighting = false});
  result.stats = renderer.finish(frame);
  return result;
}

// Of tiles without a bin, which a clear alone fills, several may be one task.
void expect_each_pixel_once(const Tasks& tasks) {
  std::vector<int> times(static_cast<std::size_t>(kFormat.width * kFormat.height));
  for (const FrameTask& task : tasks) {
    if (task.stage != FrameStage::tiles) continue;
    EXPECT_GT(task.pixels.width * task.pixels.height, 0);
    for (int y = task.pixels.y; y < task.pixels.y + task.pixels.height; ++y)
      for (int x = task.pixels.x; x < task.pixels.x + task.pixels.width; ++x) ++times.at(static_cast<std::size_t>(y * kFormat.width + x));
  }
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), std::ssize(times));
}

void expect_sound_times(const Tasks& tasks, int threads) {
  EXPECT_TRUE(std::is_sorted(tasks.begin(), tasks.end(), [](const FrameTask& a, const FrameTask& b) { return a.begin < b.begin; }));
  std::map<int, double> free_at;
  for (const FrameTask& task : tasks) {
    EXPECT_GE(task.begin, 0);
    EXPECT_GE(task.end, task.begin);
    ASSERT_GE(task.worker, 0);
    ASSERT_LT(task.worker, threads);
    EXPECT_GE(task.begin, free_at[task.worker]) << "nobody does two things at once";
    free_at[task.worker] = task.end;
  }
}

void expect_that_passes_wait(const Tasks& tasks) {
  double all_ended = 0, ended = 0;
  int pass = 0;
  for (const FrameTask& task : tasks) {
    ASSERT_GE(task.pass, pass);
    if (task.pass != pass) pass = task.pass, all_ended = ended;
    EXPECT_GE(task.begin, all_ended) << "pass " << pass;
    ended = std::max(ended, task.end);
  }
}

int passes_of(const Tasks& tasks, FrameStage stage) {
  std::set<int> passes;
  for (const FrameTask& task : tasks)
    if (task.stage == stage) passes.insert(task.pass);
  return static_cast<int>(passes.size());
}

TEST(FrameTrace, HoldsEachStageAndEachPixel) {
  for (const int threads : {1, 2, 3}) {
    const Traced frame = traced({.threads = threads, .tile_size = 32});
    EXPECT_EQ(frame.calls, 1);
    expect_sound_times(frame.tasks, threads);
    expect_each_pixel_once(frame.tasks);
    expect_that_passes_wait(frame.tasks);
    EXPECT_EQ(passes_of(frame.tasks, FrameStage::binning), 2) << "triangles go into bins, and what tiles have in theirs is counted";
    EXPECT_EQ(passes_of(frame.tasks, FrameStage::tiles), 1);
    EXPECT_TRUE(std::is_sorted(frame.tasks.begin(), frame.tasks.end(), [](const FrameTask& a, const FrameTask& b) { return a.stage < b.stage; }));
    for (const FrameStage stage : {FrameStage::vertices, FrameStage::binning, FrameStage::tiles})
      EXPECT_TRUE(std::any_of(frame.tasks.begin(), frame.tasks.end(), [&](const FrameTask& task) { return task.stage == stage; })) << static_cast<int>(stage);
  }
}

TEST(FrameTrace, GoesBackToBinningWhereBinsAreFew) {
  const Traced frame = traced({.threads = 2, .tile_size = 32, .bin_memory = kLeastBinMemory});
  expect_sound_times(frame.tasks, 2);
  expect_each_pixel_once(frame.tasks);
  expect_that_passes_wait(frame.tasks);
  EXPECT_GT(passes_of(frame.tasks, FrameStage::tiles), 1);
  const auto is_tile = [](const FrameTask& task) { return task.stage == FrameStage::tiles; };
  const auto first_tile = std::find_if(frame.tasks.begin(), frame.tasks.end(), is_tile);
  EXPECT_TRUE(std::any_of(first_tile, frame.tasks.end(), [](const FrameTask& task) { return task.stage == FrameStage::binning; }));
}

// Rows of tiles whose planes are stored are tasks. Those with nearly as many go from the top down.
TEST(FrameTrace, BeginsWithTheTilesThatHoldMost) {
  constexpr int kTile = 32, kRows = 12, kHeight = kTile * kRows;
  constexpr int kTriangles[kRows] = {3, 41, 0, 900, 5, 3, 1, 100, 40, 2, 700, 7};
  std::vector<float> positions;
  for (int row = 0; row < kRows; ++row)
    for (int i = 0; i < kTriangles[row]; ++i)
      for (const auto& [x, y] : {std::pair{8, 8}, std::pair{10, 8}, std::pair{8, 10}})
        for (const float value : {2.0f * static_cast<float>(x + i % 10 * kTile) / 300 - 1, 2.0f * static_cast<float>(y + row * kTile) / kHeight - 1, 0.0f}) positions.push_back(value);
  std::vector<int> rows;
  RendererOptions options{.threads = 1, .tile_size = kTile};
  options.trace = [&](std::span<const FrameTask> tasks) {
    for (const FrameTask& task : tasks)
      if (task.stage == FrameStage::tiles) rows.push_back(task.pixels.y / kTile);
  };
  FrameBuffer buffer({.width = 300, .height = kHeight});
  Renderer renderer(options);
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  frame.draw({.positions = positions}, {.lighting = false});
  EXPECT_EQ(renderer.finish(frame).binned, positions.size() / 9);
  EXPECT_EQ(rows, (std::vector{3, 10, 7, 8, 1, 11, 4, 5, 0, 9, 6, 2}));
}

TEST(FrameTrace, OfAFrameThatFailsIsNotTold) {
  static constexpr float kTriangle[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  int calls = 0;
  RendererOptions options{.threads = 1, .progress = [](double) { return false; }};
  options.trace = [&](std::span<const FrameTask>) { ++calls; };
  FrameBuffer buffer(kFormat);
  Renderer renderer(options);
  Frame frame(buffer);
  frame.draw({.positions = kTriangle});
  EXPECT_THROW(renderer.finish(frame), Cancelled);
  EXPECT_EQ(calls, 0);
}

TEST(FrameTrace, LetsOutWhatItsListenerThrows) {
  RendererOptions options{.threads = 2};
  options.trace = [](std::span<const FrameTask>) { throw std::runtime_error("enough"); };
  FrameBuffer buffer(kFormat);
  Renderer renderer(options);
  Frame frame(buffer);
  static constexpr float kTriangle[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  frame.clear({.color = Color{1, 1, 1, 1}});
  frame.draw({.positions = kTriangle});
  EXPECT_THROW(renderer.finish(frame), std::runtime_error);
  EXPECT_EQ(frame.draw_count(), 1u) << "it is still recorded";
  EXPECT_NE(fingerprint(buffer), fingerprint(FrameBuffer(kFormat))) << "the frame was rendered";
}

}  // namespace
}  // namespace tessera
