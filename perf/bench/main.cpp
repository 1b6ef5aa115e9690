// tessera bench: measures the cost of frames on this machine. With `price` as its first argument, the program
// is `tessera price`.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/program/cli/command_line.h"
#include "engine/program/cli/machine_text.h"
#include "engine/program/cli/standard_output.h"
#include "engine/program/imageio/atomic_file.h"
#include "engine/program/imageio/picture.h"
#include "engine/program/threads/thread_limit.h"
#include "perf/bench/baseline_run.h"
#include "perf/bench/bench_options.h"
#include "perf/bench/cores.h"
#include "perf/bench/frame_costs.h"
#include "perf/bench/growth.h"
#include "perf/bench/heatmap_sheet.h"
#include "perf/bench/machine_bandwidth.h"
#include "perf/bench/output_files.h"
#include "perf/bench/report.h"
#include "perf/bench/text.h"
#include "perf/bench/traced_frame.h"
#include "perf/bench/workload_selection.h"
#include "perf/prices/price_main.h"

namespace tessera::bench {
using namespace detail;
using namespace program;
namespace {

using cli::kDiffers;
using cli::kFailed;

constexpr const char* kExamples = R"(Examples:
  tessera bench                                   all workloads
  tessera bench fill grid-2M                      some of them
  tessera bench operation                         cost of fragment operations
  tessera bench --machine fill                    rooflines and noise of the machine, too
  tessera bench --json before.json                before a change
  tessera bench --compare before.json             after it)";

void write(const std::string& file, const std::string& text) {
  if (file != "-") return write_file_atomically(file, text);
  cli::write_to_stdout(text);
}

WorkloadSetup setup_of(const BenchOptions& options) {
  return {.width = options.width,
          .height = options.height,
          .options = options.renderer,
          .seed = options.measure.seed};
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error("cannot create the folder \"" + folder + "\": " + error.message());
}

/// Measures workloads and prints each line as soon as it is known.
class Bench {
 public:
  explicit Bench(const BenchOptions& options) : options_(options), setup_(setup_of(options)) {
    report_.machine = cli::machine_text();
    report_.width = options.width;
    report_.height = options.height;
    report_.threads = options.renderer.threads;
    report_.tile_size = options.renderer.tile_size;
    report_.seed = options.measure.seed;
    if (!options.cores.empty()) report_.cores = allowed_cores();  // sorted, without duplicates
    report_.instruction_set = name(Renderer(options.renderer).options().instruction_set);
  }

