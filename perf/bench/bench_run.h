// A run of tessera bench: measures workloads and prints the tables.
#pragma once

#include <string>
#include <vector>

#include "perf/bench/baseline_run.h"
#include "perf/bench/bench_options.h"
#include "perf/bench/counters.h"
#include "perf/bench/report.h"

namespace tessera::bench {

/// Size, renderer and seed of the workloads.
WorkloadSetup setup_of(const BenchOptions& options);

/// Measures workloads and prints each line as soon as it is known.
class BenchRun {
 public:
  explicit BenchRun(const BenchOptions& options);

  /// @param earlier  null: no comparison
  void run(const std::vector<const WorkloadEntry*>& entries, const BaselineRun* earlier);
  /// Number of frames, and sizes other than that of the setting.
  std::string times_text() const;
  void show(const std::string& text) const;
  /// Whether the standard output carries JSON or CSV.
  bool is_silent() const { return options_.json_file == "-" || options_.csv_file == "-"; }
  const Report& report() const { return report_; }
  bool has_fault() const { return has_fault_; }

 private:
  void run_alone(const std::vector<const WorkloadEntry*>& entries, const BaselineRun* earlier);
  /// Measures again what looks slower than earlier: a burst of other work seldom returns. Each row at most
  /// kMaxConfirmations times, after the others.
  void confirm_regressions(const std::vector<const WorkloadEntry*>& entries, const BaselineRun& earlier);
  void run_with_rivals(const std::vector<const WorkloadEntry*>& entries);
  void run_on_more_threads(const std::vector<const WorkloadEntry*>& entries);
  void measure_machine();
  void measure_noise(const WorkloadEntry& entry);
  /// Times the row's workload once more, in turns with its baseline, if it has one.
  void compare_with_baseline(const WorkloadEntry& entry, Row& row);
  /// Options for a row that later runs may be compared with.
  MeasureOptions alone() const;
  Candidate candidate_of(const WorkloadEntry& entry) const;

  const BenchOptions& options_;
  WorkloadSetup setup_;
  Report report_{};
  HardwareCounters counters_{};
  bool has_fault_ = false;
};

}  // namespace tessera::bench
