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
  double share_off = 0;  ///< of pixels, more than two levels
  bool is_in_mean = true;
  /// How many times as long the rival takes.
  Ratio ratio() const { return ratio_of(rivals.ms, ours.ms); }
  /// Of whichever of the two cannot be compared; empty: both can.
  const std::string& fault() const { return !ours.fault.empty() ? ours.fault : rivals.fault; }
};

struct Rivalry {
  std::string rival;     ///< its own name for itself
  double finish_ms = 0;  ///< what a frame takes it that changes one pixel
  double finish_pixel_ms =
      0;  ///< and in a window of one pixel: what finish_ms is beyond that is a copy of the picture
  std::vector<Duel> duels;
};

/// Draws both, and, where each has its right picture and the two are the same, times them in turns.
/// @param tolerated  share of pixels that may differ by more than two levels
Duel duel(Candidate ours, Candidate rival, double tolerated, const MeasureOptions& options,
          const HardwareCounters& counters);
/// Of a workload with Mesa. Empty where rivals do not draw it.
std::optional<Duel> duel(const WorkloadEntry& entry, const WorkloadSetup& setup, rivals::MesaDriver driver,
                         const MeasureOptions& options, const HardwareCounters& counters);

std::string rivalry_heading();
std::string rivalry_line(const Duel& duel);
std::string rivalry_ending(const Rivalry& rivalry);
nlohmann::ordered_json rivalry_json(const Rivalry& rivalry);

}  // namespace tessera::bench
