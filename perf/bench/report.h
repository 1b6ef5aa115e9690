// Results as a table, as JSON and as CSV.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "perf/bench/machine_bandwidth.h"
#include "perf/bench/measure.h"
#include "perf/bench/rival_comparisons.h"
#include "perf/bench/scaling.h"

namespace tessera::bench {

struct Report {
  std::string machine;  ///< lines of "property   value"
  int width = 0, height = 0;
  int threads = 0;
  std::string instruction_set;
  int tile_size = 0;  ///< pixels; 0: chosen per frame
  std::uint32_t seed = 1;
  std::vector<int> cores{};  ///< logical CPUs that the process is bound to; empty: all allowed ones
  bool has_machine = false;  ///< whether `bandwidth` and latency were measured (--machine)
  MachineBandwidth bandwidth;
  std::array<double, 2> core_to_core_ns{};  ///< before and after all other measurements
  std::vector<Row> rows;
  std::optional<RivalComparisons> rival_comparisons{};
  std::vector<Scaling> scaling{};
  std::optional<CoreModel> core_model{};  ///< used for the predictions in `scaling`
  std::optional<Ratio> noise{};           ///< ratio of a workload to itself; std::nullopt: not measured
  std::string noise_of;                   ///< name of that workload
};

/// "1920x1080, 2 threads, avx512": the settings that medians depend on, apart from the machine.
std::string setting_text(int width, int height, int threads, const std::string& instruction_set);
inline std::string setting_text(const Report& report) {
  return setting_text(report.width, report.height, report.threads, report.instruction_set);
}

std::string table_heading();
std::string table_line(const Row& row);
/// Meaning of the columns, one line each.
std::string table_columns();
/// Lines below the table: drift, noise, bandwidth, counters, ratios to baselines and shares of rooflines.
std::string table_summary(const Report& report);

nlohmann::ordered_json report_json(const Report& report);
/// One row per workload. Columns common to all rows come last: settings, noise and machine.
/// Rows with a fault have no figures.
std::string report_csv(const Report& report);

}  // namespace tessera::bench
