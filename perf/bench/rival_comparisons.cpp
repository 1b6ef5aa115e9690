#include "perf/bench/rival_comparisons.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "perf/bench/columns.h"
#include "perf/bench/text.h"

namespace tessera::bench {
namespace {

constexpr int kMaxLevelDifference = 2;

double mismatch_share_of(const Picture& a, const Picture& b) {
  std::size_t mismatches = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    int difference = 0;
    for (std::size_t c = i; c < i + 3; ++c)
      difference = std::max(difference, std::abs(a.rgba[c] - b.rgba[c]));
    mismatches += difference > kMaxLevelDifference ? 1 : 0;
  }
  return static_cast<double>(mismatches) / (static_cast<double>(a.rgba.size()) / 4);
}

}  // namespace

Comparison compare_with_rival(Candidate ours, Candidate rival, double max_mismatch_share,
                              const MeasureOptions& options, const HardwareCounters& counters) {
  Comparison result;
  std::optional<Picture> picture;
  ours.validate = [&](const Picture& drawn) {
    picture = drawn;
    return std::string();
  };
  rival.validate = [&](const Picture& drawn) {
    if (!picture) return std::string();  // ours has a fault
    if (drawn.width != picture->width || drawn.height != picture->height)
      return formatted("the rival's picture is %dx%d, expected %dx%d", drawn.width, drawn.height,
                       picture->width, picture->height);
    result.mismatch_share = mismatch_share_of(*picture, drawn);
    if (result.mismatch_share <= max_mismatch_share) return std::string();
    return formatted(
        "the rival's picture differs by more than two levels in %.3f %% of the pixels, expected %.3f %% at "
        "most",
        100 * result.mismatch_share, 100 * max_mismatch_share);
  };
  std::vector<Row> rows = measure(std::vector{ours, rival}, options, counters);
  result.ours = std::move(rows[0]);
  result.rivals = std::move(rows[1]);
  return result;
}

std::optional<Comparison> compare_with_rival(const WorkloadEntry& entry, const WorkloadSetup& setup,
                                             rivals::MesaDriver driver, const MeasureOptions& options,
                                             const HardwareCounters& counters) {
  const std::optional<GlWorkload> gl = entry.gl_workload(setup);
  if (!gl) return std::nullopt;
  const int threads = setup.options.threads;
  const Candidate ours{.name = entry.name, .make = [&] { return entry.make(setup); }, .threads = threads};
  const Candidate rival{.name = entry.name,
                        .make =
                            [&] {
                              return rivals::mesa_workload(*gl, gl->width > 0 ? gl->width : setup.width,
                                                           gl->height > 0 ? gl->height : setup.height, driver,
                                                           threads);
                            },
                        .threads = threads};
  Comparison result = compare_with_rival(ours, rival, gl->max_mismatch_share, options, counters);
  result.is_in_mean = entry.is_in_mean;
  return result;
}

namespace {

constexpr Column kRivalColumns[] = {
    {"ours ms, rival ms",
     "median time of a frame of Tessera and of the rival, milliseconds, measured in turns"},
    {"ratio", "rival ms divided by ours ms: above 1, Tessera is faster"},
    {"interval", "of the ratio: opposite ends of the 95 % confidence intervals of both medians"},
    {"mismatch %",
     "pixels of which some component differs by more than 2 of 255, per cent: 0 is not yet equal"},
};

}  // namespace

std::string comparison_columns() { return column_lines(kRivalColumns); }

std::string comparison_heading() {
  return formatted("%-22s %9s %9s %7s  %-16s %12s\n", "workload", "ours ms", "rival ms", "ratio", "interval",
                   "mismatch %");
}

std::string comparison_line(const Comparison& comparison) {
  if (!comparison.fault().empty())
    return formatted("%-22s not compared: %s\n", comparison.ours.name.c_str(), comparison.fault().c_str());
  const Ratio ratio = comparison.ratio();
  return formatted("%-22s %9.3f %9.3f %7.2f  %6.2f .. %-6.2f %12.4f\n", comparison.ours.name.c_str(),
                   comparison.ours.ms.median, comparison.rivals.ms.median, ratio.value, ratio.low, ratio.high,
                   100 * comparison.mismatch_share);
}

std::string comparison_summary(const RivalComparisons& rival_comparisons) {
  double sum = 0;
  int count = 0;
  const Comparison* lowest = nullptr;
  for (const Comparison& comparison : rival_comparisons.comparisons) {
    if (!comparison.is_in_mean || !comparison.fault().empty()) continue;
    sum += std::log(comparison.ratio().value);
    ++count;
    if (lowest == nullptr || comparison.ratio().value < lowest->ratio().value) lowest = &comparison;
  }
  std::string text = "\nrival: " + rival_comparisons.rival +
                     formatted(
                         "; rival ms has the copy of the picture: a frame that changes one pixel takes %.3f "
                         "ms, in a window of one "
                         "pixel %.3f ms\n",
                         rival_comparisons.finish_ms, rival_comparisons.finish_pixel_ms);
  if (count != 0)
    text += formatted("geometric mean of %d ratios: %.2f; lowest: %.2f (%s)\n", count, std::exp(sum / count),
                      lowest->ratio().value, lowest->ours.name.c_str());
  return text;
}

nlohmann::ordered_json comparisons_json(const RivalComparisons& rival_comparisons) {
  nlohmann::ordered_json json{{"rival", rival_comparisons.rival},
                              {"finish_ms", rival_comparisons.finish_ms},
                              {"finish_pixel_ms", rival_comparisons.finish_pixel_ms}};
  json["workloads"] = nlohmann::ordered_json::array();
  for (const Comparison& comparison : rival_comparisons.comparisons) {
    nlohmann::ordered_json entry{{"name", comparison.ours.name},
                                 {"threads", comparison.ours.threads},
                                 {"frames", comparison.ours.frames}};
    if (!comparison.fault().empty()) {
      entry["fault"] = comparison.fault();
    } else {
      for (const auto& [prefix, row] : {std::pair("", &comparison.ours), {"rival_", &comparison.rivals}}) {
        entry[std::string(prefix) + "median_ms"] = row->ms.median;
        entry[std::string(prefix) + "low_quartile_ms"] = row->ms.low_quartile;
        entry[std::string(prefix) + "high_quartile_ms"] = row->ms.high_quartile;
      }
      entry["ratio"] = comparison.ratio().value;
      entry["low_ratio"] = comparison.ratio().low;
      entry["high_ratio"] = comparison.ratio().high;
      entry["mismatch_share"] = comparison.mismatch_share;
    }
    json["workloads"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace tessera::bench
