#include "perf/bench/report.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "perf/bench/columns.h"
#include "perf/bench/text.h"

namespace tessera::bench {
namespace {

constexpr double kMiB = 1 << 20;

/// Rate in 10^9 bytes/s that is compared with the roofline.
double achieved_bandwidth(const Row& row) {
  return static_cast<double>(row.work.roofline_bytes) / row.ms.median * 1e-6;
}

/// Working memory of the first frame per triangle, if triangles make up most of it.
std::optional<double> bytes_per_triangle(const Row& row) {
  constexpr std::uint64_t kMinTriangles = 100000;
  return row.work.triangles >= kMinTriangles
             ? std::optional(static_cast<double>(row.working_bytes) / static_cast<double>(row.work.triangles))
             : std::nullopt;
}

const char* name_of(Roofline roofline) {
  switch (roofline) {
    case Roofline::l1_stores: return "L1 stores";
    case Roofline::tile_stores: return "tile stores";
    case Roofline::memory_stores: return "memory stores";
    case Roofline::memory_copies: return "memory copies";
    case Roofline::memory_loads: return "memory loads";
    case Roofline::none: break;
  }
  return "";
}

/// A count per frame in millions per second.
double millions(std::uint64_t count, const Row& row) {
  return static_cast<double>(count) / row.ms.median * 1e-3;
}

struct Metric {
  const char* key;
  std::optional<double> value;  // std::nullopt: not measured or not applicable
};
std::vector<Metric> metrics_of(const Row& row) {
  std::vector<Metric> metrics{{"median_ms", row.ms.median},
                              {"low_quartile_ms", row.ms.low_quartile},
                              {"high_quartile_ms", row.ms.high_quartile},
                              {"percentile_95_ms", row.ms.percentile_95},
                              {"percentile_99_ms", row.ms.percentile_99},
                              {"min_ms", row.ms.min},
                              {"cold_ms", row.cold_ms},
                              {"megapixels_per_second", millions(row.work.pixels, row)},
                              {"megatriangles_per_second", millions(row.work.triangles, row)},
                              {"megavertices_per_second", millions(row.work.vertices, row)},
                              {"megafragments_per_second", millions(row.work.fragments, row)},
                              {"gigabytes_per_second", millions(row.work.bytes, row) * 1e-3},
                              {"ns_per_pixel", 1e6 * row.ms.median / static_cast<double>(row.work.pixels)}};
  metrics.push_back({"percentile_5_ms", row.ms.percentile_5});
  metrics.push_back({"reference_ms", row.reference_ms > 0 ? std::optional(row.reference_ms) : std::nullopt});
  metrics.push_back({"peak_mebibytes", static_cast<double>(row.peak_bytes) / kMiB});
  metrics.push_back({"bytes_per_triangle", bytes_per_triangle(row)});
  metrics.push_back({"roofline_traffic_gigabytes_per_second",
                     row.roofline > 0 ? std::optional(achieved_bandwidth(row)) : std::nullopt});
  metrics.push_back(
      {"roofline_gigabytes_per_second", row.roofline > 0 ? std::optional(row.roofline) : std::nullopt});
  metrics.push_back({"share_of_roofline", row.roofline > 0
                                              ? std::optional(achieved_bandwidth(row) / row.roofline)
                                              : std::nullopt});
  metrics.push_back({"tile_bytes", row.l1_stores > 0 ? std::optional(static_cast<double>(row.work.tile_bytes))
                                                     : std::nullopt});
  metrics.push_back(
      {"l1_stores_gigabytes_per_second", row.l1_stores > 0 ? std::optional(row.l1_stores) : std::nullopt});
  metrics.push_back({"share_of_l1_stores", row.l1_stores > 0
                                               ? std::optional(achieved_bandwidth(row) / row.l1_stores)
                                               : std::nullopt});
  const auto to_baseline = [&row](double Ratio::*part) {
    return row.to_baseline ? std::optional(row.to_baseline->ratio.*part) : std::nullopt;
  };
  metrics.push_back({"ratio_to_baseline", to_baseline(&Ratio::value)});
  metrics.push_back({"low_ratio_to_baseline", to_baseline(&Ratio::low)});
  metrics.push_back({"high_ratio_to_baseline", to_baseline(&Ratio::high)});
  const auto to_earlier = [&row](double Ratio::*part) {
    return row.earlier_over_now ? std::optional((*row.earlier_over_now).*part) : std::nullopt;
  };
  metrics.push_back({"earlier_over_now", to_earlier(&Ratio::value)});
  metrics.push_back({"low_earlier_over_now", to_earlier(&Ratio::low)});
  metrics.push_back({"high_earlier_over_now", to_earlier(&Ratio::high)});
  metrics.push_back(
      {"cycles", row.counts ? std::optional(static_cast<double>(row.counts->cycles)) : std::nullopt});
  metrics.push_back({"instructions", row.counts ? std::optional(static_cast<double>(row.counts->instructions))
                                                : std::nullopt});
  return metrics;
}

std::vector<Metric> metrics_of(const MachineBandwidth& bandwidth) {
  return {{"l1_stores", bandwidth.l1_stores},
          {"tile_stores", bandwidth.tile_stores},
          {"frame_stores", bandwidth.frame_stores},
          {"frame_copies", bandwidth.frame_copies},
          {"memory_stores", bandwidth.memory_stores},
          {"memory_loads", bandwidth.memory_loads},
          {"memory_loads_single_core", bandwidth.memory_loads_single_core}};
}

/// The properties of the machine and their values.
std::vector<std::pair<std::string, std::string>> facts_of(const std::string& machine) {
  std::vector<std::pair<std::string, std::string>> facts;
  std::istringstream lines(machine);
  for (std::string line; std::getline(lines, line);)
    if (const std::size_t end = line.find("  "); end != std::string::npos)
      facts.emplace_back(line.substr(0, end), line.substr(line.find_first_not_of(' ', end)));
  return facts;
}

/// RFC 4180: fields with commas, quotes or line breaks are quoted.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text) quoted += letter == '"' ? "\"\"" : std::string(1, letter);
  return quoted + "\"";
}

}  // namespace

