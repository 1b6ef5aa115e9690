// Speed-up on more cores: measured up to the thread count of the run, predicted for 2 to 128 cores from the
// cost of tasks.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "perf/bench/measure.h"
#include "perf/bench/traced_frame.h"

namespace tessera::bench {

/// Model of a machine with many cores, each like one of this machine's.
struct CoreModel {
  double core_gb_per_second = 0;       ///< copy rate of one core, 10^9 bytes/s
  int bandwidth_saturating_cores = 8;  ///< cores needed to saturate memory bandwidth
  double barrier_seconds = 0;          ///< time until all workers have begun a pass
};
/// Measures the copy rate on one thread and the barrier on all.
CoreModel measure_core_model(int threads);

/// Seconds of a frame on several cores, by activity.
struct FrameTimeBreakdown {
  /// Tasks and their dispatch. Untraced work of workers is spread over the tasks, or over the cores if there
  /// are no tasks.
  double busy = 0;
  /// Waiting for the last task of a pass and for the next pass to begin: the most that could be gained by
  /// overlapping passes.
  double idle = 0;
  double serial = 0;  ///< work outside tasks, on one core
  double memory = 0;  ///< memory transfers that do not overlap the other parts

  double sum() const { return busy + idle + serial + memory; }
};
/// List scheduling of tasks, with costs from measure_frame_costs() for `cores` workers:
/// - In each pass a core starts with its share of the tasks, as WorkerPool divides them, and then steals from
///   other shares.
/// - Dispatch of a task costs the mean of the frame.
/// - Passes are separated by barriers; work outside tasks runs on one core.
/// - The frame's traffic is limited by the memory bandwidth of the model.
FrameTimeBreakdown predict_frame_time(const TracedFrame& frame, int cores, const CoreModel& model);

struct Scaling {
  std::string workload;
  double one_ms = 0;                                ///< on one thread
  std::vector<std::pair<int, Ratio>> measured{};    ///< thread count, speed-up
  std::vector<std::pair<int, double>> predicted{};  ///< core count, speed-up
  /// Speed-up of two renderers that share nothing, one thread each.
  /// std::nullopt if only one thread is measured, or there is no memory for both.
  std::optional<Ratio> independent_renderers{};
  FrameTimeBreakdown on_64_cores{};
  std::string fault;  ///< why nothing was measured; empty: no fault
  /// Why the prediction is incomplete; empty: it is complete, or `fault` is set.
  std::string not_computed;
};
/// Thread counts that are compared to one thread: all up to 8, then powers of two, and the last.
std::vector<int> measured_threads(int threads);
/// Each thread count, and the two independent renderers, take turns with one thread.
/// @param threads  largest thread count to measure
/// @param options  each predicted core count takes twice `options.seconds`
Scaling scaling_of(const WorkloadEntry& entry, const WorkloadSetup& setup, int threads,
                   const CoreModel& model, const MeasureOptions& options, const HardwareCounters& counters);

std::string scaling_heading(int threads);
/// Meaning of the columns, one line each.
std::string scaling_columns();
std::string scaling_line(const Scaling& scaling);
nlohmann::ordered_json scaling_json(const std::vector<Scaling>& all);

}  // namespace tessera::bench
