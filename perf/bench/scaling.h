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
  double core_bytes = 0;         ///< 10^9 a second, that one core moves
  int most_cores_of_memory = 8;  ///< so many cores move all that the memory does
  double barrier_seconds = 0;    ///< until all workers have begun a pass
};
/// Measured, on one thread and on all.
CoreModel measure_core_model(int threads);

/// Seconds of a frame on several cores, by what these do.
struct CoreSeconds {
  double working = 0;  ///< at tasks, and at taking them; also where workers run that no task tells of, spread
                       ///< over the tasks, or without any over the cores
  double waiting = 0;  ///< for the last task of a pass to end and the next pass to begin: no more could be
                       ///< won if passes ran into each other
  double alone = 0;    ///< one core does what is in no task
  double memory = 0;   ///< the memory moves what it could not meanwhile

  double sum() const { return working + waiting + alone + memory; }
};
/// From costs_of_frames() for as many workers. Of the tasks of a pass each core begins with a share, as
/// Parallel cuts them, and goes on to what is left of others'; the taking of each is the frame's mean; passes
/// wait for each other; what no task does is done by one core; and what the frame moves, the memory has to
/// move.
CoreSeconds seconds_on(const TracedFrame& frame, int cores, const CoreModel& model);

struct Scaling {
  std::string workload;
  double one_ms = 0;                                ///< on one thread
  std::vector<std::pair<int, Ratio>> measured{};    ///< threads, and how many times as fast
  std::vector<std::pair<int, double>> predicted{};  ///< cores, and the same
  std::optional<Ratio> two_apart{};  ///< how many times as fast two renderers are that share nothing, on a
                                     ///< thread each. None: there is one thread, or no memory for both
  CoreSeconds of_64{};               ///< what its seconds on 64 cores go to
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
