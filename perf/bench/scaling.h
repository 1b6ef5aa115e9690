// How much faster more cores are: measured as far as this machine goes, and beyond it computed from what the
// tasks of frames cost.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "perf/bench/measure.h"
#include "perf/bench/traced_frame.h"

namespace tessera::bench {

/// A machine with many cores like this one's.
struct CoreModel {
  double core_gb_per_second = 0;       ///< 10^9 a second, that one core moves
  int bandwidth_saturating_cores = 8;  ///< so many cores move all that the memory does
  double barrier_seconds = 0;          ///< until all workers have begun a pass
};
/// Measured, on one thread and on all.
CoreModel measure_core_model(int threads);

/// Seconds of a frame on several cores, by what these do.
struct FrameTimeBreakdown {
  double busy = 0;    ///< at tasks, and at taking them; also where workers run that no task tells of, spread
                      ///< over the tasks, or without any over the cores
  double idle = 0;    ///< for the last task of a pass to end and the next pass to begin: no more could be
                      ///< won if passes ran into each other
  double serial = 0;  ///< one core does what is in no task
  double memory = 0;  ///< the memory moves what it could not meanwhile

  double sum() const { return busy + idle + serial + memory; }
};
/// From measure_frame_costs() for as many workers. Of the tasks of a pass each core begins with a share, as
/// WorkerPool cuts them, and goes on to what is left of others'; the taking of each is the frame's mean;
/// passes wait for each other; what no task does is done by one core; and what the frame moves, the memory
/// has to move.
FrameTimeBreakdown predict_frame_time(const TracedFrame& frame, int cores, const CoreModel& model);

struct Scaling {
  std::string workload;
  double one_ms = 0;                                ///< on one thread
  std::vector<std::pair<int, Ratio>> measured{};    ///< threads, and how many times as fast
  std::vector<std::pair<int, double>> predicted{};  ///< cores, and the same
  std::optional<Ratio>
      independent_renderers{};       ///< how many times as fast two renderers are that share nothing, on a
                                     ///< thread each. None: there is one thread, or no memory for both
  FrameTimeBreakdown on_64_cores{};  ///< what its seconds on 64 cores go to
  std::string fault;                 ///< why there are no figures; empty: there are
  std::string not_computed;          ///< why no more is predicted; empty: all is, or there are no figures
};
/// Thread counts that are measured beside 1: all up to 8, and beyond them powers of 2 and the last.
std::vector<int> measured_threads(int threads);
/// Each thread count takes turns with one thread alone; so do two apart.
/// @param threads  the most that are measured
/// @param options  for each count of cores that is computed twice its seconds
Scaling scaling_of(const WorkloadEntry& entry, const WorkloadSetup& setup, int threads,
                   const CoreModel& model, const MeasureOptions& options, const HardwareCounters& counters);

std::string scaling_heading(int threads);
std::string scaling_line(const Scaling& scaling);
nlohmann::ordered_json scaling_json(const std::vector<Scaling>& all);

}  // namespace tessera::bench
