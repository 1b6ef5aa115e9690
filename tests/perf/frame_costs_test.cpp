// Costs of frames that are split for many workers but run on one thread.
#include "perf/bench/frame_costs.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "perf/bench/bench_meshes.h"
#include "perf/bench/drawn_workload.h"

namespace tessera::bench::frame_costs_test {
namespace {

WorkloadEntry grid_of(int columns, int draws = 1) {
  return drawn("grid", "", [columns, draws](int, int, std::uint32_t) {
    Drawing drawing{.format = {.width = 256, .height = 256}};
    drawing.meshes.push_back(window_grid(columns, 64));
    drawing.record = [draws](const Drawing& d, Frame& frame) {
      frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
      for (int i = 0; i < draws; ++i) frame.draw(d.meshes.front().view(), {.lighting = false});
    };
    return drawing;
  });
}

TracedFrame cost_of(const WorkloadEntry& entry, int workers) {
  return measure_frame_costs(entry, {.width = 256, .height = 256, .options = {.tile_size = 32}},
                             std::array{workers}, 0)
      .front();
}

// Dispatch is neither task time nor serial time.
TEST(BenchFrameCosts, SplitsTimeIntoTasksDispatchAndSerial) {
  const WorkloadEntry grid = grid_of(64);
  for (const int workers : {1, 2, 64}) {
    const TracedFrame frame = cost_of(grid, workers);
    EXPECT_GT(frame.tasks.size(), 64u) << workers;
    EXPECT_GT(frame.dispatch_seconds, 0) << workers;
    EXPECT_GT(frame.seconds, frame.dispatch_seconds + frame.task_seconds()) << workers;
    const TracedFrame tasks =
        measure_task_costs(grid, {.width = 256, .height = 256, .options = {.tile_size = 32}}, workers);
    EXPECT_DOUBLE_EQ(tasks.seconds, tasks.dispatch_seconds + tasks.task_seconds()) << workers;
  }
}

TEST(BenchFrameCosts, CountsUntracedExecutorCalls) {
  EXPECT_EQ(cost_of(grid_of(64), 2).untraced_calls, 0);
  EXPECT_EQ(cost_of(grid_of(256), 2).untraced_calls, 1) << "recording checks many indices on the workers";
  EXPECT_EQ(cost_of(grid_of(4, 17), 2).untraced_calls, 1) << "planning spreads many draws over the workers";
  const WorkloadEntry onto_planes = drawn("onto", "", [](int, int, std::uint32_t) {
    Drawing drawing{.format = {.width = 256, .height = 256}};
    drawing.initial_frame = [](const Drawing&, Frame& frame) {
      frame.clear({.color = Color{1, 0, 0, 1}, .depth = 1.0});
    };
    drawing.record = [](const Drawing&, Frame&) {};
    return drawing;
  });
  EXPECT_EQ(cost_of(onto_planes, 2).untraced_calls, 0) << "the initial frame does not count";
}

struct Log {
  std::vector<std::pair<int, const void*>> frames;  ///< thread count and workload of each frame
};
class LoggedWorkload : public Workload {
 public:
  LoggedWorkload(Log& log, int threads) : log_(log), threads_(threads) {}
  FrameStats draw() override {
    log_.frames.emplace_back(threads_, this);
    return {};
  }
  std::string fault() override { return {}; }
  const Picture& picture() override { return picture_; }
  FrameWork work(const FrameStats&) const override { return {}; }

 private:
  Log& log_;
  int threads_;
  Picture picture_{1, 1};
};

// Turns, so that a changing clock affects all counts alike.
TEST(BenchFrameCosts, MeasuresWorkerCountsInTurns) {
  Log log;
  const WorkloadEntry entry{.name = "logged", .description = "", .make = [&log](const WorkloadSetup& setup) {
                              return std::make_unique<LoggedWorkload>(log, setup.options.threads);
                            }};
  const std::vector<TracedFrame> costs = measure_frame_costs(entry, {}, std::array{1, 64}, 0);
  ASSERT_EQ(costs.size(), 2u);
  for (const TracedFrame& cost : costs) EXPECT_GE(cost.seconds, 0);
  // The first two frames of each, then three turns of three traced and three untraced frames.
  std::vector<int> threads;
  for (const auto& [count, drawn_by] : log.frames) threads.push_back(count);
  std::vector<int> expected{1, 1, 64, 64};
  for (int turn = 0; turn < 3; ++turn)
    for (const int count : {1, 64}) expected.insert(expected.end(), 6, count);
  EXPECT_EQ(threads, expected);
  EXPECT_EQ(log.frames[4].second, log.frames[0].second);
  EXPECT_EQ(log.frames[16].second, log.frames[0].second) << "the same workload in each turn";
  EXPECT_NE(log.frames[7].second, log.frames[0].second);
  const auto start = std::chrono::steady_clock::now();
  measure_frame_costs(entry, {}, std::array{1, 64}, 0.1);
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(100))
      << "turns last for the given time";
}

/// Frame i reports tasks[i] tasks; later frames as many as the last element.
class TaskCountWorkload : public Workload {
 public:
  TaskCountWorkload(const WorkloadSetup& setup, std::vector<std::size_t> tasks)
      : trace_(setup.options.trace), tasks_(std::move(tasks)) {}
  FrameStats draw() override {
    trace_(std::vector<FrameTask>(tasks_[std::min(drawn_++, tasks_.size() - 1)], {.begin = 0, .end = 1e-9}));
    return {};
  }
  std::string fault() override { return {}; }
  const Picture& picture() override { return picture_; }
  FrameWork work(const FrameStats&) const override { return {}; }

 private:
  std::function<void(std::span<const FrameTask>)> trace_;
  std::vector<std::size_t> tasks_;
  std::size_t drawn_ = 0;
  Picture picture_{1, 1};
};
std::size_t tasks_of(const std::vector<std::size_t>& tasks) {
  return measure_task_costs({.name = "traced",
                             .description = "",
                             .make =
                                 [&](const WorkloadSetup& setup) {
                                   return std::make_unique<TaskCountWorkload>(setup, tasks);
                                 }},
                            {}, 2)
      .tasks.size();
}

TEST(BenchFrameCosts, FollowsTaskCountOfLaterFrames) {
  EXPECT_EQ(tasks_of({5}), 5u);
  EXPECT_EQ(tasks_of({7, 7, 7, 7, 7, 5}), 5u) << "fewer passes after bins have grown";
  EXPECT_EQ(tasks_of({5, 5, 5, 5, 5, 7}), 7u);
  EXPECT_EQ(tasks_of({5, 5, 5, 5, 5, 0}), 5u) << "no memory for the trace of a frame";
  EXPECT_EQ(tasks_of({0}), 0u);
}

}  // namespace
}  // namespace tessera::bench::frame_costs_test
