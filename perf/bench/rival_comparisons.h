// Workloads measured in turns with a rival renderer that draws the same picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "perf/bench/measure.h"
#include "perf/rivals/mesa_workload.h"

namespace tessera::bench {

struct Comparison {
  Row ours;
  Row rivals;
  double mismatch_share = 0;  ///< share of pixels that differ by more than two levels
  bool is_in_mean = true;
  /// Time of the rival over ours: above 1, ours is faster.
  Ratio ratio() const { return ratio_of(rivals.ms, ours.ms); }
  /// Why the two cannot be compared; empty: they can.
  const std::string& fault() const { return !ours.fault.empty() ? ours.fault : rivals.fault; }
};

struct RivalComparisons {
  std::string rival;     ///< the rival's name and version, as it reports them
  double finish_ms = 0;  ///< rival's time for a frame that changes one pixel
  /// Rival's time for such a frame in a window of one pixel. The difference to `finish_ms` is the rival's
  /// copy of the picture.
  double finish_pixel_ms = 0;
  std::vector<Comparison> comparisons;
};

/// Draws both. If both pictures are right and match, times them in turns.
/// @param max_mismatch_share  share of pixels that may differ by more than two levels
Comparison compare_with_rival(Candidate ours, Candidate rival, double max_mismatch_share,
                              const MeasureOptions& options, const HardwareCounters& counters);
/// Compares a workload with Mesa; std::nullopt if rivals cannot draw it.
std::optional<Comparison> compare_with_rival(const WorkloadEntry& entry, const WorkloadSetup& setup,
                                             rivals::MesaDriver driver, const MeasureOptions& options,
                                             const HardwareCounters& counters);

std::string comparison_heading();
/// Meaning of the columns, one line each.
std::string comparison_columns();
std::string comparison_line(const Comparison& comparison);
std::string comparison_summary(const RivalComparisons& rival_comparisons);
nlohmann::ordered_json comparisons_json(const RivalComparisons& rival_comparisons);

}  // namespace tessera::bench
