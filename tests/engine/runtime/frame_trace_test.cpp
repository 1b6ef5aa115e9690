// RendererOptions::trace: the tasks of a frame's workers.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <ranges>
#include <set>

#include "engine/runtime/worker_pool.h"
#include "tests/engine/frame/api_support.h"
#include "tests/engine/runtime/test_executors.h"

namespace tessera::frame_trace_test {
using namespace detail;
namespace {

using namespace test;

constexpr FrameBufferFormat kFormat{.width = 300, .height = 170};

/// Many small triangles in two draws.
struct Scattered {
  std::vector<float> positions;
  Scattered() {
    Random random(5);
    for (int i = 0; i < 3000 * 9; i += 9) {
      const float x = random.between(-1, 1);
      const float y = random.between(-1, 1);
      positions.insert(positions.end(), {x + 0.0f, y + 0.1f, 0.5f});
      positions.insert(positions.end(), {x + 0.1f, y + 0.1f, 0.5f});
      positions.insert(positions.end(), {x + 0.0f, y + 0.0f, 0.5f});
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
  for (int i = 0; i < 2; ++i)
    frame.draw({.positions = mesh.positions}, {.shading = Shading::flat, .lighting = false});
  result.stats = renderer.finish(frame);
  return result;
}

// One task may contain several tiles that have no bin and only show a clear.
void expect_each_pixel_once(const Tasks& tasks) {
  std::vector<int> times(static_cast<std::size_t>(kFormat.width * kFormat.height));
  for (const FrameTask& task : tasks) {
    if (task.stage != FrameStage::tiles) continue;
    EXPECT_GT(task.pixels.width * task.pixels.height, 0);
    for (int y = task.pixels.y; y < task.pixels.y + task.pixels.height; ++y)
      for (int x = task.pixels.x; x < task.pixels.x + task.pixels.width; ++x)
        ++times.at(static_cast<std::size_t>(y * kFormat.width + x));
  }
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), std::ssize(times));
}

void expect_sound_times(const Tasks& tasks, int threads) {
  EXPECT_TRUE(std::is_sorted(tasks.begin(), tasks.end(),
                             [](const FrameTask& a, const FrameTask& b) { return a.begin < b.begin; }));
  std::map<int, double> free_at;
  for (const FrameTask& task : tasks) {
    EXPECT_GE(task.begin, 0);
    EXPECT_GE(task.end, task.begin);
    ASSERT_GE(task.worker, 0);
    ASSERT_LT(task.worker, threads);
    EXPECT_GE(task.begin, free_at[task.worker]) << "a worker runs one task at a time";
    free_at[task.worker] = task.end;
  }
}

void expect_that_passes_wait(const Tasks& tasks) {
  double all_ended = 0;
  double ended = 0;
  int pass = 0;
  for (const FrameTask& task : tasks) {
    ASSERT_GE(task.pass, pass);
    if (task.pass != pass) {
      pass = task.pass;
      all_ended = ended;
    }
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
    EXPECT_EQ(passes_of(frame.tasks, FrameStage::binning), 2)
        << "one pass fills the bins, one counts the entries of each tile";
    EXPECT_EQ(passes_of(frame.tasks, FrameStage::tiles), 1);
    EXPECT_TRUE(std::is_sorted(frame.tasks.begin(), frame.tasks.end(),
                               [](const FrameTask& a, const FrameTask& b) { return a.stage < b.stage; }));
    for (const FrameStage stage : {FrameStage::vertices, FrameStage::binning, FrameStage::tiles})
      EXPECT_TRUE(std::any_of(frame.tasks.begin(), frame.tasks.end(), [&](const FrameTask& task) {
        return task.stage == stage;
      })) << static_cast<int>(stage);
  }
}

TEST(FrameTrace, ReturnsToBinningIfBinMemoryIsSmall) {
  const Traced frame = traced({.threads = 2, .tile_size = 32, .bin_memory = kMinBinMemory});
  expect_sound_times(frame.tasks, 2);
  expect_each_pixel_once(frame.tasks);
  expect_that_passes_wait(frame.tasks);
  EXPECT_GT(passes_of(frame.tasks, FrameStage::tiles), 1);
  const auto is_tile = [](const FrameTask& task) { return task.stage == FrameStage::tiles; };
  const auto first_tile = std::find_if(frame.tasks.begin(), frame.tasks.end(), is_tile);
  EXPECT_TRUE(std::any_of(first_tile, frame.tasks.end(),
                          [](const FrameTask& task) { return task.stage == FrameStage::binning; }));
}

/// Rows of tiles, 0 at the bottom, in the order in which `worker` runs them if the other workers run none. If
/// planes are stored, each row of a narrow frame is one task.
///
/// @param triangles  triangle count per row
std::vector<int> rows_in_order(const std::vector<int>& triangles, int workers, int worker = 0) {
  constexpr int kTile = 32;
  const int height = kTile * static_cast<int>(triangles.size());
  std::vector<float> positions;
  for (int row = 0; row < static_cast<int>(triangles.size()); ++row)
    for (int i = 0; i < triangles[static_cast<std::size_t>(row)]; ++i)
      for (const auto& [x, y] : {std::pair{8, 8}, std::pair{10, 8}, std::pair{8, 10}})
        for (const float value :
             {2.0f * static_cast<float>(x + i % 10 * kTile) / 300 - 1,
              2.0f * static_cast<float>(y + row * kTile) / static_cast<float>(height) - 1, 0.0f})
          positions.push_back(value);
  std::vector<int> rows;
  RendererOptions options{.tile_size = kTile,
                          .executor = std::make_shared<SingleThreadExecutor>(workers, worker)};
  options.trace = [&](std::span<const FrameTask> tasks) {
    for (const FrameTask& task : tasks)
      if (task.stage == FrameStage::tiles) rows.push_back(task.pixels.y / kTile);
  };
  FrameBuffer buffer({.width = 300, .height = height});
  Renderer renderer(options);
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  frame.draw({.positions = positions}, {.lighting = false});
  EXPECT_EQ(renderer.finish(frame).binned, positions.size() / 9);
  return rows;
}

// Rows of similar counts run from top to bottom.
TEST(FrameTrace, TilesWithMostTrianglesComeFirst) {
  const std::vector<int> triangles{3, 41, 0, 900, 5, 3, 1, 100, 40, 2, 700, 7};
  EXPECT_EQ(rows_in_order(triangles, 1), (std::vector{3, 10, 7, 8, 1, 11, 4, 5, 0, 9, 6, 2}));
  EXPECT_EQ(rows_in_order(triangles, 3), (std::vector{3, 8, 4, 9, 10, 1, 5, 6, 7, 11, 0, 2}))
      << "each of the three workers begins with a long row";
}

TEST(FrameTrace, GivesEachWorkerNeighboursOfEachLength) {
  const std::vector<int> triangles{100, 3, 100, 3, 100, 3, 100, 3, 100, 3, 100, 3};
  EXPECT_EQ(rows_in_order(triangles, 2), (std::vector{10, 8, 6, 11, 9, 7, 4, 2, 0, 5, 3, 1}));
  EXPECT_EQ(rows_in_order(triangles, 4), (std::vector{10, 8, 11, 6, 4, 9, 2, 7, 5, 0, 3, 1}))
      << "equal numbers of both lengths if they divide evenly";
}

// Each power of two is a separate load class.
TEST(FrameTrace, DistributesEachLoadClassOverAllWorkers) {
  Random random(17);
  for (int round = 0; round < 40; ++round) {
    const int workers = 1 + static_cast<int>(random.next() % 6);
    const int rows = workers + static_cast<int>(random.next() % 20);
    std::vector<int> triangles;
    std::map<int, int> rows_of_load;
    for (int row = 0; row < rows; ++row) ++rows_of_load[triangles.emplace_back(1 << random.next() % 4)];
    const int worker = static_cast<int>(random.next() % static_cast<unsigned>(workers));
    std::vector<int> order = rows_in_order(triangles, workers, worker);
    ASSERT_EQ(order.size(), triangles.size());
    const auto first = [&](int share) {
      return static_cast<std::ptrdiff_t>(
          first_of_share(order.size(), static_cast<std::size_t>(workers), static_cast<std::size_t>(share)));
    };
    std::rotate(order.begin(), order.end() - first(worker),
                order.end());  // the order starts with the worker's share and wraps around to the one before
    EXPECT_TRUE(std::is_permutation(order.begin(), order.end(), std::views::iota(0, rows).begin()));
    for (int share = 0; share < workers; ++share) {
      std::vector<int> loads;
      for (std::ptrdiff_t i = first(share); i < first(share + 1); ++i)
        loads.push_back(triangles[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])]);
      EXPECT_TRUE(std::ranges::is_sorted(loads, std::greater())) << "share " << share << " of " << workers;
      for (const auto& [load, count] : rows_of_load) {
        const auto had = std::ranges::count(loads, load);
        EXPECT_TRUE(had == count / workers || had == count / workers + 1)
            << had << " of " << count << " rows of " << load << " triangles in share " << share << " of "
            << workers;
      }
    }
  }
}

TEST(FrameTrace, FailedFrameReportsNothing) {
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

TEST(FrameTrace, ExceptionsOfTheListenerReachTheCaller) {
  RendererOptions options{.threads = 2};
  options.trace = [](std::span<const FrameTask>) { throw std::runtime_error("enough"); };
  FrameBuffer buffer(kFormat);
  Renderer renderer(options);
  Frame frame(buffer);
  static constexpr float kTriangle[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  frame.clear({.color = Color{1, 1, 1, 1}});
  frame.draw({.positions = kTriangle});
  EXPECT_THROW(renderer.finish(frame), std::runtime_error);
  EXPECT_EQ(frame.draw_count(), 1u) << "still recorded";
  EXPECT_NE(fingerprint(buffer), fingerprint(FrameBuffer(kFormat))) << "the frame was rendered";
}

}  // namespace
}  // namespace tessera::frame_trace_test
