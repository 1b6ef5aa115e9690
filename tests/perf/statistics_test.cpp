// What is said of measurements, against values that are counted off by hand.
#include "perf/bench/statistics.h"

#include <gtest/gtest.h>

namespace tessera::bench {
namespace {

TEST(BenchStatistics, OfOneValueAreThatValue) {
  const Statistics s = statistics_of({3});
  for (const double value : {s.median, s.low_quartile, s.high_quartile, s.percentile_95, s.percentile_99, s.least}) EXPECT_EQ(value, 3);
}

TEST(BenchStatistics, AreMeasuredValuesInWhateverOrderTheyCome) {
  const Statistics five = statistics_of({50, 10, 40, 20, 30});
  EXPECT_EQ(five.least, 10);
  EXPECT_EQ(five.low_quartile, 20) << "two of five are not above it, one would be too few";
  EXPECT_EQ(five.median, 30);
  EXPECT_EQ(five.high_quartile, 40);
  EXPECT_EQ(five.percentile_95, 50);
  EXPECT_EQ(statistics_of({4, 1, 3, 2}).median, 2) << "not the mean of two";
}

TEST(BenchStatistics, HavePercentilesOfAHundred) {
  std::vector<double> values;
  for (int i = 0; i < 200; ++i) values.push_back((i * 73 + 5) % 200 + 1);  // each of 1 .. 200 once: 73 and 200 have no common factor
  const Statistics s = statistics_of(values);
  EXPECT_EQ(s.least, 1);
  EXPECT_EQ(s.low_quartile, 50);
  EXPECT_EQ(s.median, 100);
  EXPECT_EQ(s.high_quartile, 150);
  EXPECT_EQ(s.percentile_95, 190);
  EXPECT_EQ(s.percentile_99, 198);
}

}  // namespace
}  // namespace tessera::bench