  /// @param earlier  null: no comparison
  void run(const std::vector<const WorkloadEntry*>& entries, const BaselineRun* earlier) {
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
  /// Number of frames, and sizes other than that of the setting.
  std::string times_text() const {
    const int repeats = options_.measure.repeats;
    const std::string frames = repeats > 0 ? formatted("%d per row", repeats)
                                           : formatted("%g s per row, at least 15", options_.measure.seconds);
    return "; " + frames + ", after a warm-up; size-* and small-* have their own size";
  }
  void show(const std::string& text) const {
    if (!is_silent()) cli::write_to_stdout(text);
  }
  /// Whether the standard output carries JSON or CSV.
  bool is_silent() const { return options_.json_file == "-" || options_.csv_file == "-"; }
  const Report& report() const { return report_; }
  bool has_fault() const { return has_fault_; }

 private:
  void run_alone(const std::vector<const WorkloadEntry*>& entries, const BaselineRun* earlier) {
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
  /// Measures again what looks slower than earlier: a burst of other work seldom returns. Each row at most
  /// kMaxConfirmations times, after the others.
  void confirm_regressions(const std::vector<const WorkloadEntry*>& entries, const BaselineRun& earlier) {
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
  void run_with_rivals(const std::vector<const WorkloadEntry*>& entries) {
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
  void run_on_more_threads(const std::vector<const WorkloadEntry*>& entries) {
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
  void measure_machine() {
    const std::uint64_t frame_bytes =
        4 * static_cast<std::uint64_t>(report_.width) * static_cast<std::uint64_t>(report_.height);
    report_.bandwidth = measure_machine_bandwidth(report_.threads, frame_bytes, options_.measure.seconds);
    try {
      report_.core_to_core_ns[1] = core_to_core_ns();
    } catch (const std::exception&) {
      // No thread or no memory for it. It stays 0 and is not shown.
    }
  }
  void measure_noise(const WorkloadEntry& entry) {
    const std::vector<Row> rows =
        measure(std::vector<Candidate>(2, candidate_of(entry)), options_.measure, counters_);
    report_.noise_of = entry.name;
    if (rows[0].frames != 0) report_.noise = ratio_of(rows[1].ms, rows[0].ms);
  }
  /// Times the row's workload once more, in turns with its baseline, if it has one.
  void compare_with_baseline(const WorkloadEntry& entry, Row& row) {
    const WorkloadEntry* const baseline = find_workload(entry.baseline);
    if (baseline == nullptr || !row.fault.empty()) return;
    const std::vector<Row> rows =
        measure(std::vector{candidate_of(entry), candidate_of(*baseline)}, options_.measure, counters_);
    for (const Row& measured : rows)
      if (row.fault.empty()) row.fault = measured.fault;
    if (row.fault.empty()) row.to_baseline = {baseline->name, ratio_of(rows[0].ms, rows[1].ms)};
  }
  /// Options for a row that later runs may be compared with.
  MeasureOptions alone() const {
    MeasureOptions options = options_.measure;
    options.measures_reference = true;
    return options;
  }
  Candidate candidate_of(const WorkloadEntry& entry) const {
    return {.name = entry.name,
            .make = [this, &entry] { return entry.make(setup_); },
            .threads = report_.threads};
  }

  const BenchOptions& options_;
  WorkloadSetup setup_;
  Report report_{};
  HardwareCounters counters_{};
  bool has_fault_ = false;
};

void trace(const BenchOptions& options, const std::vector<const WorkloadEntry*>& entries) {
  const WorkloadSetup setup = setup_of(options);
  std::vector<TracedFrame> frames;
  if (!options.trace_file.empty())
    for (const WorkloadEntry* entry : entries) {
      frames.push_back(trace_frame(*entry, setup));
      if (frames.back().tasks.empty())
        std::cerr << entry->name << ": is not drawn by a renderer, so its trace is empty\n";
    }
  std::optional<Heatmap> tile_costs;
  if (!options.heatmap_file.empty()) {
    tile_costs = heatmap(measure_task_costs(*entries.front(), setup, options.renderer.threads));
    if (tile_costs->picture.rgba.empty())
      throw Error(entries.front()->name +
                  ": is not drawn by a renderer, so there is no heatmap of its tiles");
  }
  if (!options.trace_file.empty()) write(options.trace_file, chrome_trace(frames));
  if (!tile_costs) return;
  const std::unique_ptr<Workload> workload = entries.front()->make(setup);
  workload->draw();
  write_picture(heatmap_sheet(*tile_costs, workload->picture(), entries.front()->name), options.heatmap_file);
  (options.trace_file == "-" ? std::cerr : std::cout) << formatted(
      "%s: the frame, and the cost of its tiles in nanoseconds of one thread per pixel; white is the most "
      "expensive tile, %.2f\nthe tiles took %.3f ms of one thread together: tests, shading and stores of "
      "their pixels, without vertices and bins\n",
      options.heatmap_file.c_str(), tile_costs->max_ns_per_pixel, tile_costs->tiles_ms);
}

void show_growth(const BenchOptions& options) {
  const HardwareCounters counters;
  const ThreadLimit limit(options.renderer.threads);
  const std::vector<Growth> all = measure_growth(setup_of(options), options.measure, counters);
  const std::string instruction_set(name(Renderer(options.renderer).options().instruction_set));
  (options.growth_file == "-" ? std::cerr : std::cout)
      << "frames             "
      << setting_text(options.width, options.height, options.renderer.threads, instruction_set) << "\n"
      << growth_table(all);
  write(options.growth_file, growth_svg(all));
}

/// Binds the process to these logical CPUs.
/// @throws CLI::ValidationError if one of them is not allowed
void bind_to_cores(const std::vector<int>& cores) {
  const auto listed = [](const std::vector<int>& list) {
    std::string text;
    for (const int core : list) text += (text.empty() ? "" : ",") + std::to_string(core);
    return text;
  };
  const std::vector<int> allowed = allowed_cores();
  std::vector<int> forbidden;
  std::copy_if(cores.begin(), cores.end(), std::back_inserter(forbidden),
               [&](int core) { return std::find(allowed.begin(), allowed.end(), core) == allowed.end(); });
  if (!forbidden.empty())
    throw CLI::ValidationError("--cores", "found " + listed(forbidden) +
                                              ", which this process may not use, expected some of " +
                                              listed(allowed));
  if (!set_thread_affinity(cores))
    throw Error("the system refuses to bind this process to the cores " + listed(cores));
}

void list_workloads() {
  for (const WorkloadEntry& entry : workloads()) {
    const std::string missing = entry.missing_requirement ? entry.missing_requirement() : "";
    std::printf("%-22s %s%s%s\n", entry.name.c_str(), entry.description.c_str(),
                entry.is_in_mean ? "" : " (not in the mean)",
                missing.empty() ? "" : (": " + missing).c_str());
  }
}

int run(BenchOptions& options) {
  if (options.list) {
    list_workloads();
    return 0;
  }
  // The earlier report must be readable before anything is measured.
  std::optional<BaselineRun> earlier;
  if (!options.compare_file.empty()) {
    earlier.emplace(options.compare_file);
    earlier->require_size(options.width, options.height);
  }
  const Selection selection = prepare_workloads(options.names);
  if (earlier && !earlier->has_any_of(selection.entries))
    throw Error(options.compare_file + ": has none of the workloads to be measured, expected at least one");
  if (!options.heatmap_file.empty() && selection.entries.size() != 1)
    throw CLI::ValidationError(
        "--heatmap", "found " + std::to_string(selection.entries.size()) + " workloads, expected 1");
  require_outputs(options);
  if (!options.cores.empty()) bind_to_cores(options.cores);
  if (options.growth_file.empty()) std::cerr << selection.skipped;
  if (options.renderer.threads == 0) options.renderer.threads = available_cores();
  if (!options.growth_file.empty()) {
    show_growth(options);
    return 0;
  }
  if (!options.trace_file.empty() || !options.heatmap_file.empty()) {
    const ThreadLimit limit(options.renderer.threads);
    trace(options, selection.entries);
    return 0;
  }
  Bench bench(options);  // opens the hardware counters: before any thread is started
  const ThreadLimit limit(options.renderer.threads);
  if (!options.pictures_folder.empty()) make_folder(options.pictures_folder);
  bench.run(selection.entries, earlier ? &*earlier : nullptr);
  bench.show(table_summary(bench.report()));
  if (!options.json_file.empty()) write(options.json_file, report_json(bench.report()).dump(2) + "\n");
  if (!options.csv_file.empty()) write(options.csv_file, report_csv(bench.report()));
  if (bench.has_fault()) return kFailed;
  if (!earlier) return 0;
  const BaselineComparison comparison = earlier->compare(bench.report(), options.allowed);
  (bench.is_silent() ? std::cerr : std::cout) << "\n" << comparison.table;
  return comparison.has_regressed ? kDiffers : 0;
}

}  // namespace
}  // namespace tessera::bench

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "price") return tessera::bench::price_main(argc - 1, argv + 1);
  using namespace tessera::program;
  CLI::App program("Measures the cost of frames on this machine", "tessera bench");
  cli::set_help(program);
  program.footer(tessera::bench::kExamples);
  tessera::bench::BenchOptions options;
  try {
    tessera::bench::add_options(program, options);
    const std::optional<int> done = cli::parse_arguments(program, argc, argv);
    const int code = done ? *done : tessera::bench::run(options);
    if (code == 0) cli::require_stdout_written();
    return code;
  } catch (const cli::UsageError& error) {
    return cli::report_usage("tessera bench", error.what(), "tessera bench");
  } catch (const CLI::ParseError& error) {
    return cli::report_usage("tessera bench", error.what(), "tessera bench");
  } catch (const std::bad_alloc&) {
    std::cerr << "tessera bench: error: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "tessera bench: error: " << error.what() << "\n";
  }
  return cli::kFailed;
}
