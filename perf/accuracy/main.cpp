// tessera accuracy: what accuracy costs in time on this machine.
#include <iostream>
#include <new>
#include <optional>

#include "engine/program/cli/command_line.h"
#include "engine/program/cli/standard_output.h"
#include "perf/accuracy/accuracy_run.h"

namespace tessera::accuracy {
namespace {

namespace cli = program::cli;

constexpr const char* kExamples = R"(Examples:
  tessera accuracy -o costs                            all scenes; about seven minutes
  tessera accuracy -o costs --quick                    three scenes; less than a minute
  tessera accuracy -o costs --scenes none mine.json    one scene file)";

int run(int argc, char** argv) {
  CLI::App program(
      "Measures what accuracy costs in time: errors against a double-precision reference, and times of "
      "settings",
      "tessera accuracy");
  cli::set_help(program);
  program.footer(kExamples);
  AccuracyOptions options;
  add_options(program, options);
  if (const std::optional<int> done = cli::parse_arguments(program, argc, argv)) return *done;
  if (options.time_process >= 0) return run_timing(options) ? 0 : cli::kInterrupted;
  cli::write_to_stdout(run_accuracy(options, {argv + 1, argv + argc}));
  cli::require_stdout_written();
  return 0;
}

}  // namespace
}  // namespace tessera::accuracy

int main(int argc, char** argv) {
  using namespace tessera::accuracy;
  try {
    return run(argc, argv);
  } catch (const cli::UsageError& error) {
    return cli::report_usage("tessera accuracy", error.what(), "tessera accuracy");
  } catch (const CLI::ParseError& error) {
    return cli::report_usage("tessera accuracy", error.what(), "tessera accuracy");
  } catch (const tessera::Cancelled&) {
    std::cerr << "tessera accuracy: interrupted; no results were written\n";
    return cli::kInterrupted;
  } catch (const std::bad_alloc&) {
    std::cerr << "tessera accuracy: error: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "tessera accuracy: error: " << error.what() << "\n";
  }
  return cli::kFailed;
}
