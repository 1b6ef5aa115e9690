#include "perf/accuracy/time_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::accuracy::time_figures_test {
namespace {

using ::testing::ElementsAre;

Round round_of(double opening, double closing, std::vector<double> turns) {
  Round round{{.wall_ms = opening}, {.wall_ms = closing}, {}};
  for (const double ms : turns)
    round.turns.push_back({.wall_ms = ms, .cpu_ms = 2 * ms, .million_cycles = 4 * ms});
  return round;
}

TEST(TimeFigures, DividesByTheMeanOfTheDefaultsOfTheRound) {
  const std::vector<ProcessRounds> processes{{round_of(1, 3, {2, 6})}};
  const std::vector<TimeFigures> figures = time_figures(processes);
  EXPECT_EQ(figures[0].ratio.median, 1);
  EXPECT_EQ(figures[1].ratio.median, 3);
  EXPECT_EQ(figures[1].ms.median, 6);
  EXPECT_EQ(figures[1].cpu_ms, 12);
  EXPECT_EQ(figures[1].million_cycles, 24);
}

TEST(TimeFigures, IntervalOf31RoundsIsTheTenthTo22ndValue) {
  std::vector<ProcessRounds> processes(3);
  for (int i = 0; i < 31; ++i)
    processes[static_cast<std::size_t>(i % 3)].push_back(round_of(1, 1, {static_cast<double>(31 - i)}));
  const TimeFigures figures = time_figures(processes).front();
  EXPECT_EQ(figures.ratio.median, 16);
  EXPECT_EQ(figures.ratio.low, 10);
  EXPECT_EQ(figures.ratio.high, 22);
}

TEST(TimeFigures, SpreadIsThatOfTheMediansOfProcesses) {
  const std::vector<ProcessRounds> processes{{round_of(1, 1, {1}), round_of(1, 1, {2}), round_of(1, 1, {9})},
                                             {round_of(1, 1, {5})},
                                             {round_of(1, 1, {3})}};
  const TimeFigures figures = time_figures(processes).front();
  EXPECT_EQ(figures.process_low, 2);
  EXPECT_EQ(figures.process_high, 5);
}

TEST(TimeFigures, TimesAreToldApartOnlyIfIntervalsDoNotOverlap) {
  EXPECT_TRUE(is_told_apart({2, 1.5, 2.5}, {3, 2.6, 4}));
  EXPECT_TRUE(is_told_apart({3, 2.6, 4}, {2, 1.5, 2.5}));
  EXPECT_FALSE(is_told_apart({2, 1.5, 2.6}, {3, 2.6, 4}));
}

TEST(TimeFigures, OnlyFasterPointsWithoutLargerErrorsDominate) {
  const std::vector<CostPoint> points{{1, {1, 0.9, 1.1}},  // dominated by the next two; the third is faster
                                      {1, {0.8, 0.7, 0.85}},  // the same error
                                      {0.9, {0.6, 0.5, 0.65}},
                                      {5, {0.64, 0.6, 0.7}},      // overlaps the third
                                      {0.95, {0.7, 0.66, 0.8}}};  // slower than the third, larger error
  EXPECT_THAT(dominating_points(points), ElementsAre(2, 2, 2, 3, 2));
}

TEST(TimeFigures, PointsWithTouchingIntervalsStayOnTheFront) {
  const std::vector<CostPoint> points{{1, {2, 1.5, 2.5}}, {1, {1.2, 1, 1.5}}};
  EXPECT_THAT(dominating_points(points), ElementsAre(0, 1));
}

}  // namespace
}  // namespace tessera::accuracy::time_figures_test
