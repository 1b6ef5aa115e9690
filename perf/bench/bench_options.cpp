#include "perf/bench/bench_options.h"

#include <charconv>
#include <limits>
#include <string_view>
#include <type_traits>

#include "engine/program/cli/given_options.h"

namespace tessera::bench {
namespace {

using program::cli::GivenOptions;

/// Parses the whole text as a number from `min` to `max`. NaN is out of range.
template <class Number>
bool parse_number(std::string_view text, std::type_identity_t<Number> min, std::type_identity_t<Number> max,
                  Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number && number >= min && number <= max;
}

bool parse_size(std::string_view text, BenchOptions& options) {
  const std::size_t x = text.find('x');
  return x != std::string_view::npos &&
         parse_number(text.substr(0, x), 1, kMaxFrameBufferSize, options.width) &&
         parse_number(text.substr(x + 1), 1, kMaxFrameBufferSize, options.height);
}

bool parse_cores(std::string_view text, std::vector<int>& cores) {
  constexpr int kMaxCore = 1023;
  for (;;) {
    const std::size_t comma = text.find(',');
    int core = 0;
    if (!parse_number(text.substr(0, comma), 0, kMaxCore, core)) return false;
    cores.push_back(core);
    if (comma == std::string_view::npos) return true;
    text.remove_prefix(comma + 1);
  }
}

/// Adds an option that is parsed by parse(text). If that returns false, the error is "found TEXT, expected ",
/// followed by `form` and `limits`.
/// @param limits  range of the value, if `form` does not contain it
template <class Parse>
CLI::Option* add_text(CLI::App& program, const std::string& name, const std::string& form,
                      const std::string& help, const Parse& parse, const std::string& limits = "") {
  const auto take = [name, form, parse, limits](const std::string& text) {
    if (!parse(text)) throw CLI::ValidationError(name, "found \"" + text + "\", expected " + form + limits);
  };
  return program.add_option_function<std::string>(name, take, help)->option_text(form);
}
CLI::Option* add_integer(CLI::App& program, const std::string& name, const std::string& help, int max,
                         int& number) {
  return add_text(
      program, name, "N", help,
      [max, &number](const std::string& text) { return parse_number(text, 1, max, number); },
      ", 1 to " + std::to_string(max));
}
CLI::Option* add_path(CLI::App& program, const std::string& name, const std::string& form,
                      const std::string& help, std::string& path) {
  const auto parse = [&path](const std::string& text) {
    path = text;
    return !text.empty();
  };
  return add_text(program, name, form, help, parse, " to be a non-empty name");
}

void add_selection_options(CLI::App& program, BenchOptions& options) {
  program.add_option("workloads", options.names, "names of workloads, or prefixes of them; default: all")
      ->option_text("[WORKLOAD...]")
      ->take_all();
  program.add_flag("--list", options.list, "list all workloads");
}

bool parse_tile_size(std::string_view text, int& tile_size) {
  return parse_number(text, 32, 128, tile_size) && (tile_size & (tile_size - 1)) == 0;
}

bool parse_instruction_set(std::string_view text, InstructionSet& instruction_set) {
  for (const InstructionSet set : {InstructionSet::scalar, InstructionSet::avx2, InstructionSet::avx512})
    if (name(set) == text) {
      instruction_set = set;
      return true;
    }
  return false;
}

void add_renderer_options(CLI::App& program, BenchOptions& options) {
  add_text(
      program, "--size", "WIDTHxHEIGHT", "size of the frames in pixels, each 1 to 16384; default: 1920x1080",
      [&options](const std::string& text) { return parse_size(text, options); },
      ", each 1 to " + std::to_string(kMaxFrameBufferSize));
  add_integer(program, "--threads", "number of threads, 1 to 1024; default: TESSERA_THREADS, or all cores",
              1024, options.renderer.threads)
      ->envname("TESSERA_THREADS");
  add_text(
      program, "--cores", "N[,N...]", "logical CPUs to bind the process to; default: all",
      [&options](const std::string& text) { return parse_cores(text, options.cores); }, ", each 0 to 1023");
  add_text(program, "--tile-size", "32|64|128", "tile size in pixels; default: chosen per frame",
           [&options](const std::string& text) { return parse_tile_size(text, options.renderer.tile_size); });
  add_text(program, "--isa", "scalar|avx2|avx512", "instruction set; default: the best of this machine",
           [&options](const std::string& text) {
             return parse_instruction_set(text, options.renderer.instruction_set);
           });
}

void add_measurement_options(CLI::App& program, BenchOptions& options) {
  constexpr auto kMaxSeed = std::numeric_limits<decltype(options.measure.seed)>::max();
  add_integer(program, "--repeats", "frames per workload; default: as many as fit in --seconds, at least 15",
              1000000, options.measure.repeats);
  add_text(
      program, "--seconds", "S",
      "seconds per workload (without --repeats), and a fifth of that for reference work in turns with it; at "
      "most per roofline; --scaling takes twice that per predicted core count; default: 1",
      [&options](const std::string& text) {
        return parse_number(text, 0.001, 3600, options.measure.seconds);
      },
      ", 0.001 to 3600");
  add_text(
      program, "--seed", "N", "seed for random workloads and for the order of turns; default: 1",
      [&options](const std::string& text) { return parse_number(text, 0, kMaxSeed, options.measure.seed); },
      ", 0 to " + std::to_string(kMaxSeed));
}

/// Options that select another measurement than rows of single workloads.
void add_mode_options(CLI::App& program, BenchOptions& options) {
  program.add_flag("--rivals", options.rivals,
                   "compare with Mesa, in turns (needs the Debian package libosmesa6)");
  add_text(program, "--driver", "llvmpipe|softpipe", "Mesa driver for --rivals; default: llvmpipe",
           [&options](const std::string& text) {
             options.driver =
                 text == "softpipe" ? rivals::MesaDriver::softpipe : rivals::MesaDriver::llvmpipe;
             return text == "llvmpipe" || text == "softpipe";
           });
  program.add_flag("--scaling", options.scaling,
                   "speed-up on more cores: measured up to --threads, "
                   "predicted for 2 to 128 from the cost of tasks");
  program.add_flag("--machine", options.machine,
                   "also measure the machine: its noise, memory bandwidth, latency between cores, and the "
                   "roofline of each workload that has one; takes about 10 times --seconds, and twice "
                   "--seconds per fill");
  add_integer(program, "--memory-cores", "cores that saturate memory bandwidth, for --scaling; default: 8",
              1024, options.memory_cores);
  add_path(
      program, "--growth", "FILE",
      "SVG plot of time and memory over triangles, pixels, lights and draws, and a table with the slopes in "
      "words; nothing else is measured; "
      "default: none",
      options.growth_file);
  add_path(program, "--trace", "FILE",
           "trace of the tasks of one frame per workload, for chrome://tracing and ui.perfetto.dev; nothing "
           "else is measured; default: none",
           options.trace_file);
  add_path(
      program, "--heatmap", "FILE",
      "picture of one workload: the frame, next to it the cost of each tile, and a key with units; nothing "
      "else is measured; default: none",
      options.heatmap_file);
}

void add_output_options(CLI::App& program, BenchOptions& options) {
  add_path(program, "--json", "FILE",
           "all results as JSON; - is the standard output; default: none is written", options.json_file);
  add_path(program, "--csv", "FILE",
           "one row per workload as CSV; - is the standard output; default: none is written",
           options.csv_file);
  add_path(program, "--pictures", "DIR",
           "folder for the picture of each workload, WORKLOAD.png; default: none is written",
           options.pictures_folder);
  add_path(
      program, "--compare", "FILE",
      "earlier --json file: shows ratios to it with their intervals; exits with 3 if the whole interval "
      "of a row is beyond --allowed; rows that look slower are measured up to 3 more times; default: none",
      options.compare_file);
  add_text(
      program, "--allowed", "SHARE", "share by which a frame may take longer; default: 0.1 (10 %)",
      [&options](const std::string& text) { return parse_number(text, 0, 100, options.allowed); },
      ", 0 to 100");
}

/// Refuses options without effect.
void check_use(const CLI::App& program, const BenchOptions& options) {
  if (program.remaining_size() > 0) return;  // reported as unexpected
  const GivenOptions given(program);
  // TESSERA_THREADS counts as --threads.
  if (options.list) return given.allow_only({"--list", "--threads"}, "has no effect with --list");
  const bool grows = given.has("--growth");
  const bool traces = given.has("--trace") || given.has("--heatmap");
  // Rows of single workloads, which --csv, --pictures and --compare need.
  const bool has_rows = !options.rivals && !options.scaling;
  constexpr std::string_view kNoRows =
      "has no effect with --rivals and --scaling, which measure no single workloads";
  constexpr std::string_view kOwnFile =
      "has no effect with --growth, --trace and --heatmap, which write to their own file only";
  constexpr std::string_view kOneFrame = "has no effect with --trace and --heatmap, which draw one frame";
  given.require({
      {"--driver", options.rivals, "needs --rivals"},
      {"--memory-cores", options.scaling, "needs --scaling"},
      {"--allowed", given.has("--compare"), "needs --compare, the earlier results"},
      {"--scaling", !options.rivals, "excludes --rivals"},
      {"--csv", has_rows, kNoRows},
      {"--pictures", has_rows, kNoRows},
      {"--compare", has_rows, kNoRows},
      {"--rivals", !grows && !traces, kOwnFile},
      {"--scaling", !grows && !traces, kOwnFile},
      {"--json", !grows && !traces, kOwnFile},
      {"--csv", !grows && !traces, kOwnFile},
      {"--pictures", !grows && !traces, kOwnFile},
      {"--compare", !grows && !traces, kOwnFile},
      {"--machine", !grows && !traces, kOwnFile},
      {"--growth", !traces, "excludes --trace and --heatmap"},
      {"workloads", !grows, "have no effect with --growth, which has its own"},
      {"--repeats", !traces, kOneFrame},
      {"--seconds", !traces, kOneFrame},
  });
}

}  // namespace

void add_options(CLI::App& program, BenchOptions& options) {
  program.option_defaults()->take_last();
  add_selection_options(program, options);
  add_renderer_options(program, options);
  add_measurement_options(program, options);
  add_mode_options(program, options);
  add_output_options(program, options);
  program.parse_complete_callback([&program, &options] { check_use(program, options); });
}

}  // namespace tessera::bench
