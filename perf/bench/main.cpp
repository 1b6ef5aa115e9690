// tessera bench: what frames cost on this machine.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <map>
#include <new>
#include <optional>
#include <utility>

#include "engine/program/cli/machine_text.h"
#include "engine/program/cli/standard_output.h"
#include "engine/program/imageio/atomic_file.h"
#include "engine/program/imageio/picture.h"
#include "engine/program/threads/thread_limit.h"
#include "perf/bench/bandwidth.h"
#include "perf/bench/baseline_run.h"
#include "perf/bench/bench_options.h"
#include "perf/bench/cores.h"
#include "perf/bench/frame_costs.h"
#include "perf/bench/growth.h"
#include "perf/bench/report.h"
#include "perf/bench/text.h"
#include "perf/bench/traced_frame.h"

namespace tessera::bench {
using namespace detail;
using namespace program;
namespace {

constexpr int kFailed = 1, kBadUsage = 2, kRegressed = 3;

constexpr const char* kExamples = R"(examples:
  tessera bench                                   everything
  tessera bench fill grid-2M                      some of it
  tessera bench --json before.json                and later
  tessera bench --compare before.json)";

/// Whether a name is a workload's, or, if it is no whole name, how that one's begins.
bool matches(const std::string& name, const WorkloadEntry& entry) {
  if (entry.name == name) return true;
  const bool is_a_whole_name = std::any_of(workloads().begin(), workloads().end(),
                                           [&](const WorkloadEntry& other) { return other.name == name; });
  return !is_a_whole_name && !name.empty() && entry.name.starts_with(name);
}
std::vector<const WorkloadEntry*> select_workloads(const std::vector<std::string>& names) {
  std::vector<const WorkloadEntry*> list;
  for (const std::string& name : names)
    if (std::none_of(workloads().begin(), workloads().end(),
                     [&](const WorkloadEntry& entry) { return matches(name, entry); }))
      throw CLI::ValidationError(
          "workloads", "found \"" + name + "\", with which no workload's name begins; --list has them");
  for (const WorkloadEntry& entry : workloads())
    if (names.empty() || std::any_of(names.begin(), names.end(),
                                     [&](const std::string& name) { return matches(name, entry); }))
      list.push_back(&entry);
  return list;
}

void write(const std::string& file, const std::string& text) {
  if (file != "-") return write_file_atomically(file, text);
  cli::write_to_stdout(text);
}

/// Before anything is measured: that what is to be written can be, as far as can be seen, and that no two are
/// one. A file that is "-" is the standard output.
void require_outputs(const BenchOptions& options) {
  namespace fs = std::filesystem;
  std::map<fs::path, std::string> option_of;
  const auto note = [&](const char* option, const std::string& file, const std::optional<fs::path>& target) {
    if (!target) return;
    if (const auto [other, is_new] = option_of.emplace(*target, option); !is_new)
      throw CLI::ValidationError(
          option, "found \"" + file + "\", as for " + other->second + ", expected another one");
  };
  for (const auto& [option, file] : {std::pair("--json", options.json_file),
                                     {"--csv", options.csv_file},
                                     {"--growth", options.growth_file},
                                     {"--trace", options.trace_file}})
    if (!file.empty()) note(option, file, file == "-" ? fs::path(file) : require_writable(file));
  if (!options.heatmap_file.empty())
    note("--heatmap", options.heatmap_file, require_writable_picture(options.heatmap_file));
  const std::string& folder = options.pictures_folder;
  if (folder.empty()) return;
  const fs::path picture = fs::path(folder) / "picture.png";
  if (fs::is_directory(folder)) require_writable(picture);
  // A folder cannot be made where a file is to be, nor within one.
  for (fs::path path = fs::weakly_canonical(fs::absolute(picture)).parent_path(); path.has_relative_path();
       path = path.parent_path())
    if (option_of.contains(path)) note("--pictures", folder, path);
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error("cannot make the folder \"" + folder + "\": " + error.message());
}

/// Those that can run; of the others, lines that say why they cannot.
struct Chosen {
  std::vector<const WorkloadEntry*> entries;
  std::string left_out;
};
/// @throws Error if a name was given and nothing that it means can run
Chosen prepare_workloads(const std::vector<std::string>& names) {
  Chosen chosen;
  std::map<std::string, std::string> why_none;  // of what a name means can run; empty where one can
  for (const WorkloadEntry* entry : select_workloads(names)) {
    const std::string reason = entry->prepare ? entry->prepare() : "";
    const bool runs = reason.empty();
    if (runs) chosen.entries.push_back(entry);
    else chosen.left_out += entry->name + ": left out, " + reason + "\n";
    for (const std::string& name : names)
      if (matches(name, *entry) && (runs || !why_none.contains(name))) why_none[name] = reason;
  }
  for (const auto& [name, reason] : why_none)
    if (!reason.empty()) throw Error("found nothing to measure of \"" + name + "\": it " + reason);
  return chosen;
}

/// What is measured, and lines of it shown as soon as they are known.
class Bench {
 public:
  explicit Bench(const BenchOptions& options)
      : options_(options),
        setup_{.width = options.width,
               .height = options.height,
               .options = options.renderer,
               .seed = options.measure.seed} {
    report_.machine = cli::machine_text();
    report_.width = options.width;
    report_.height = options.height;
    report_.threads = options.renderer.threads;
    report_.tile_size = options.renderer.tile_size;
    report_.seed = options.measure.seed;
    if (!options.cores.empty()) report_.cores = allowed_cores();  // sorted, and each once
    report_.instruction_set = name(Renderer(options.renderer).options().instruction_set);
  }

