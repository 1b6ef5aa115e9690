// Times all settings in several processes, which run in order and share the rounds.
#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "engine/program/scene/scene.h"
#include "perf/accuracy/processor_clock.h"
#include "perf/accuracy/settings.h"
#include "perf/accuracy/time_figures.h"

namespace tessera::accuracy {

/// Processes, and how many rounds each takes: 31 are split into 11, 10 and 10.
inline constexpr int kProcesses = 3;
int rounds_of_process(int rounds, int process);

/// A scene and its settings, as the processes time it.
struct TimedScene {
  program::Scene scene;
  std::vector<Setting> settings;
};

struct TimingPlan {
  std::vector<int> threads;  ///< numbers of threads that are timed separately
  InstructionSet instruction_set = InstructionSet::automatic;
  int rounds = 31;
};

/// Measurements of one process.
struct ProcessTimes {
  /// [number of threads][scene]: rounds.
  std::vector<std::vector<ProcessRounds>> rounds;
  Disturbance disturbance{};
  bool has_counters = false;
};

/// Measures the share of one process and writes it to `out` as text, line by line. Call from the new process.
/// Returns false after Ctrl-C.
bool time_in_this_process(std::vector<TimedScene>& scenes, const TimingPlan& plan, int process,
                          std::FILE* out);

/// Runs this program again with the given arguments and reads what time_in_this_process() writes to its
/// stdout.
/// @param progress  called after each round with the number of rounds done by this process; false ends it
/// @throws Error if the process fails; Cancelled after Ctrl-C, or if `progress` returns false
ProcessTimes times_of_process(const std::vector<std::string>& arguments,
                              const std::vector<TimedScene>& scenes, const TimingPlan& plan,
                              const std::function<bool(int)>& progress);

}  // namespace tessera::accuracy
