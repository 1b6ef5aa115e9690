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
#include "engine/program/cli/standard_output.h"
#include "engine/program/imageio/atomic_file.h"
#include "engine/program/imageio/picture.h"
#include "engine/program/threads/thread_limit.h"
#include "perf/bench/baseline_run.h"
#include "perf/bench/bench_options.h"
#include "perf/bench/bench_run.h"
#include "perf/bench/cores.h"
#include "perf/bench/frame_costs.h"
#include "perf/bench/growth.h"
#include "perf/bench/heatmap_sheet.h"
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

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error("cannot create the folder \"" + folder + "\": " + error.message());
}

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
  BenchRun bench(options);  // opens the hardware counters: before any thread is started
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