std::string setting_text(int width, int height, int threads, const std::string& instruction_set) {
  return formatted("%dx%d, %d %s, %s", width, height, threads, threads == 1 ? "thread" : "threads",
                   instruction_set.c_str());
}

namespace {

constexpr Column kRowColumns[] = {
    {"workload", "the content of its frames: tessera bench --list"},
    {"median ms", "time of a frame after the warm-up, milliseconds: half of the frames took at most this"},
    {"quartiles ms",
     "a quarter of the frames took at most the first time, three quarters at most the second"},
    {"p95 ms, p99 ms", "percentiles: 95 and 99 % of the frames took at most this"},
    {"cold ms", "first frame, with the set-up of renderer and frame buffer"},
    {"Mfrag/s", "million fragments shaded per second of the median frame (fill-z: depth-tested)"},
    {"Mtri/s", "million triangles, lines or points submitted per second of the median frame"},
    {"Mvert/s", "million vertices processed per second of the median frame"},
    {"Mpix/s", "million pixels of the frame per second of the median frame, covered or not"},
    {"GB/s", "10^9 bytes per second, computed, not measured: meshes, planes, image, each once"},
    {"ns/pixel", "median ms in nanoseconds, on all threads together, divided by the pixels of the frame"},
    {"peak MiB", "resident memory after the first frame minus that before, 2^20 bytes: mesh, planes, image"},
    {"B/tri", "bytes of that per triangle, without mesh, planes and image; from 100,000 triangles on"},
};

}  // namespace

std::string table_columns() { return column_lines(kRowColumns); }

std::string table_heading() {
  return formatted("%-22s %9s  %-19s %9s %9s %9s %9s %8s %8s %8s %8s %8s %8s %6s\n", "workload", "median ms",
                   "quartiles ms", "p95 ms", "p99 ms", "cold ms", "Mfrag/s", "Mtri/s", "Mvert/s", "Mpix/s",
                   "GB/s", "ns/pixel", "peak MiB", "B/tri");
}

std::string table_line(const Row& row) {
  if (!row.fault.empty()) return formatted("%-22s not timed: %s\n", row.name.c_str(), row.fault.c_str());
  const auto rate = [&row](std::uint64_t count, double unit) {
    return significant(millions(count, row) * unit);
  };
  return formatted(
      "%-22s %9.3f  %8.3f .. %-8.3f %8.3f %9.3f %9.3f %9s %8s %8s %8s %8s %8.3f %8.1f %6s\n",
      row.name.c_str(), row.ms.median, row.ms.low_quartile, row.ms.high_quartile, row.ms.percentile_95,
      row.ms.percentile_99, row.cold_ms, rate(row.work.fragments, 1).c_str(),
      rate(row.work.triangles, 1).c_str(), rate(row.work.vertices, 1).c_str(),
      rate(row.work.pixels, 1).c_str(), rate(row.work.bytes, 1e-3).c_str(),
      1e6 * row.ms.median / static_cast<double>(row.work.pixels), static_cast<double>(row.peak_bytes) / kMiB,
      bytes_per_triangle(row) ? formatted("%.0f", *bytes_per_triangle(row)).c_str() : "");
}

