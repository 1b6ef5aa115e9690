#include "perf/bench/bench_options.h"

#include <charconv>
#include <limits>
#include <string_view>
#include <type_traits>

namespace tessera::bench {
namespace {

// All of a text as a number within bounds, which NaN is not.
template <class Number>
bool parse_number(std::string_view text, std::type_identity_t<Number> least,
                  std::type_identity_t<Number> most, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number >= least && number <= most;
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

// Makes parse(text) out of the option, which says what it expects where that is false. @param limits  what
// the form does not tell of that
template <class Parse>
CLI::Option* add_text(CLI::App& program, const std::string& name, const std::string& form,
                      const std::string& what, const Parse& parse, const std::string& limits = "") {
  const auto take = [name, form, parse, limits](const std::string& text) {
    if (!parse(text)) throw CLI::ValidationError(name, "found \"" + text + "\", expected " + form + limits);
  };
  return program.add_option_function<std::string>(name, take, what)->option_text(form);
}
CLI::Option* add_integer(CLI::App& program, const std::string& name, const std::string& what, int most,
                         int& number) {
  return add_text(
      program, name, "N", what,
      [most, &number](const std::string& text) { return parse_number(text, 1, most, number); },
      ", 1 to " + std::to_string(most));
}
CLI::Option* add_path(CLI::App& program, const std::string& name, const std::string& form,
                      const std::string& what, std::string& path) {
  return add_text(
      program, name, form, what, [&path](const std::string& text) { return path = text, !text.empty(); },
      "'s name");
}

}  // namespace

void add_options(CLI::App& program, BenchOptions& options) {
  constexpr auto kMaxSeed = std::numeric_limits<decltype(options.measure.seed)>::max();
  program.option_defaults()->take_last();
  CLI::Option* const names = program
                                 .add_option("workloads", options.names,
                                             "those to run, or the beginnings of their names; default: all")
                                 ->option_text("[WORKLOAD...]")
                                 ->take_all();
  program.add_flag("--list", options.list, "say what workloads there are");
  add_text(
      program, "--size", "WIDTHxHEIGHT", "size of the frames; default: 1920x1080",
      [&options](const std::string& text) { return parse_size(text, options); },
      ", each 1 to " + std::to_string(kMaxFrameBufferSize));
  add_integer(program, "--threads", "threads; default: TESSERA_THREADS, or one for each core", 1024,
              options.renderer.threads)
      ->envname("TESSERA_THREADS");
  add_text(
      program, "--cores", "N[,N...]", "cores that everything is kept on; default: all",
      [&options](const std::string& text) { return parse_cores(text, options.cores); }, ", each 0 to 1023");
  add_text(program, "--tile-size", "32|64|128", "pixels of a tile's side; default: chosen by the frame",
           [&options](const std::string& text) {
             return parse_number(text, 32, 128, options.renderer.tile_size) &&
                    (options.renderer.tile_size & (options.renderer.tile_size - 1)) == 0;
           });
  add_text(program, "--isa", "scalar|avx2|avx512", "instruction set; default: the best that this machine has",
           [&options](const std::string& text) {
             for (const InstructionSet set :
                  {InstructionSet::scalar, InstructionSet::avx2, InstructionSet::avx512})
               if (name(set) == text) return options.renderer.instruction_set = set, true;
             return false;
           });
  add_integer(program, "--repeats", "frames of each workload; default: a second of them, 15 at least",
              1000000, options.measure.repeats);
  add_text(
      program, "--seconds", "S",
      "of frames for each workload, if --repeats does not say how many, of limits beside them, and, twice, "
      "of what --scaling computes; default: 1",
      [&options](const std::string& text) {
        return parse_number(text, 0.001, 3600, options.measure.seconds);
      },
      ", 0.001 to 3600");
  add_text(
      program, "--seed", "N", "of what is random in workloads, and of the order of turns; default: 1",
      [&options](const std::string& text) { return parse_number(text, 0, kMaxSeed, options.measure.seed); },
      ", 0 to " + std::to_string(kMaxSeed));
  CLI::Option* const rivals = program.add_flag(
      "--rivals", options.rivals, "ratios to Mesa, drawing the same in turns (needs libosmesa6)");
  CLI::Option* const driver = add_text(
      program, "--driver", "llvmpipe|softpipe", "Mesa's, of --rivals; default: llvmpipe",
      [&options](const std::string& text) {
        options.driver = text == "softpipe" ? rivals::MesaDriver::softpipe : rivals::MesaDriver::llvmpipe;
        return text == "llvmpipe" || text == "softpipe";
      });
  driver->needs(rivals);
  CLI::Option* const scaling = program.add_flag("--scaling", options.scaling,
                                                "how much faster more cores are: measured up to --threads, "
                                                "and computed for 2 to 128 from what tasks cost");
  add_integer(program, "--memory-cores", "cores that keep the memory of computed machines busy; default: 8",
              1024, options.memory_cores)
      ->needs(scaling);
  CLI::Option* const growth = add_path(program, "--growth", "FILE",
                                       "SVG picture of how time and memory grow with triangles, pixels, "
                                       "lights and draws; nothing else is measured",
                                       options.growth_file);
  CLI::Option* const trace = add_path(program, "--trace", "FILE",
                                      "file for a frame of each workload, task by task, as chrome://tracing "
                                      "and ui.perfetto.dev show it; nothing else is measured",
                                      options.trace_file);
  CLI::Option* const heatmap = add_path(
      program, "--heatmap", "FILE", "picture of what each tile of a workload costs; nothing else is measured",
      options.heatmap_file);
  CLI::Option* const json =
      add_path(program, "--json", "FILE", "file for everything that was measured; - is the standard output",
               options.json_file);
  CLI::Option* const csv =
      add_path(program, "--csv", "FILE", "file for the rows; - is the standard output", options.csv_file);
  CLI::Option* const pictures =
      add_path(program, "--pictures", "DIR", "folder for what each workload draws, as WORKLOAD.png",
               options.pictures_folder);
  CLI::Option* const compare = add_path(program, "--compare", "FILE",
                                        "earlier --json file: shows ratios to it, and exits with 3 where a "
                                        "row is slower by more than --allowed",
                                        options.compare_file);
  add_text(
      program, "--allowed", "SHARE", "share by which a row may be slower; default: 0.1",
      [&options](const std::string& text) { return parse_number(text, 0, 100, options.allowed); },
      ", 0 to 100")
      ->needs(compare);
  // What is measured otherwise is not told, or told of otherwise.
  for (CLI::Option* way : {rivals, scaling})
    for (CLI::Option* other : {csv, pictures, compare}) way->excludes(other);
  rivals->excludes(scaling);
  for (CLI::Option* way : {growth, trace, heatmap})
    for (CLI::Option* other : {rivals, scaling, json, csv, pictures, compare}) way->excludes(other);
  for (CLI::Option* other : {trace, heatmap, names}) growth->excludes(other);
}

}  // namespace tessera::bench
