// Comparison with an earlier run: false alarms and power under noise that is heavy-tailed, that drifts, and
// that differs between runs. All noise is seeded.
#include "perf/bench/run_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace tessera::bench::run_comparison_test {
namespace {

constexpr double kAllowed = 0.1;
constexpr RowTimes kQuiet{.frames = 100, .median = 10, .low = 9.8, .high = 10.2, .reference = 1};

/// A row whose times and reference times are `quiet`'s, each multiplied by a factor.
RowTimes scaled(const RowTimes& quiet, double factor, double reference_factor = 1) {
  return {quiet.frames, factor * quiet.median, factor * quiet.low, factor * quiet.high,
          reference_factor * quiet.reference};
}

TEST(BenchRunComparison, IntervalCombinesOppositeQuantiles) {
  const Ratio ratio = earlier_over_now(kQuiet, scaled(kQuiet, 2));
  EXPECT_DOUBLE_EQ(ratio.value, 0.5);
  EXPECT_DOUBLE_EQ(ratio.low, 9.8 / 20.4);
  EXPECT_DOUBLE_EQ(ratio.high, 10.2 / 19.6);
}

TEST(BenchRunComparison, IsSlowerOnlyIfTheWholeIntervalIs) {
  EXPECT_FALSE(is_slower({.value = 0.5, .low = 0.4, .high = 0.92}, kAllowed));
  EXPECT_TRUE(is_slower({.value = 0.5, .low = 0.4, .high = 0.90}, kAllowed));
  EXPECT_FALSE(is_slower({.value = 0.5, .low = 0.4, .high = 0.90}, 0.2));
}

TEST(BenchRunComparison, DriftOfTheMachineWidensTheEndThatItExplains) {
  const Ratio plain = earlier_over_now(kQuiet, scaled(kQuiet, 1.5));
  const Ratio slow_now = earlier_over_now(kQuiet, scaled(kQuiet, 1.5, 1.4));
  EXPECT_DOUBLE_EQ(slow_now.high, 1.4 * plain.high);
  EXPECT_DOUBLE_EQ(slow_now.low, plain.low);
  const Ratio fast_now = earlier_over_now(kQuiet, scaled(kQuiet, 1.5, 1 / 1.4));
  EXPECT_DOUBLE_EQ(fast_now.high, plain.high);
  EXPECT_DOUBLE_EQ(fast_now.low, plain.low / 1.4);
  EXPECT_EQ(slow_now.value, plain.value) << "the measured ratio stays";
}

TEST(BenchRunComparison, WidensWithoutReferenceAndWithFewFrames) {
  const Ratio plain = earlier_over_now(kQuiet, kQuiet);
  const Ratio old = earlier_over_now(scaled(kQuiet, 1, 0), kQuiet);
  EXPECT_DOUBLE_EQ(old.high, kUnknownDrift * plain.high);
  EXPECT_DOUBLE_EQ(old.low, plain.low / kUnknownDrift);
  RowTimes few = kQuiet;
  few.frames = kEnoughFrames - 1;
  EXPECT_DOUBLE_EQ(earlier_over_now(kQuiet, few).high, kFewFramesFactor * plain.high);
  EXPECT_DOUBLE_EQ(earlier_over_now(few, kQuiet).low, plain.low / kFewFramesFactor);
  few.frames = kEnoughFrames;
  EXPECT_DOUBLE_EQ(earlier_over_now(kQuiet, few).high, plain.high);
}

TEST(BenchRunComparison, JoinsIntervalsOfRepeatedMeasurements) {
  const Ratio joint =
      joined({.value = 0.7, .low = 0.6, .high = 0.8}, {.value = 0.9, .low = 0.5, .high = 0.95});
  EXPECT_EQ(joint.value, 0.7);
  EXPECT_EQ(joint.low, 0.5);
  EXPECT_EQ(joint.high, 0.95);
}

/// How a machine disturbs frames.
struct Noise {
  double spread = 0.03;        ///< standard deviation of each frame, in logarithms
  double tail_share = 0.1;     ///< frames that are delayed by a Pareto-distributed share, exponent 1.5
  double drift = 0.1;          ///< standard deviation of the clock between runs, in logarithms
  double wander = 0.05;        ///< likewise from row to row within a run
  double burst_share = 0.15;   ///< rows during which other programs take up to half of the processor
  double unlike_drift = 0.15;  ///< by how much frames feel drift more or less than the reference work does
};

/// One run on such a machine.
class Machine {
 public:
  Machine(std::uint32_t seed, const Noise& noise)
      : random_(seed), noise_(noise), speed_(noise.drift * normal_(random_)) {}

