// Comparison with an earlier run.
#pragma once

#include <map>
#include <span>
#include <string>

#include "perf/bench/report.h"
#include "perf/bench/run_comparison.h"

namespace tessera::bench {

struct BaselineComparison {
  std::string table;           ///< ratios of medians, earlier/now, with their intervals
  bool has_regressed = false;  ///< whether a row is slower by more than the allowed share
};

class BaselineRun {
 public:
  /// @param file  written by --json
  /// @throws Error if it is not such a report
  explicit BaselineRun(const std::string& file);
  /// Whether the report has any of these workloads.
  bool has_any_of(std::span<const WorkloadEntry* const> entries) const;
  /// @throws Error if the report's frames have another size in pixels; their times cannot be compared
  void require_size(int width, int height) const;
  /// Ratio of a row to that of the same name, see earlier_over_now(); std::nullopt if one has no times.
  std::optional<Ratio> ratio_to(const Row& now) const;
  /// Tabulates Row::earlier_over_now. Names rows without a counterpart, and settings that differ: threads and
  /// instruction set, and, if the file has them, tile size, seed, cores, CPU and compiler.
  ///
  /// @param allowed  share by which a frame may take longer; 0.05 is 5 %
  BaselineComparison compare(const Report& now, double allowed) const;

 private:
  std::string file_;
  int width_ = 0, height_ = 0;
  std::string setting_;  // see setting_text()
  nlohmann::ordered_json report_;
  std::map<std::string, RowTimes> times_;  // by workload name
};

}  // namespace tessera::bench
