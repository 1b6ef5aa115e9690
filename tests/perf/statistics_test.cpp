// Order statistics against values counted by hand.
#include "perf/bench/statistics.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace tessera::bench::statistics_test {
namespace {

TEST(BenchStatistics, SingleValueIsEveryStatistic) {
  const Statistics s = statistics_of({3});
  for (const double value : {s.median, s.low_quartile, s.high_quartile, s.percentile_5, s.percentile_95,
                             s.percentile_99, s.min, s.median_ci_low, s.median_ci_high})
    EXPECT_EQ(value, 3);
}

TEST(BenchStatistics, ReturnsMeasuredValuesIndependentOfOrder) {
  const Statistics five = statistics_of({50, 10, 40, 20, 30});
  EXPECT_EQ(five.min, 10);
  EXPECT_EQ(five.low_quartile, 20) << "two of five do not exceed it; one would be too few";
  EXPECT_EQ(five.median, 30);
  EXPECT_EQ(five.high_quartile, 40);
  EXPECT_EQ(five.percentile_95, 50);
  EXPECT_EQ(statistics_of({4, 1, 3, 2}).median, 2) << "not the mean of two";
}

TEST(BenchStatistics, ComputesPercentiles) {
  std::vector<double> values;
  for (int i = 0; i < 200; ++i)
    values.push_back((i * 73 + 5) % 200 + 1);  // 1 to 200, each once: 73 and 200 are coprime
  const Statistics s = statistics_of(values);
  EXPECT_EQ(s.min, 1);
  EXPECT_EQ(s.low_quartile, 50);
  EXPECT_EQ(s.median, 100);
  EXPECT_EQ(s.high_quartile, 150);
  EXPECT_EQ(s.percentile_5, 10);
  EXPECT_EQ(s.percentile_95, 190);
  EXPECT_EQ(s.percentile_99, 198);
}

// Exponential distribution with median log 2: the interval must contain it with the stated probability.
TEST(BenchStatistics, ConfidenceIntervalContainsTheMedianInNineteenOfTwentyCases) {
  std::mt19937 random(7);
  std::exponential_distribution<double> exponential(1);
  for (const std::size_t count : {6u, 15u, 50u, 201u}) {
    int hits = 0;
    constexpr int kRuns = 4000;
    for (int run = 0; run < kRuns; ++run) {
      std::vector<double> values(count);
      for (double& value : values) value = exponential(random);
      const Statistics s = statistics_of(values);
      EXPECT_LE(s.median_ci_low, s.median);
      EXPECT_GE(s.median_ci_high, s.median);
      hits += s.median_ci_low <= std::log(2.0) && std::log(2.0) <= s.median_ci_high ? 1 : 0;
    }
    EXPECT_GT(hits, 0.94 * kRuns) << count;
    EXPECT_LT(hits, 0.985 * kRuns) << count << ": too wide";
  }
}

TEST(BenchStatistics, RatioCombinesBothIntervals) {
  const Statistics a{.median = 6, .median_ci_low = 5, .median_ci_high = 8};
  const Statistics b{.median = 3, .median_ci_low = 2, .median_ci_high = 4};
  const Ratio ratio = ratio_of(a, b);
  EXPECT_EQ(ratio.value, 2);
  EXPECT_EQ(ratio.low, 1.25);
  EXPECT_EQ(ratio.high, 4);
}

}  // namespace
}  // namespace tessera::bench::statistics_test
