// Predicted frame times against schedules computed by hand.
#include "perf/bench/scaling.h"

#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "engine/program/threads/thread_limit.h"

namespace tessera::bench::scaling_test {
using namespace detail;
using namespace program;
namespace {

constexpr CoreModel kFastMemory{.core_gb_per_second = 1e9};

/// Serial tasks, given as (pass, seconds), plus `serial` seconds outside tasks.
TracedFrame frame_of(const std::vector<std::pair<int, double>>& tasks, double serial) {
  TracedFrame frame{.workload = "made up"};
  for (const auto& [pass, seconds] : tasks) {
    frame.tasks.push_back(
        {.stage = FrameStage::tiles, .begin = frame.seconds, .end = frame.seconds + seconds, .pass = pass});
    frame.seconds += seconds;
  }
  frame.seconds += serial;
  return frame;
}
TracedFrame tiles_of(const std::vector<double>& seconds, double serial = 0) {
  std::vector<std::pair<int, double>> tasks;
  for (const double s : seconds) tasks.emplace_back(3, s);
  return frame_of(tasks, serial);
}

TEST(BenchScaling, OneCoreTakesAsLongAsTheFrame) {
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({3, 1, 2}, 0.5), 1, kFastMemory).sum(), 6.5);
  EXPECT_DOUBLE_EQ(
      predict_frame_time(tiles_of({3, 1, 2}, 0.5), 1, {.core_gb_per_second = 1e9, .barrier_seconds = 0.25})
          .sum(),
      6.5)
      << "no barriers";
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({}, 0.5), 64, kFastMemory).sum(), 0.5);
  TracedFrame untraced{.workload = "made up", .seconds = 3, .dispatch_seconds = 2};  // workers without tasks
  EXPECT_DOUBLE_EQ(predict_frame_time(untraced, 1, kFastMemory).sum(), 3);
  EXPECT_DOUBLE_EQ(predict_frame_time(untraced, 4, kFastMemory).sum(), 1.5);
  untraced.untraced_calls = 3;
  EXPECT_DOUBLE_EQ(
      predict_frame_time(untraced, 4, {.core_gb_per_second = 1e9, .barrier_seconds = 0.25}).sum(),
      1.5 + 3 * 0.25);
}

TEST(BenchScaling, CoresStealFromOtherSharesAfterTheirOwn) {
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({1, 1, 1, 1}), 2, kFastMemory).sum(), 2);
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({1, 1, 1, 3}), 2, kFastMemory).sum(), 4)
      << "the long task begins last";
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({3, 1, 1, 1}), 2, kFastMemory).sum(), 3);
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({2, 3, 2, 2, 1}), 3, kFastMemory).sum(), 4);
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({2, 3, 2}), 64, kFastMemory).sum(), 3) << "one core per task";
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({1, 1, 4, 1}), 2, kFastMemory).sum(), 4)
      << "the second core begins with the third task";
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({3, 3, 1, 1}), 2, kFastMemory).sum(), 5)
      << "the second core steals the second task";
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({1, 2, 3, 5, 1, 1}), 3, kFastMemory).sum(), 2 + 5)
      << "the third core is free before the second and takes the fourth task";
}

