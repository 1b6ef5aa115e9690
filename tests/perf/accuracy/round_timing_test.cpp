#include "perf/accuracy/round_timing.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "perf/accuracy/processor_clock.h"

namespace tessera::accuracy::round_timing_test {
namespace {

using ::testing::AllOf;
using ::testing::Ge;
using ::testing::Le;

/// Alternatives that record which of them drew. Each takes longer than a turn must.
struct Recorder {
  std::vector<int> drawn{};
  std::vector<std::function<void()>> draws(int count) {
    std::vector<std::function<void()>> functions;
    for (int i = 0; i < count; ++i)
      functions.emplace_back([this, i] {
        drawn.push_back(i);
        std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(kMinTurnMs + 0.5));
      });
    return functions;
  }
};

TEST(RoundTiming, DefaultOpensAndClosesARoundAndEachAlternativeTakesOneTurn) {
  const bench::HardwareCounters counters;
  Recorder recorder;
  const RoundTimer timer(recorder.draws(5), counters);
  recorder.drawn.clear();
  const Round round = timer.run(1);
  ASSERT_EQ(recorder.drawn.size(), 7u);
  EXPECT_EQ(recorder.drawn.front(), 0);
  EXPECT_EQ(recorder.drawn.back(), 0);
  std::vector<int> between(recorder.drawn.begin() + 1, recorder.drawn.end() - 1);
  std::sort(between.begin(), between.end());
  EXPECT_EQ(between, (std::vector<int>{0, 1, 2, 3, 4}));
  for (const Turn& turn : round.turns) EXPECT_GE(turn.wall_ms, kMinTurnMs);
}

TEST(RoundTiming, OrderFollowsFromTheSeed) {
  const bench::HardwareCounters counters;
  const auto order = [&](std::uint32_t seed) {
    Recorder recorder;
    const RoundTimer timer(recorder.draws(8), counters);
    recorder.drawn.clear();
    timer.run(seed);
    return recorder.drawn;
  };
  EXPECT_EQ(order(3), order(3));
  EXPECT_NE(order(3), order(4));
}

TEST(RoundTiming, ShortFramesAreRepeatedWithinTheirTurn) {
  const bench::HardwareCounters counters;
  int frames = 0;
  const auto draw = [&frames] {
    ++frames;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  };
  const RoundTimer timer({draw}, counters);
  frames = 0;
  const Round round = timer.run(1);
  // Three turns of at most kMinTurnMs / 0.2 ms frames: sleeping takes longer on a busy machine.
  EXPECT_THAT(frames, AllOf(Ge(6), Le(33)));
  EXPECT_GE(round.turns.front().wall_ms, 0.2);
}

TEST(RoundTiming, ClockOfDependentAdditionsIsThatOfAProcessor) {
  // 100,000 additions of one cycle each: between 0.2 and 10 GHz on any machine.
  EXPECT_THAT(cycles_per_ms(), AllOf(Ge(0.2e6), Le(10e6)));
}

TEST(RoundTiming, ProcessorTimeGrowsWithWork) {
  const double before = process_cpu_ms();
  for (int i = 0; i < 20; ++i) cycles_per_ms();
  EXPECT_GT(process_cpu_ms(), before);
}

}  // namespace
}  // namespace tessera::accuracy::round_timing_test
