// Workloads beside the same ones as rivals draw them, in turns.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "perf/bench/measure.h"
#include "perf/rivals/mesa_workload.h"

namespace tessera::bench {

struct Comparison {
  Row ours, rivals;
  double mismatch_share = 0;  ///< of pixels, more than two levels
  bool is_in_mean = true;
  /// How many times as long the rival takes.
  Ratio ratio() const { return ratio_of(rivals.ms, ours.ms); }
  /// Of whichever of the two cannot be compared; empty: both can.
  const std::string& fault() const { return !ours.fault.empty() ? ours.fault : rivals.fault; }
};

struct RivalComparisons {
  std::string rival;     ///< its own name for itself
  double finish_ms = 0;  ///< what a frame takes it that changes one pixel
  double finish_pixel_ms =
      0;  ///< and in a window of one pixel: what finish_ms is beyond that is a copy of the picture
  std::vector<Comparison> comparisons;
};

/// Draws both, and, where each has its right picture and the two are the same, times them in turns.
/// @param max_mismatch_share  share of pixels that may differ by more than two levels
Comparison compare_with_rival(Candidate ours, Candidate rival, double max_mismatch_share,
                              const MeasureOptions& options, const HardwareCounters& counters);
/// Of a workload with Mesa. Empty where rivals do not draw it.
std::optional<Comparison> compare_with_rival(const WorkloadEntry& entry, const WorkloadSetup& setup,
                                             rivals::MesaDriver driver, const MeasureOptions& options,
                                             const HardwareCounters& counters);

std::string comparison_heading();
std::string comparison_line(const Comparison& comparison);
std::string comparison_summary(const RivalComparisons& rival_comparisons);
nlohmann::ordered_json comparisons_json(const RivalComparisons& rival_comparisons);

}  // namespace tessera::bench