TEST(BenchScaling, MeasuresAllThreadCountsUpToEightThenPowersOfTwo) {
  EXPECT_EQ(measured_threads(1), std::vector<int>{});
  EXPECT_EQ(measured_threads(2), std::vector{2});
  EXPECT_EQ(measured_threads(8), (std::vector{2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(measured_threads(9), (std::vector{2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(measured_threads(64), (std::vector{2, 3, 4, 5, 6, 7, 8, 16, 32, 64}));
  EXPECT_EQ(measured_threads(96), (std::vector{2, 3, 4, 5, 6, 7, 8, 16, 32, 64, 96}));
}

TEST(BenchScaling, ReportsExceptionsAsFault) {
  WorkloadEntry entry{
      .name = "unmade", .description = "", .make = [](const WorkloadSetup&) -> std::unique_ptr<Workload> {
        throw Error("no such mesh");
      }};
  for (const int threads : {1, 2}) {
    const Scaling scaling = scaling_of(entry, {}, threads, kFastMemory, {.repeats = 1}, HardwareCounters());
    EXPECT_EQ(scaling.fault, "no such mesh") << threads;
    EXPECT_EQ(scaling_line(scaling), "unmade                 not timed: no such mesh\n");
    EXPECT_TRUE(scaling.predicted.empty());
  }
}

/// There is memory for `max_alive` instances. If there are more, draw() throws the engine's out-of-memory
/// error: in the first instance (`first_fails`), or in those beyond `max_alive`.
class Large : public Workload {
 public:
  Large(int& alive, int max_alive, bool first_fails)
      : alive_(alive), max_alive_(max_alive), may_fail_(first_fails ? alive == 0 : alive >= max_alive) {
    ++alive_;
  }
  ~Large() override { --alive_; }
  FrameStats draw() override {
    if (may_fail_ && alive_ > max_alive_) throw Error("Renderer: not enough memory");
    return {};
  }
  std::string fault() override { return {}; }
  const Picture& picture() override { return picture_; }
  FrameWork work(const FrameStats&) const override { return {}; }

 private:
  int& alive_;
  int max_alive_;
  bool may_fail_;
  Picture picture_{1, 1};
};
Scaling scaling_of_large(int max_alive, bool first_fails = false) {
  int alive = 0;
  const WorkloadEntry entry{.name = "large", .description = "", .make = [&](const WorkloadSetup&) {
                              return std::make_unique<Large>(alive, max_alive, first_fails);
                            }};
  const ThreadLimit limit(2);
  const Scaling scaling = scaling_of(
      entry, {}, 2, kFastMemory, {.repeats = 1, .seconds = 0.001, .warm_up_seconds = 0}, HardwareCounters());
  EXPECT_EQ(alive, 0);
  return scaling;
}

TEST(BenchScaling, KeepsMeasurementsIfPredictionRunsOutOfMemory) {
  const Scaling all = scaling_of_large(4);
  EXPECT_EQ(all.fault + all.not_computed, "");
  EXPECT_TRUE(all.independent_renderers.has_value());
  EXPECT_EQ(all.predicted.size(), 7u);
  EXPECT_TRUE(scaling_json({all})[0].contains("independent_renderers"));
  for (const bool first_fails : {false, true}) {
    const Scaling scaling = scaling_of_large(2, first_fails);
    EXPECT_EQ(scaling.fault, "");
    EXPECT_FALSE(scaling.independent_renderers.has_value());
    EXPECT_EQ(scaling.measured.size(), 1u);
    EXPECT_EQ(scaling.not_computed, "Renderer: not enough memory");
    const std::string line = scaling_line(scaling);
    EXPECT_TRUE(
        line.ends_with(")          (no memory)             not computed: Renderer: not enough memory\n"))
        << line;
    const nlohmann::ordered_json json = scaling_json({scaling})[0];
    EXPECT_TRUE(json.contains("measured")) << json;
    EXPECT_EQ(json["not_computed"], "Renderer: not enough memory");
    for (const char* key : {"independent_renderers", "computed", "ms_on_64_cores"})
      EXPECT_FALSE(json.contains(key)) << key;
  }
  EXPECT_EQ(scaling_of_large(1).fault, "Renderer: not enough memory");
}

TEST(BenchScaling, ShowsPredictionsMadeBeforeMemoryRanOut) {
  const Scaling scaling{
      .workload = "made up", .one_ms = 1, .predicted = {{2, 1.5}}, .not_computed = "out of memory"};
  EXPECT_TRUE(scaling_line(scaling).ends_with("    1.50  not computed: out of memory\n"))
      << scaling_line(scaling);
  const nlohmann::ordered_json json = scaling_json({scaling})[0];
  EXPECT_EQ(json["computed"], (nlohmann::ordered_json{{"2", 1.5}}));
  EXPECT_FALSE(json.contains("ms_on_64_cores"));
}

TEST(BenchScaling, RunsSerialWorkOnOneCore) {
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({1, 1, 1, 1}, 2), 4, kFastMemory).sum(), 3);
}

TEST(BenchScaling, SpreadsDispatchOverCores) {
  TracedFrame frame = tiles_of({1, 1, 1, 1}, 2 + 4 * 0.5);
  frame.dispatch_seconds = 4 * 0.5;
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 1, kFastMemory).sum(), 2 + 4 * 1.5);
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 2, kFastMemory).sum(), 2 + 2 * 1.5);
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 4, kFastMemory).sum(), 2 + 1.5);
}

