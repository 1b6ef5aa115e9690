#include "perf/bench/baseline_run.h"

#include <algorithm>

#include "engine/program/scene/json_value.h"
#include "engine/program/scene/text_file.h"
#include "perf/bench/text.h"

namespace tessera::bench {
using namespace program;

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
    if (row.json().contains("median_ms"))
      medians_[row.member("name").text()] = row.member("median_ms").number(1e-9, 1e12);
  }
  report_ = report;
}

bool BaselineRun::has_any_of(std::span<const WorkloadEntry* const> entries) const {
  return std::any_of(entries.begin(), entries.end(),
                     [this](const WorkloadEntry* entry) { return medians_.contains(entry->name); });
}

void BaselineRun::require_size(int width, int height) const {
  if (width != width_ || height != height_)
    throw Error(formatted("%s: frames are %dx%d, expected %dx%d, the size of this run", file_.c_str(), width_,
                          height_, width, height));
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
  comparison.table +=
      formatted("%-22s %12s %12s %12s\n", "workload", "earlier, ms", "now, ms", "earlier/now");
  std::map<std::string, double> only_earlier = medians_;
  for (const Row& row : now.rows) {
    const auto found = medians_.find(row.name);
    only_earlier.erase(row.name);
    if (found == medians_.end() || row.frames == 0) {
      comparison.table += row.name + ": " + (row.frames == 0 ? "not measured now" : "not in " + file_) + "\n";
      continue;
    }
    const double earlier = found->second;
    const bool has_regressed = row.ms.median > earlier * (1 + allowed);
    comparison.table += formatted("%-22s %12.3f %12.3f %12.3f%s\n", row.name.c_str(), earlier, row.ms.median,
                                  earlier / row.ms.median, has_regressed ? "  slower" : "");
    comparison.has_regressed |= has_regressed;
  }
  for (const auto& [name, median] : only_earlier) comparison.table += name + ": only in " + file_ + "\n";
  return comparison;
}

}  // namespace tessera::bench
