// Frames on cores that are not there, against schedules made by hand.
#include "perf/bench/scaling.h"

#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "engine/program/threads/thread_limit.h"

namespace tessera::bench {
using namespace detail;
using namespace program;
namespace {

constexpr CoreModel kFastMemory{.core_gb_per_second = 1e9};

/// Tasks of these passes and seconds, one after the other, and some of no task.
TracedFrame frame_of(const std::vector<std::pair<int, double>>& tasks, double between) {
  TracedFrame frame{.workload = "made up"};
  for (const auto& [pass, seconds] : tasks) {
    frame.tasks.push_back(
        {.stage = FrameStage::tiles, .begin = frame.seconds, .end = frame.seconds + seconds, .pass = pass});
    frame.seconds += seconds;
  }
  frame.seconds += between;
  return frame;
}
TracedFrame tiles_of(const std::vector<double>& seconds, double between = 0) {
  std::vector<std::pair<int, double>> tasks;
  for (const double s : seconds) tasks.emplace_back(3, s);
  return frame_of(tasks, between);
}

TEST(BenchScaling, OneCoreTakesAsLongAsTheFrame) {
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({3, 1, 2}, 0.5), 1, kFastMemory).sum(), 6.5);
  EXPECT_DOUBLE_EQ(
      predict_frame_time(tiles_of({3, 1, 2}, 0.5), 1, {.core_gb_per_second = 1e9, .barrier_seconds = 0.25})
          .sum(),
      6.5)
      << "it waits for nobody";
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({}, 0.5), 64, kFastMemory).sum(), 0.5);
  TracedFrame untold{.workload = "made up", .seconds = 3, .dispatch_seconds = 2};  // of workers without tasks
  EXPECT_DOUBLE_EQ(predict_frame_time(untold, 1, kFastMemory).sum(), 3);
  EXPECT_DOUBLE_EQ(predict_frame_time(untold, 4, kFastMemory).sum(), 1.5);
  untold.untraced_calls = 3;
  EXPECT_DOUBLE_EQ(predict_frame_time(untold, 4, {.core_gb_per_second = 1e9, .barrier_seconds = 0.25}).sum(),
                   1.5 + 3 * 0.25);
}

TEST(BenchScaling, CoresBeginWithTheirSharesAndGoOnToOthers) {
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({1, 1, 1, 1}), 2, kFastMemory).sum(), 2);
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({1, 1, 1, 3}), 2, kFastMemory).sum(), 4)
      << "what is long begins last";
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({3, 1, 1, 1}), 2, kFastMemory).sum(), 3);
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({2, 3, 2, 2, 1}), 3, kFastMemory).sum(), 4);
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({2, 3, 2}), 64, kFastMemory).sum(), 3) << "the longest";
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({1, 1, 4, 1}), 2, kFastMemory).sum(), 4)
      << "the second core begins with the third task";
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({3, 3, 1, 1}), 2, kFastMemory).sum(), 5)
      << "and comes back to the second";
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({1, 2, 3, 5, 1, 1}), 3, kFastMemory).sum(), 2 + 5)
      << "the third is free before the second, and so the fourth task is its";
}

