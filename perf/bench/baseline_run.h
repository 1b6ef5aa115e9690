// An earlier run beside this one.
#pragma once

#include <map>
#include <span>
#include <string>

#include "perf/bench/report.h"

namespace tessera::bench {

struct BaselineComparison {
  std::string table;           ///< ratios of medians, earlier to now: above 1 is faster
  bool has_regressed = false;  ///< in a row by more than was allowed
};

class BaselineRun {
 public:
  /// @param file  what --json wrote then. @throws Error where it is no such report
  explicit BaselineRun(const std::string& file);
  /// Whether it has any of these workloads: else there is nothing to compare.
  bool has_any_of(std::span<const WorkloadEntry* const> entries) const;
  /// @throws Error where its frames, in pixels, were of another size: what they cost says nothing of these
  void require_size(int width, int height) const;
  /// Rows without a counterpart are left out, and named, and so is what else is not as it was: threads,
  /// instruction set; tile size, seed, cores, machine and compiler, if the file tells.
  ///
  /// @param allowed  share by which a median may be longer, 0.05: 5 %
  BaselineComparison compare(const Report& now, double allowed) const;

 private:
  std::string file_;
  int width_ = 0, height_ = 0;
  std::string setting_;  // as setting_text() has it
  nlohmann::ordered_json report_;
  std::map<std::string, double> medians_;  // by the workload's name, in ms
};

}  // namespace tessera::bench