namespace {

std::string bandwidth_text(const MachineBandwidth& bandwidth) {
  const auto rate = [](const std::optional<double>& value) {
    return value ? formatted("%.1f", *value) : std::string("(no memory)");
  };
  return "bandwidth, GB/s: L1 stores " + rate(bandwidth.l1_stores) + ", stores of 64 KiB per thread " +
         rate(bandwidth.tile_stores) + ", of one frame " + rate(bandwidth.frame_stores) + ", of 256 MiB " +
         rate(bandwidth.memory_stores) + "; copies of one frame " + rate(bandwidth.frame_copies) +
         "; loads of 256 MiB " + rate(bandwidth.memory_loads) +
         " (one core: " + rate(bandwidth.memory_loads_single_core) + ")\n";
}

std::string counters_text(const std::vector<Row>& rows) {
  std::string text;
  const auto is_timed = [](const Row& row) { return row.frames > 0; };
  const auto is_counted = [](const Row& row) { return row.counts.has_value(); };
  if (std::any_of(rows.begin(), rows.end(), is_timed) && std::none_of(rows.begin(), rows.end(), is_counted))
    text += "hardware counters: not available here, so there are no cycles and instructions per frame\n";
  for (const Row& row : rows)
    if (row.counts && row.counts->cycles > 0)
      text +=
          formatted("%-22s %.2f million cycles per frame, %.2f instructions per cycle\n", row.name.c_str(),
                    1e-6 * static_cast<double>(row.counts->cycles),
                    static_cast<double>(row.counts->instructions) / static_cast<double>(row.counts->cycles));
  return text;
}

std::string roofline_text(const Row& row) {
  if (row.frames == 0 || row.work.roofline == Roofline::none) return {};
  if (row.roofline <= 0)
    return formatted("%-22s no memory to measure %s\n", row.name.c_str(), name_of(row.work.roofline));
  const double achieved = achieved_bandwidth(row);
  const auto share_of = [achieved](double limit, Roofline roofline) {
    return formatted(", %.0f %% of %s (%.1f GB/s)", 100 * achieved / limit, name_of(roofline), limit);
  };
  std::string text = formatted("%-22s roofline traffic %.1f GB/s", row.name.c_str(), achieved);
  text += share_of(row.roofline, row.work.roofline);
  if (row.l1_stores > 0) text += share_of(row.l1_stores, Roofline::l1_stores);
  return text + "\n";
}

}  // namespace

namespace {

/// How much the speed of the machine varied while the rows were measured.
std::string reference_text(const std::vector<Row>& rows) {
  double min = 0;
  double max = 0;
  for (const Row& row : rows) {
    if (row.reference_ms <= 0) continue;
    min = min > 0 ? std::min(min, row.reference_ms) : row.reference_ms;
    max = std::max(max, row.reference_ms);
  }
  if (min <= 0) return {};
  return formatted(
      "machine drift: the speed of the machine varied by %.0f %%: work that does not depend on Tessera took "
      "%.2f "
      "to %.2f us in turns with the rows; figures are not corrected for it\n",
      100 * (max / min - 1), 1e3 * min, 1e3 * max);
}

}  // namespace

namespace {

/// Ratios of rows to others, as a separate table.
std::string baseline_text(const std::vector<Row>& rows) {
  const auto has_ratio = [](const Row& row) { return row.to_baseline.has_value(); };
  if (std::none_of(rows.begin(), rows.end(), has_ratio)) return {};
  std::string text = formatted("\n%-54s %8s  %s\n", "frame times of two workloads", "ratio", "interval");
  for (const Row& row : rows)
    if (row.to_baseline)
      text +=
          formatted("%-54s %8.3f  %.3f .. %.3f\n", (row.name + " / " + row.to_baseline->baseline).c_str(),
                    row.to_baseline->ratio.value, row.to_baseline->ratio.low, row.to_baseline->ratio.high);
  return text +
         "Both were measured in turns for this ratio of medians, so it may differ from that of the rows "
         "above.\n"
         "The interval has opposite ends of the 95 % confidence intervals of both medians.\n";
}

}  // namespace

