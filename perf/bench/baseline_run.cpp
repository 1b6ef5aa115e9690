#include "perf/bench/baseline_run.h"

#include <algorithm>

#include "engine/program/scene/json_value.h"
#include "engine/program/scene/text_file.h"
#include "perf/bench/columns.h"
#include "perf/bench/text.h"

namespace tessera::bench {
using namespace program;
namespace {

RowTimes times_of(const json::Value& row) {
  const auto ms = [&row](const char* key) { return row.member(key).number(1e-9, 1e12); };
  const auto ms_or = [&](const char* key, double missing) {
    return row.json().contains(key) ? ms(key) : missing;
  };
  RowTimes times{.median = ms("median_ms")};
  if (row.json().contains("frames"))
    times.frames = static_cast<std::size_t>(row.member("frames").integer(0, 1000000));
  const bool is_old = !row.json().contains("percentile_5_ms");
  times.low = is_old ? ms_or("min_ms", times.median) : ms("percentile_5_ms");
  times.high = ms_or(is_old ? "percentile_95_ms" : "high_quartile_ms", times.median);
  times.reference = ms_or("reference_ms", 0);
  return times;
}

RowTimes times_of(const Row& row) {
  return {.frames = row.frames,
          .median = row.ms.median,
          .low = row.ms.percentile_5,
          .high = row.ms.high_quartile,
          .reference = row.reference_ms};
}

std::string comparison_table_line(const Row& row, const RowTimes& earlier, double allowed) {
  const Ratio& ratio = *row.earlier_over_now;
  std::string text =
      formatted("%-22s %12.3f %12.3f %12.3f  %6.3f .. %-6.3f  %s", row.name.c_str(), earlier.median,
                row.ms.median, ratio.value, ratio.low, ratio.high, verdict_of(ratio, allowed));
  if (row.confirmations > 0) text += formatted(" (measured %d times)", 1 + row.confirmations);
  return text + "\n";
}

constexpr Column kComparisonColumns[] = {
    {"earlier, ms; now, ms", "median time of a frame, as `median ms` above"},
    {"earlier/now", "ratio of the two: above 1, the row is faster now"},
    {"interval",
     "range of earlier/now that the frame times of both runs and the machine drift between them permit"},
};

/// The verdicts and the result, below the columns.
std::string verdict_lines(double allowed, int slower) {
  const double percent = 100 * allowed;
  std::string text =
      formatted("%-22s the whole interval is below %.3f: a frame takes %g %% longer or more (--allowed)\n",
                "slower", 1 / (1 + allowed), percent) +
      formatted("%-22s the whole interval is above %.3f\n", "faster", 1 + allowed) +
      formatted("%-22s the whole interval lies between: no change beyond %g %%\n", "same", percent) +
      formatted(
          "%-22s the interval crosses a limit: longer runs (--seconds) or a quieter machine can tell\n\n",
          "unsure");
  if (slower == 0) return text + "no row is slower: exit code 0\n";
  return text + formatted("%d %s slower: exit code 3\n", slower, slower == 1 ? "row is" : "rows are");
}

}  // namespace

BaselineRun::BaselineRun(const std::string& file) : file_(file) {
  const json::Json report = json::parse(read_text_file(file), file);
  const json::Value whole(report, "", file);
  if (!report.is_object() || !report.contains("workloads")) whole.fail("a report of tessera bench --json");
  for (const char* key : {"width", "height", "threads", "instruction_set"})
    if (!report.contains(key))
      whole.refuse(std::string("found no \"") + key + "\", expected a report of tessera bench --json");
  const auto integer = [&whole](const char* key) {
    return static_cast<int>(whole.member(key).integer(1, kMaxFrameBufferSize));
  };
  width_ = integer("width");
  height_ = integer("height");
  setting_ = setting_text(width_, height_, integer("threads"), whole.member("instruction_set").text());
  const json::Value rows = whole.member("workloads");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const json::Value row = rows.element(i);
    if (!row.json().is_object() || !row.json().contains("name")) row.fail("a workload with its name");
    if (row.json().contains("median_ms")) times_[row.member("name").text()] = times_of(row);
  }
  report_ = report;
}

bool BaselineRun::has_any_of(std::span<const WorkloadEntry* const> entries) const {
  return std::any_of(entries.begin(), entries.end(),
                     [this](const WorkloadEntry* entry) { return times_.contains(entry->name); });
}

void BaselineRun::require_size(int width, int height) const {
  if (width != width_ || height != height_)
    throw Error(formatted("%s: frames are %dx%d, expected %dx%d, the size of this run", file_.c_str(), width_,
                          height_, width, height));
}

std::optional<Ratio> BaselineRun::ratio_to(const Row& now) const {
  const auto found = times_.find(now.name);
  if (found == times_.end() || now.frames == 0) return std::nullopt;
  return earlier_over_now(found->second, times_of(now));
}

BaselineComparison BaselineRun::compare(const Report& now, double allowed) const {
  BaselineComparison comparison;
  if (setting_ != setting_text(now))
    comparison.table = "settings differ: " + setting_ + " in " + file_ + ", now " + setting_text(now) + "\n";
  const nlohmann::ordered_json report = report_json(now);
  for (const char* path : {"/tile_size", "/seed", "/kept_on_cores", "/machine/CPU", "/machine/compiler"}) {
    const nlohmann::ordered_json::json_pointer at(path);
    const bool has_both = report_.contains(at) && report.contains(at);
    if (has_both && report_[at] != report[at])
      comparison.table += at.back() + " differs: " + report_[at].dump() + " in " + file_ + ", now " +
                          report[at].dump() + "\n";
  }
  const auto has_no_reference = [](const auto& entry) { return entry.second.reference <= 0; };
  if (std::any_of(times_.begin(), times_.end(), has_no_reference))
    comparison.table += formatted(
        "%s has no reference times (an older version wrote it), so intervals allow for a machine that is "
        "%.0f %% slower or faster now\n",
        file_.c_str(), 100 * (kUnknownDrift - 1));
  comparison.table += formatted("%-22s %12s %12s %12s  %-16s  %s\n", "workload", "earlier, ms", "now, ms",
                                "earlier/now", "interval", "verdict");
  std::map<std::string, RowTimes> only_earlier = times_;
  int slower = 0;
  for (const Row& row : now.rows) {
    const auto found = times_.find(row.name);
    only_earlier.erase(row.name);
    if (found == times_.end() || !row.earlier_over_now) {
      comparison.table += row.name + ": " + (row.frames == 0 ? "not measured now" : "not in " + file_) + "\n";
      continue;
    }
    comparison.table += comparison_table_line(row, found->second, allowed);
    slower += is_slower(*row.earlier_over_now, allowed) ? 1 : 0;
  }
  for (const auto& [name, times] : only_earlier) comparison.table += name + ": only in " + file_ + "\n";
  comparison.table += column_lines(kComparisonColumns);
  comparison.table += verdict_lines(allowed, slower);
  comparison.has_regressed = slower > 0;
  return comparison;
}

}  // namespace tessera::bench