  void run(const std::vector<const WorkloadEntry*>& entries) {
    report_.core_to_core_ns[0] = core_to_core_ns();
    show(report_.machine + "frames             " + setting_text(report_) + "\n\n");
    if (options_.scaling) run_on_more_threads(entries);
    else if (options_.rivals) run_with_rivals(entries);
    else run_alone(entries);
    if (!entries.empty()) measure_noise(*entries.front());
  }
  void measure_rates() {
    constexpr std::uint64_t kBandwidthTestBytes = std::uint64_t{256} << 20,
                            kTileBytes = std::uint64_t{64} << 10;
    const std::uint64_t frame =
        4 * static_cast<std::uint64_t>(report_.width) * static_cast<std::uint64_t>(report_.height);
    const auto rate_of = [](Roofline limit, int threads, std::uint64_t bytes) -> std::optional<double> {
      try {
        return measure_bandwidth(limit, threads, bytes);
      } catch (const std::bad_alloc&) {
        return {};  // what was measured before is worth more
      }
    };
    const auto rate = [&](Roofline limit, std::uint64_t bytes) {
      return rate_of(limit, report_.threads, bytes);
    };
    report_.bandwidth = {.l1_stores = rate(Roofline::l1_stores, 0),
                         .frame_stores = rate(Roofline::memory_stores, frame),
                         .frame_copies = rate(Roofline::memory_copies, 2 * frame),
                         .tile_stores = rate(Roofline::memory_stores,
                                             kTileBytes * static_cast<std::uint64_t>(report_.threads)),
                         .memory_stores = rate(Roofline::memory_stores, kBandwidthTestBytes),
                         .memory_loads = rate(Roofline::memory_loads, kBandwidthTestBytes),
                         .memory_loads_single_core = rate_of(Roofline::memory_loads, 1, kBandwidthTestBytes)};
    try {
      report_.core_to_core_ns[1] = core_to_core_ns();
    } catch (const std::exception&) {
      // There is no thread or no memory for it: 0, which is not shown.
    }
  }
  void show(const std::string& text) const {
    if (!is_silent()) cli::write_to_stdout(text);
  }
  /// The standard output is for programs.
  bool is_silent() const { return options_.json_file == "-" || options_.csv_file == "-"; }
  const Report& report() const { return report_; }
  bool is_wrong() const { return is_wrong_; }