  RowTimes row(double ms, std::size_t frames) {
    speed_ += noise_.wander * (normal_(random_) - speed_ / 4);
    const bool is_disturbed = uniform_(random_) < noise_.burst_share;
    const double burst = is_disturbed ? 1 + uniform_(random_) : 1;
    // A burst covers all or a part of the second; it doubles the time of a frame at most.
    const double covered = is_disturbed ? uniform_(random_) : 0;
    const double exponent = 1 + noise_.unlike_drift * (2 * uniform_(random_) - 1);
    const auto time_of = [&](double undisturbed, double felt, double place) {
      double time = undisturbed * std::exp(felt * speed_ + noise_.spread * normal_(random_));
      if (place < covered) time *= burst;
      if (uniform_(random_) < noise_.tail_share) time *= 1 + 0.05 * std::pow(uniform_(random_), -1 / 1.5);
      return time;
    };
    const auto statistics = [&](double undisturbed, double felt, std::size_t count) {
      std::vector<double> times;
      for (std::size_t i = 0; i < count; ++i)
        times.push_back(time_of(undisturbed, felt, static_cast<double>(i) / static_cast<double>(count)));
      return statistics_of(times);
    };
    const Statistics frame = statistics(ms, exponent, frames);
    const Statistics reference = statistics(0.06, 1, std::clamp<std::size_t>(frames / 10, 5, 20));
    return {frames, frame.median, frame.percentile_5, frame.high_quartile, reference.median};
  }

 private:
  std::mt19937 random_;
  Noise noise_;
  std::normal_distribution<double> normal_{};
  std::uniform_real_distribution<double> uniform_{};
  double speed_;
};

constexpr int kRows = 100;

/// Whether a run finds a row slower, with up to three confirmations as `tessera bench --compare` has them.
/// @param slowdown  by which the rows take longer now
int slower_rows(std::uint32_t seed, const Noise& noise, std::size_t frames, double slowdown) {
  Machine earlier(2 * seed, noise);
  Machine now(2 * seed + 1, noise);
  int slower = 0;
  for (int row = 0; row < kRows; ++row) {
    const double ms = 0.1 * std::pow(1.07, row);
    const RowTimes before = earlier.row(ms, frames);
    Ratio ratio = earlier_over_now(before, now.row(slowdown * ms, frames));
    for (int again = 0; again < 3 && is_slower(ratio, kAllowed); ++again)
      ratio = joined(ratio, earlier_over_now(before, now.row(slowdown * ms, frames)));
    slower += is_slower(ratio, kAllowed) ? 1 : 0;
  }
  return slower;
}

TEST(BenchRunComparison, HasFewFalseAlarms) {
  constexpr int kRuns = 200;
  for (const std::size_t frames : {15u, 40u, 200u}) {
    int alarms = 0;
    for (std::uint32_t seed = 1; seed <= kRuns; ++seed)
      alarms += slower_rows(seed, {}, frames, 1) > 0 ? 1 : 0;
    EXPECT_LT(alarms, 0.05 * kRuns) << frames << " frames";
  }
}

// Frames of a second depend on each other only through the drift here, so quantiles do not overlap by chance.
TEST(BenchRunComparison, HasNoFalseAlarmWithoutLimitForIndependentFrames) {
  const Noise independent{.drift = 0, .wander = 0, .burst_share = 0, .unlike_drift = 0};
  int alarms = 0;
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    Machine machine(seed, independent);
    for (int row = 0; row < kRows; ++row) {
      const RowTimes before = machine.row(1, kEnoughFrames);
      alarms += is_slower(earlier_over_now(before, machine.row(1, kEnoughFrames)), 0) ? 1 : 0;
    }
  }
  EXPECT_LE(alarms, 2) << "of 10,000 rows";
}

TEST(BenchRunComparison, FindsRowsThatAreSlower) {
  // A machine without bursts: heavy tails, and clocks that differ by 3 %.
  const Noise moderate{.drift = 0.03, .wander = 0.005, .burst_share = 0, .unlike_drift = 0.15};
  for (const std::size_t frames : {15u, 40u, 200u}) {
    int found = 0;
    constexpr int kRuns = 20;
    for (std::uint32_t seed = 1; seed <= kRuns; ++seed) found += slower_rows(seed, moderate, frames, 1.3);
    EXPECT_GT(found, 0.8 * kRuns * kRows) << "30 % slower, " << frames << " frames";
  }
  int found = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) found += slower_rows(seed, {}, 200, 2);
  EXPECT_GT(found, 0.6 * 20 * kRows) << "twice as slow, on a machine that is never quiet";
}

}  // namespace
}  // namespace tessera::bench::run_comparison_test
