// Figures of a setting's time over all rounds, and which settings are worth their time.
#pragma once

#include <span>
#include <vector>

#include "perf/accuracy/round_timing.h"

namespace tessera::accuracy {

/// A median and the interval of ranks around it: 10th to 22nd of 31 values, which holds the true median with
/// 97 %.
struct Interval {
  double median = 0, low = 0, high = 0;
};

struct TimeFigures {
  /// Time / mean of the round's two defaults, over the rounds of all processes.
  Interval ratio;
  Interval ms;                ///< time of a frame
  double cpu_ms = 0;          ///< median of the threads' processor time per frame
  double million_cycles = 0;  ///< median per frame
  /// Smallest and largest of the processes' own medians of the ratio.
  double process_low = 0, process_high = 0;
};

/// The rounds of one process.
using ProcessRounds = std::vector<Round>;

/// Figures of each alternative, in order.
/// @param processes  each with at least one round of the same alternatives
std::vector<TimeFigures> time_figures(std::span<const ProcessRounds> processes);

/// Whether two times are told apart: their intervals do not overlap.
bool is_told_apart(const Interval& a, const Interval& b);

/// A setting as a point of error and time.
struct CostPoint {
  double error = 0;
  Interval time;
};

/// For each point: the point that proves that it is off the Pareto front, or its own index if it is on the
/// front.
/// - A point is off the front only if another has no larger error and its interval lies wholly below.
/// - Of several such points the fastest is returned.
std::vector<std::size_t> dominating_points(std::span<const CostPoint> points);

}  // namespace tessera::accuracy