 private:
  void run_alone(const std::vector<const WorkloadEntry*>& entries) {
    show(table_heading());
    for (const WorkloadEntry* entry : entries) {
      Candidate candidate = candidate_of(*entry);
      if (!options_.pictures_folder.empty())
        candidate.validate = [&](const Picture& picture) {
          write_picture(picture, options_.pictures_folder + "/" + entry->name + ".png");
          return std::string();
        };
      Row row = measure(std::vector{candidate}, with_rooflines(options_.measure), counters_).front();
      show(table_line(row));
      is_wrong_ |= !row.fault.empty();
      report_.rows.push_back(std::move(row));
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
      std::optional<Comparison> fought =
          compare_with_rival(*entry, setup_, options_.driver, options_.measure, counters_);
      if (!fought) {
        without_rival += " " + entry->name;
        continue;
      }
      show(comparison_line(*fought));
      is_wrong_ |= !fought->fault().empty();
      rival_comparisons.comparisons.push_back(std::move(*fought));
    }
    if (!without_rival.empty()) show("no rival draws:" + without_rival + "\n");
  }
  void run_on_more_threads(const std::vector<const WorkloadEntry*>& entries) {
    CoreModel& model = report_.core_model.emplace(measure_core_model(report_.threads));
    model.bandwidth_saturating_cores = options_.memory_cores;
    show(
        formatted("one core copies %.1f GB/s, and %d of them are taken to copy all that the memory does "
                  "(--memory-cores); a stage begins in %.1f microseconds\n\n",
                  model.core_gb_per_second, model.bandwidth_saturating_cores, 1e6 * model.barrier_seconds));
    show(scaling_heading(report_.threads));
    for (const WorkloadEntry* entry : entries) {
      report_.scaling.push_back(
          scaling_of(*entry, setup_, report_.threads, model, options_.measure, counters_));
      show(scaling_line(report_.scaling.back()));
      is_wrong_ |= !report_.scaling.back().fault.empty() || !report_.scaling.back().not_computed.empty();
    }
  }
  void measure_noise(const WorkloadEntry& entry) {
    const std::vector<Row> rows =
        measure(std::vector<Candidate>(2, candidate_of(entry)), options_.measure, counters_);
    report_.noise_of = entry.name;
    if (rows[0].frames != 0) report_.noise = ratio_of(rows[1].ms, rows[0].ms);
  }
  static MeasureOptions with_rooflines(MeasureOptions options) {
    return options.measures_rooflines = true, options;
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
  bool is_wrong_ = false;
};

void trace(const BenchOptions& options, const std::vector<const WorkloadEntry*>& entries) {
  const WorkloadSetup setup{.width = options.width,
                            .height = options.height,
                            .options = options.renderer,
                            .seed = options.measure.seed};
  std::vector<TracedFrame> frames;
  if (!options.trace_file.empty())
    for (const WorkloadEntry* entry : entries) {
      frames.push_back(trace_frame(*entry, setup));
      if (frames.back().tasks.empty())
        std::cerr << entry->name << ": no renderer draws it, so its trace is empty\n";
    }
  std::optional<Heatmap> map;
  if (!options.heatmap_file.empty()) {
    map = heatmap(measure_task_costs(*entries.front(), setup, options.renderer.threads));
    if (map->picture.rgba.empty())
      throw Error(entries.front()->name + ": no renderer draws it, so there is no heatmap of its tiles");
  }
  if (!options.trace_file.empty()) write(options.trace_file, chrome_trace(frames));
  if (!map) return;
  write_picture(map->picture, options.heatmap_file);
  (options.trace_file == "-" ? std::cerr : std::cout)
      << formatted("%s: white is %.2f ns a pixel\n", options.heatmap_file.c_str(), map->max_ns_per_pixel);
}

void show_growth(const BenchOptions& options) {
  const HardwareCounters counters;
  const ThreadLimit limit(options.renderer.threads);
  const WorkloadSetup setup{.width = options.width,
                            .height = options.height,
                            .options = options.renderer,
                            .seed = options.measure.seed};
  const std::vector<Growth> all = measure_growth(setup, options.measure, counters);
  (options.growth_file == "-" ? std::cerr : std::cout) << growth_table(all);
  write(options.growth_file, growth_svg(all));
}

/// @throws CLI::ValidationError if this process may not use each of them
void require_affinity(const std::vector<int>& cores) {
  const auto listed = [](const std::vector<int>& list) {
    std::string text;
    for (const int core : list) text += (text.empty() ? "" : ",") + std::to_string(core);
    return text;
  };
  const std::vector<int> allowed = allowed_cores();
  std::vector<int> others;
  std::copy_if(cores.begin(), cores.end(), std::back_inserter(others),
               [&](int core) { return std::find(allowed.begin(), allowed.end(), core) == allowed.end(); });
  if (!others.empty())
    throw CLI::ValidationError(
        "--cores",
        "found " + listed(others) + ", which this process may not use, expected some of " + listed(allowed));
  if (!set_thread_affinity(cores))
    throw Error("the system does not keep this process on the cores " + listed(cores));
}

int run(BenchOptions& options) {
  if (options.list) {
    for (const WorkloadEntry& entry : workloads()) {
      const std::string lacks = entry.lacks ? entry.lacks() : "";
      std::printf("%-22s %s%s%s\n", entry.name.c_str(), entry.what.c_str(),
                  entry.is_in_mean ? "" : " (beside the mean)", lacks.empty() ? "" : (": " + lacks).c_str());
    }
    return 0;
  }
  std::optional<BaselineRun> earlier;  // which has to be there before anything is measured
  if (!options.compare_file.empty()) {
    earlier.emplace(options.compare_file);
    earlier->require_size(options.width, options.height);
  }
  const Chosen chosen = prepare_workloads(options.names);
  if (options.growth_file.empty()) std::cerr << chosen.left_out;
  if (earlier && !earlier->has_any_of(chosen.entries))
    throw Error(options.compare_file + ": found none of the workloads to be measured, expected one at least");
  if (!options.heatmap_file.empty() && chosen.entries.size() != 1)
    throw CLI::ValidationError("--heatmap",
                               "found " + std::to_string(chosen.entries.size()) + " workloads, expected 1");
  require_outputs(options);
  if (!options.cores.empty()) require_affinity(options.cores);
  if (options.renderer.threads == 0) options.renderer.threads = available_cores();
  if (!options.growth_file.empty()) return show_growth(options), 0;
  if (!options.trace_file.empty() || !options.heatmap_file.empty()) {
    const ThreadLimit limit(options.renderer.threads);
    return trace(options, chosen.entries), 0;
  }
  Bench bench(options);  // and its counters, before any thread is started
  const ThreadLimit limit(options.renderer.threads);
  if (!options.pictures_folder.empty()) make_folder(options.pictures_folder);
  bench.run(chosen.entries);
  bench.measure_rates();
  bench.show(table_summary(bench.report()));
  if (!options.json_file.empty()) write(options.json_file, report_json(bench.report()).dump(2) + "\n");
  if (!options.csv_file.empty()) write(options.csv_file, report_csv(bench.report()));
  if (bench.is_wrong()) return kFailed;
  if (!earlier) return 0;
  const BaselineComparison comparison = earlier->compare(bench.report(), options.allowed);
  (bench.is_silent() ? std::cerr : std::cout) << "\n" << comparison.table;
  return comparison.has_regressed ? kRegressed : 0;
}

}  // namespace
}  // namespace tessera::bench

int main(int argc, char** argv) {
  CLI::App program("Measures what frames cost on this machine.", "tessera bench");
  program.footer(tessera::bench::kExamples);
  tessera::bench::BenchOptions options;
  tessera::bench::add_options(program, options);
  const auto run = [&] {
    try {
      program.parse(argc, argv);
    } catch (const CLI::Success& asked) {
      return program.exit(asked);  // --help
    }
    return tessera::bench::run(options);
  };
  try {
    const int code = run();
    if (code == 0) tessera::program::cli::require_stdout_written();
    return code;
  } catch (const CLI::ParseError& error) {
    std::cerr << "tessera bench: error: " << error.what() << " (see tessera bench --help)\n";
    return tessera::bench::kBadUsage;
  } catch (const std::bad_alloc&) {
    std::cerr << "tessera bench: error: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "tessera bench: error: " << error.what() << "\n";
  }
  return tessera::bench::kFailed;
}