std::string table_summary(const Report& report) {
  std::string text = report.rival_comparisons ? comparison_summary(*report.rival_comparisons) : "\n";
  text += reference_text(report.rows);
  if (report.noise)
    text += formatted("noise: %s against itself: ratio %.3f (%.3f .. %.3f)\n", report.noise_of.c_str(),
                      report.noise->value, report.noise->low, report.noise->high);
  if (report.has_machine) text += bandwidth_text(report.bandwidth);
  if (report.core_to_core_ns[0] > 0 && report.core_to_core_ns[1] > 0)
    text += formatted("core-to-core latency: %.0f ns (%.0f ns before the measurements)\n",
                      report.core_to_core_ns[1], report.core_to_core_ns[0]);
  text += counters_text(report.rows);
  text += baseline_text(report.rows);
  if (report.has_machine)
    for (const Row& row : report.rows) text += roofline_text(row);
  return text;
}

nlohmann::ordered_json report_json(const Report& report) {
  nlohmann::ordered_json json;
  for (const auto& [property, value] : facts_of(report.machine)) json["machine"][property] = value;
  json["width"] = report.width;
  json["height"] = report.height;
  json["threads"] = report.threads;
  json["instruction_set"] = report.instruction_set;
  json["tile_size"] = report.tile_size;
  json["seed"] = report.seed;
  json["kept_on_cores"] = report.cores;
  const auto add = [](nlohmann::ordered_json& entry, const std::vector<Metric>& metrics) {
    for (const Metric& metric : metrics)
      if (metric.value) entry[metric.key] = *metric.value;
  };
  if (report.has_machine) add(json["bandwidth_gigabytes_per_second"], metrics_of(report.bandwidth));
  if (report.core_to_core_ns[0] > 0 && report.core_to_core_ns[1] > 0)
    json["core_to_core_ns"] = {{"before", report.core_to_core_ns[0]}, {"after", report.core_to_core_ns[1]}};
  if (report.noise)
    json["noise"] = {{"workload", report.noise_of},
                     {"ratio", report.noise->value},
                     {"low_ratio", report.noise->low},
                     {"high_ratio", report.noise->high}};
  if (report.rival_comparisons) json["rival_comparisons"] = comparisons_json(*report.rival_comparisons);
  if (!report.scaling.empty()) json["scaling"] = scaling_json(report.scaling);
  if (report.core_model)
    json["core_model"] = {{"core_copy_gigabytes_per_second", report.core_model->core_gb_per_second},
                          {"bandwidth_saturating_cores", report.core_model->bandwidth_saturating_cores},
                          {"barrier_seconds", report.core_model->barrier_seconds}};
  json["workloads"] = nlohmann::ordered_json::array();
  for (const Row& row : report.rows) {
    nlohmann::ordered_json entry{{"name", row.name}, {"threads", row.threads}, {"frames", row.frames}};
    if (!row.fault.empty()) entry["fault"] = row.fault;
    else add(entry, metrics_of(row));
    if (row.fault.empty() && row.roofline > 0) entry["roofline"] = name_of(row.work.roofline);
    if (row.to_baseline) entry["baseline"] = row.to_baseline->baseline;
    json["workloads"].push_back(std::move(entry));
  }
  return json;
}

std::string report_csv(const Report& report) {
  std::string text = "workload,threads,frames";
  for (const Metric& metric : metrics_of(Row{})) text += std::string(",") + metric.key;
  text += ",fault,width,height,instruction_set,tile_size,seed,kept_on_cores,noise_low_ratio,noise_high_ratio";
  // Repeated in every row, so that rows of several files can be concatenated.
  std::string shared = formatted(",%d,%d,%s,%d,%u,", report.width, report.height,
                                 report.instruction_set.c_str(), report.tile_size, report.seed);
  for (const int core : report.cores) shared += (shared.ends_with(',') ? "" : " ") + std::to_string(core);
  shared += report.noise ? formatted(",%.6g,%.6g", report.noise->low, report.noise->high) : ",,";
  for (const auto& [property, value] : facts_of(report.machine)) {
    text += "," + csv_field(property);
    shared += "," + csv_field(value);
  }
  text += "\n";
  for (const Row& row : report.rows) {
    text += row.name + "," + std::to_string(row.threads) + "," + std::to_string(row.frames);
    for (const Metric& metric : metrics_of(row))
      text += row.fault.empty() && metric.value ? formatted(",%.6g", *metric.value) : ",";
    text += "," + csv_field(row.fault) + shared + "\n";
  }
  return text;
}

}  // namespace tessera::bench