TEST(BenchScaling, MeasuresEachOfFewThreadsAndDoublesBeyond) {
  EXPECT_EQ(measured_threads(1), std::vector<int>{});
  EXPECT_EQ(measured_threads(2), std::vector{2});
  EXPECT_EQ(measured_threads(8), (std::vector{2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(measured_threads(9), (std::vector{2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(measured_threads(64), (std::vector{2, 3, 4, 5, 6, 7, 8, 16, 32, 64}));
  EXPECT_EQ(measured_threads(96), (std::vector{2, 3, 4, 5, 6, 7, 8, 16, 32, 64, 96}));
}

TEST(BenchScaling, WhatStopsAWorkloadIsItsFault) {
  WorkloadEntry entry{
      .name = "unmade", .what = "", .make = [](const WorkloadSetup&) -> std::unique_ptr<Workload> {
        throw Error("no such mesh");
      }};
  for (const int threads : {1, 2}) {
    const Scaling scaling = scaling_of(entry, {}, threads, kFastMemory, {.repeats = 1}, HardwareCounters());
    EXPECT_EQ(scaling.fault, "no such mesh") << threads;
    EXPECT_EQ(scaling_line(scaling), "unmade                 not timed: no such mesh\n");
    EXPECT_TRUE(scaling.predicted.empty());
  }
}

/// Of which there is memory for no more than `most` at once; the engine says so in its own words. Who asks
/// for more is the first of them, or those beyond.
class Large : public Workload {
 public:
  Large(int& alive, int most, bool first_asks)
      : alive_(alive), most_(most), asks_(first_asks ? alive == 0 : alive >= most) {
    ++alive_;
  }
  ~Large() override { --alive_; }
  FrameStats draw() override {
    if (asks_ && alive_ > most_) throw Error("Renderer: not enough memory");
    return {};
  }
  std::string fault() override { return {}; }
  const Picture& picture() override { return picture_; }
  FrameWork work(const FrameStats&) const override { return {}; }

 private:
  int& alive_;
  int most_;
  bool asks_;
  Picture picture_{1, 1};
};
Scaling scaling_of_large(int most, bool first_asks = false) {
  int alive = 0;
  const WorkloadEntry entry{.name = "large", .what = "", .make = [&](const WorkloadSetup&) {
                              return std::make_unique<Large>(alive, most, first_asks);
                            }};
  const ThreadLimit limit(2);
  const Scaling scaling = scaling_of(
      entry, {}, 2, kFastMemory, {.repeats = 1, .seconds = 0.001, .warm_up_seconds = 0}, HardwareCounters());
  EXPECT_EQ(alive, 0);
  return scaling;
}

TEST(BenchScaling, WhatWasMeasuredStandsWithoutMemoryForTheRest) {
  const Scaling all = scaling_of_large(4);
  EXPECT_EQ(all.fault + all.not_computed, "");
  EXPECT_TRUE(all.independent_renderers.has_value());
  EXPECT_EQ(all.predicted.size(), 7u);
  EXPECT_TRUE(scaling_json({all})[0].contains("independent_renderers"));
  for (const auto& [most, first_asks] : {std::pair(2, false), {2, true}}) {
    const Scaling scaling = scaling_of_large(most, first_asks);
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
  EXPECT_EQ(scaling_of_large(1).fault, "Renderer: not enough memory") << "nothing is known then";
}

TEST(BenchScaling, TellsWhatWasComputedBeforeTheMemoryEnded) {
  const Scaling scaling{
      .workload = "made up", .one_ms = 1, .predicted = {{2, 1.5}}, .not_computed = "out of memory"};
  EXPECT_TRUE(scaling_line(scaling).ends_with("    1.50  not computed: out of memory\n"))
      << scaling_line(scaling);
  const nlohmann::ordered_json json = scaling_json({scaling})[0];
  EXPECT_EQ(json["computed"], (nlohmann::ordered_json{{"2", 1.5}}));
  EXPECT_FALSE(json.contains("ms_on_64_cores"));
}

TEST(BenchScaling, WhatIsInNoTaskStaysOneCores) {
  EXPECT_DOUBLE_EQ(predict_frame_time(tiles_of({1, 1, 1, 1}, 2), 4, kFastMemory).sum(), 3);
}

TEST(BenchScaling, CoresTakeTheirOwnTasks) {
  TracedFrame frame = tiles_of({1, 1, 1, 1}, 2 + 4 * 0.5);
  frame.dispatch_seconds = 4 * 0.5;
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 1, kFastMemory).sum(), 2 + 4 * 1.5);
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 2, kFastMemory).sum(), 2 + 2 * 1.5);
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 4, kFastMemory).sum(), 2 + 1.5);
}

// Whatever stage they are of: one may have several.
TEST(BenchScaling, PassesWaitForEachOther) {
  TracedFrame frame = frame_of({{0, 2}, {0, 1}, {1, 1}, {3, 1}, {3, 4}}, 0);
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 2, kFastMemory).sum(), 2 + 1 + 4);
  CoreModel slow_to_begin = kFastMemory;
  slow_to_begin.barrier_seconds = 0.25;
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 2, slow_to_begin).sum(), 2 + 1 + 4 + 3 * 0.25);
  frame.untraced_calls = 2;
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 2, slow_to_begin).sum(), 2 + 1 + 4 + 5 * 0.25)
      << "workers wait there, too";
}

TEST(BenchScaling, SecondsGoToWorkWaitsOneCoreAndMemory) {
  TracedFrame frame = frame_of({{0, 2}, {0, 1}, {1, 1}, {3, 1}, {3, 4}}, 2 + 5 * 0.5);
  frame.dispatch_seconds = 5 * 0.5;
  const CoreModel slow_to_begin{.core_gb_per_second = 1e9, .barrier_seconds = 0.25};
  const FrameTimeBreakdown seconds = predict_frame_time(frame, 2, slow_to_begin);
  EXPECT_DOUBLE_EQ(seconds.busy, (9 + 2.5) / 2);
  EXPECT_DOUBLE_EQ(seconds.idle, (2.5 + 1.5 + 4.5) - seconds.busy + 3 * 0.25)
      << "one idles while the other does the last of a pass";
  EXPECT_DOUBLE_EQ(seconds.serial, 2);
  EXPECT_DOUBLE_EQ(seconds.memory, 0);
  frame.work.bytes = 40'000'000'000;
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 2, {.core_gb_per_second = 1, .barrier_seconds = 0.25}).memory,
                   20 - seconds.sum());
}

TEST(BenchScaling, TellsWhatTheTimeOf64CoresGoesTo) {
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

TEST(BenchScaling, MemoryGivesTheBytesNoFaster) {
  TracedFrame frame = tiles_of(std::vector<double>(64, 1));
  frame.work.bytes = 32'000'000'000;
  const CoreModel memory{.core_gb_per_second = 2,
                         .bandwidth_saturating_cores = 4};  // 8e9 bytes a second at most
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 1, memory).sum(), 64) << "memory would do it in 16";
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 8, memory).sum(), 8);
  EXPECT_DOUBLE_EQ(predict_frame_time(frame, 64, memory).sum(), 4);
}

}  // namespace
}  // namespace tessera::bench