// Barriers separate passes, not stages: a stage may have several passes.
TEST(BenchScaling, SeparatesPassesByBarriers) {
  TracedFrame frame = frame_of({{0, 2}, {0, 1}, {1, 1}, {3, 1}, {3, 4}}, 0);
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 2, kFastMemory).sum(), 2 + 1 + 4);
  CoreModel slow_barriers = kFastMemory;
  slow_barriers.barrier_seconds = 0.25;
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 2, slow_barriers).sum(), 2 + 1 + 4 + 3 * 0.25);
  frame.untraced_calls = 2;
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 2, slow_barriers).sum(), 2 + 1 + 4 + 5 * 0.25)
      << "untraced calls have barriers, too";
}

TEST(BenchScaling, BreaksTimeDownByActivity) {
  TracedFrame frame = frame_of({{0, 2}, {0, 1}, {1, 1}, {3, 1}, {3, 4}}, 2 + 5 * 0.5);
  frame.dispatch_seconds = 5 * 0.5;
  const CoreModel slow_barriers{.core_gb_per_second = 1e9, .barrier_seconds = 0.25};
  const FrameTimeBreakdown seconds = predict_frame_time(frame, 2, slow_barriers);
  EXPECT_DOUBLE_EQ(seconds.busy, (9 + 2.5) / 2);
  EXPECT_DOUBLE_EQ(seconds.idle, (2.5 + 1.5 + 4.5) - seconds.busy + 3 * 0.25)
      << "one core idles during the last task of a pass";
  EXPECT_DOUBLE_EQ(seconds.serial, 2);
  EXPECT_DOUBLE_EQ(seconds.memory, 0);
  frame.work.bytes = 40'000'000'000;
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 2, {.core_gb_per_second = 1, .barrier_seconds = 0.25}).memory,
                   20 - seconds.sum());
}

TEST(BenchScaling, ShowsBreakdownFor64Cores) {
  const Scaling scaling{.workload = "made up",
                        .one_ms = 1,
                        .predicted = {{32, 20}, {64, 32}},
                        .on_64_cores = {.busy = 1, .idle = 2, .serial = 3, .memory = 4}};
  EXPECT_TRUE(scaling_line(scaling).ends_with("    50 %     10 %     20 %     30 %     40 %\n"))
      << scaling_line(scaling);
  EXPECT_EQ(
      scaling_json({scaling})[0]["ms_on_64_cores"],
      (nlohmann::ordered_json{{"busy", 1000.0}, {"idle", 2000.0}, {"serial", 3000.0}, {"memory", 4000.0}}));
}

TEST(BenchScaling, LimitsSpeedByMemoryBandwidth) {
  TracedFrame frame = tiles_of(std::vector<double>(64, 1));
  frame.work.bytes = 32'000'000'000;
  // 8e9 bytes/s at most.
  const CoreModel memory{.core_gb_per_second = 2, .bandwidth_saturating_cores = 4};
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 1, memory).sum(), 64) << "the memory needs 16 s only";
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 8, memory).sum(), 8);
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 64, memory).sum(), 4);
}

}  // namespace
}  // namespace tessera::bench::scaling_test
