// What was measured, for people and for programs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "perf/bench/measure.h"
#include "perf/bench/rival_comparisons.h"
#include "perf/bench/scaling.h"

namespace tessera::bench {

/// In 10^9 bytes a second; none where there was no memory for it.
struct MachineBandwidth {
  std::optional<double> l1_stores, frame_stores, frame_copies;
  std::optional<double> tile_stores;  ///< of 64 KiB for each thread: the words of a tile of 128x128 pixels
  std::optional<double> memory_stores, memory_loads, memory_loads_single_core;  ///< of 256 MiB
};

struct Report {
  std::string machine;  ///< lines of "what   value"
  int width = 0, height = 0, threads = 0;
  std::string instruction_set;
  int tile_size = 0;  ///< pixels; 0: chosen by the frame
  std::uint32_t seed = 1;
  std::vector<int> cores{};  ///< that the process was kept on; empty: all it may use
  MachineBandwidth bandwidth;
  std::array<double, 2> core_to_core_ns{};  ///< before and after everything else was measured
  std::vector<Row> rows;
  std::optional<RivalComparisons> rival_comparisons{};
  std::vector<Scaling> scaling{};
  std::optional<CoreModel> core_model{};  ///< that scaling was computed with
  std::optional<Ratio> noise{};           ///< of a workload to itself; empty: it was not measured
  std::string noise_of;                   ///< its name
};

/// "1920x1080, 2 threads, avx512": what medians depend on beside the machine.
std::string setting_text(int width, int height, int threads, const std::string& instruction_set);
inline std::string setting_text(const Report& report) {
  return setting_text(report.width, report.height, report.threads, report.instruction_set);
}

/// One line for a row; the heading of those lines.
std::string table_heading();
std::string table_line(const Row& row);
/// What stands below the table.
std::string table_summary(const Report& report);

nlohmann::ordered_json report_json(const Report& report);
/// A row for each workload, which ends with what all share: size, instruction set and other options, the
/// noise, the machine. Those with a fault have no figures.
std::string report_csv(const Report& report);

}  // namespace tessera::bench
