// Workloads beside the same ones as rivals draw them, in turns.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "perf/bench/measure.h"
#include "perf/rivals/mesa_workload.h"

namespace tessera::bench {

struct Duel {
  Row ours, rivals;
  double share_off = 0;       ///< of pixels, more than two levels
  bool is_in_mean = true;
  /// Of medians: how many times as long the rival takes; and of the quartiles, at their widest.
  double ratio() const { return rivals.ms.median / ours.ms.median; }
  double low_ratio() const { return rivals.ms.low_quartile / ours.ms.high_quartile; }
  double high_ratio() const { return rivals.ms.high_quartile / ours.ms.low_quartile; }
};

struct Rivalry {
  std::string rival;          ///< its own name for itself
  double finish_ms = 0;       ///< what a frame of one pixel takes it, most of it a copy of the picture
  std::vector<Duel> duels;
};

/// Draws both, and, where each has its right picture and the two are the same, times them in turns. Empty where rivals do not draw it.
std::optional<Duel> duel(const WorkloadEntry& entry, const WorkloadSetup& setup, rivals::MesaDriver driver, const MeasureOptions& options, const HardwareCounters& counters);

std::string rivalry_heading();
std::string rivalry_line(const Duel& duel);
std::string rivalry_ending(const Rivalry& rivalry);
nlohmann::ordered_json rivalry_json(const Rivalry& rivalry);

}  // namespace tessera::bench
