// Whether a row is slower than in an earlier run, on machines that are never quiet.
#pragma once

#include <cstddef>

#include "perf/bench/statistics.h"

namespace tessera::bench {

/// Times of a row in one run, in ms, as the report stores them.
struct RowTimes {
  std::size_t frames = 0;
  double median = 0;
  double low = 0;        ///< 5th percentile; the minimum if the report lacks it
  double high = 0;       ///< upper quartile; the 95th percentile if the report lacks the 5th
  double reference = 0;  ///< time of a unit of ReferenceWork; 0: the report lacks it
};

/// Frames that each run needs; with fewer the interval is wider by kFewFramesFactor.
inline constexpr std::size_t kEnoughFrames = 15;
inline constexpr double kFewFramesFactor = 1.5;
/// Drift that is assumed if a report has no reference times.
inline constexpr double kUnknownDrift = 1.25;

/// Ratio of medians earlier/now, above 1 if the row is faster now, and the interval of what the runs permit:
/// - Frames: the interval runs from the earlier 5th percentile over the upper quartile of now, to the earlier
///   upper quartile over the 5th percentile of now. If no frame time depends on the run, all of 15 frames
///   exceed the upper quartile of 15 others with a probability of C(18, 3) / C(30, 15) = 5e-6, whatever the
///   distribution: less than 1 in 1000 over 100 rows, and less still with more frames. Frames within a
///   second depend on each other, so an interval of the medians alone would be too narrow.
/// - Drift: if the reference work is slower in one run, the end of the interval at which that run may have
///   been fast moves by its ratio. It never makes the interval narrower.
Ratio earlier_over_now(const RowTimes& earlier, const RowTimes& now);

/// Whether the whole interval is beyond the limit.
/// @param allowed  share by which a frame may take longer; 0.1 is 10 %
bool is_slower(const Ratio& earlier_over_now, double allowed);

/// Returns "slower" or "faster" if the whole interval is beyond the limit, "same" if it is within the limits,
/// or "unsure" if it crosses one.
const char* verdict_of(const Ratio& earlier_over_now, double allowed);

/// The value of `a` and the interval that holds both: a row that was measured again is slower only if it was
/// slower each time.
Ratio joined(const Ratio& a, const Ratio& b);

}  // namespace tessera::bench
