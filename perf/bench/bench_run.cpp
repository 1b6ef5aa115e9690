#include "perf/bench/bench_run.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "engine/program/cli/machine_text.h"
#include "engine/program/cli/standard_output.h"
#include "engine/program/imageio/picture.h"
#include "perf/bench/cores.h"
#include "perf/bench/machine_bandwidth.h"
#include "perf/bench/text.h"

namespace tessera::bench {
using namespace detail;
using namespace program;

WorkloadSetup setup_of(const BenchOptions& options) {
  return {.width = options.width,
          .height = options.height,
          .options = options.renderer,
          .seed = options.measure.seed};
}

BenchRun::BenchRun(const BenchOptions& options) : options_(options), setup_(setup_of(options)) {
  report_.machine = cli::machine_text();
  report_.width = options.width;
  report_.height = options.height;
  report_.threads = options.renderer.threads;
  report_.tile_size = options.renderer.tile_size;
  report_.seed = options.measure.seed;
  if (!options.cores.empty()) report_.cores = allowed_cores();  // sorted, without duplicates
  report_.instruction_set = name(Renderer(options.renderer).options().instruction_set);
}

void BenchRun::run(const std::vector<const WorkloadEntry*>& entries, const BaselineRun* earlier) {
  report_.has_machine = options_.machine;
  if (options_.machine) report_.core_to_core_ns[0] = core_to_core_ns();
  show(report_.machine + "frames             " + setting_text(report_) + times_text() + "\n\n");
  if (options_.scaling) run_on_more_threads(entries);
  else if (options_.rivals) run_with_rivals(entries);
  else run_alone(entries, earlier);
  if (!options_.machine) return;
  if (!entries.empty()) measure_noise(*entries.front());
  measure_machine();
}

std::string BenchRun::times_text() const {
  const int repeats = options_.measure.repeats;
  const std::string frames = repeats > 0 ? formatted("%d per row", repeats)
                                         : formatted("%g s per row, at least 15", options_.measure.seconds);
  return "; " + frames + ", after a warm-up; size-* and small-* have their own size";
}

void BenchRun::show(const std::string& text) const {
  if (!is_silent()) cli::write_to_stdout(text);
}

void BenchRun::run_alone(const std::vector<const WorkloadEntry*>& entries, const BaselineRun* earlier) {
  show(table_heading());
  for (const WorkloadEntry* entry : entries) {
    Candidate candidate = candidate_of(*entry);
    if (!options_.pictures_folder.empty())
      candidate.validate = [&](const Picture& picture) {
        write_picture(picture, options_.pictures_folder + "/" + entry->name + ".png");
        return std::string();
      };
    MeasureOptions measured = alone();
    measured.measures_rooflines = options_.machine;
    Row row = measure(std::vector{candidate}, measured, counters_).front();
    if (earlier != nullptr) row.earlier_over_now = earlier->ratio_to(row);
    compare_with_baseline(*entry, row);
    show(table_line(row));
    has_fault_ |= !row.fault.empty();
    report_.rows.push_back(std::move(row));
  }
  show(table_columns());
  if (earlier != nullptr) confirm_regressions(entries, *earlier);
}

void BenchRun::confirm_regressions(const std::vector<const WorkloadEntry*>& entries,
                                   const BaselineRun& earlier) {
  constexpr int kMaxConfirmations = 3;
  for (int round = 0; round < kMaxConfirmations; ++round)
    for (const WorkloadEntry* entry : entries) {
      const auto row = std::find_if(report_.rows.begin(), report_.rows.end(),
                                    [entry](const Row& each) { return each.name == entry->name; });
      if (row == report_.rows.end() || !row->earlier_over_now) continue;
      if (!is_slower(*row->earlier_over_now, options_.allowed)) continue;
      show(formatted("%s looks slower than in %s: measured again\n", entry->name.c_str(),
                     options_.compare_file.c_str()));
      const Row again = measure(std::vector{candidate_of(*entry)}, alone(), counters_).front();
      const std::optional<Ratio> ratio = earlier.ratio_to(again);
      if (!ratio) continue;
      ++row->confirmations;
      row->earlier_over_now = joined(*row->earlier_over_now, *ratio);
    }
}

void BenchRun::run_with_rivals(const std::vector<const WorkloadEntry*>& entries) {
  RivalComparisons& rival_comparisons = report_.rival_comparisons.emplace();
  rival_comparisons.rival = rivals::mesa_name(options_.driver, report_.threads);
  rival_comparisons.finish_ms =
      rivals::mesa_finish_ms(report_.width, report_.height, options_.driver, report_.threads);
  rival_comparisons.finish_pixel_ms = rivals::mesa_finish_ms(1, 1, options_.driver, report_.threads);
  std::string without_rival;
  show(comparison_heading());
  for (const WorkloadEntry* entry : entries) {
    std::optional<Comparison> comparison =
        compare_with_rival(*entry, setup_, options_.driver, options_.measure, counters_);
    if (!comparison) {
      without_rival += " " + entry->name;
      continue;
    }
    show(comparison_line(*comparison));
    has_fault_ |= !comparison->fault().empty();
    rival_comparisons.comparisons.push_back(std::move(*comparison));
  }
  show(comparison_columns());
  if (!without_rival.empty()) show("not drawn by rivals:" + without_rival + "\n");
}

void BenchRun::run_on_more_threads(const std::vector<const WorkloadEntry*>& entries) {
  CoreModel& model = report_.core_model.emplace(measure_core_model(report_.threads));
  model.bandwidth_saturating_cores = options_.memory_cores;
  show(
      formatted("one core copies %.1f GB/s; %d cores are assumed to saturate memory bandwidth "
                "(--memory-cores); a barrier takes %.1f us\n\n",
                model.core_gb_per_second, model.bandwidth_saturating_cores, 1e6 * model.barrier_seconds));
  show(scaling_heading(report_.threads));
  for (const WorkloadEntry* entry : entries) {
    report_.scaling.push_back(
        scaling_of(*entry, setup_, report_.threads, model, options_.measure, counters_));
    show(scaling_line(report_.scaling.back()));
    const Scaling& scaling = report_.scaling.back();
    has_fault_ |= !scaling.fault.empty() || !scaling.not_computed.empty();
  }
  show(scaling_columns());
}

void BenchRun::measure_machine() {
  const std::uint64_t frame_bytes =
      4 * static_cast<std::uint64_t>(report_.width) * static_cast<std::uint64_t>(report_.height);
  report_.bandwidth = measure_machine_bandwidth(report_.threads, frame_bytes, options_.measure.seconds);
  try {
    report_.core_to_core_ns[1] = core_to_core_ns();
  } catch (const std::exception&) {
    // No thread or no memory for it. It stays 0 and is not shown.
  }
}

void BenchRun::measure_noise(const WorkloadEntry& entry) {
  const std::vector<Row> rows =
      measure(std::vector<Candidate>(2, candidate_of(entry)), options_.measure, counters_);
  report_.noise_of = entry.name;
  if (rows[0].frames != 0) report_.noise = ratio_of(rows[1].ms, rows[0].ms);
}

void BenchRun::compare_with_baseline(const WorkloadEntry& entry, Row& row) {
  const WorkloadEntry* const baseline = find_workload(entry.baseline);
  if (baseline == nullptr || !row.fault.empty()) return;
  const std::vector<Row> rows =
      measure(std::vector{candidate_of(entry), candidate_of(*baseline)}, options_.measure, counters_);
  for (const Row& measured : rows)
    if (row.fault.empty()) row.fault = measured.fault;
  if (row.fault.empty()) row.to_baseline = {baseline->name, ratio_of(rows[0].ms, rows[1].ms)};
}

MeasureOptions BenchRun::alone() const {
  MeasureOptions options = options_.measure;
  options.measures_reference = true;
  return options;
}

Candidate BenchRun::candidate_of(const WorkloadEntry& entry) const {
  return {
      .name = entry.name, .make = [this, &entry] { return entry.make(setup_); }, .threads = report_.threads};
}

}  // namespace tessera::bench
