// tessera accuracy: what accuracy costs in time on this machine.
#include <iostream>
#include <new>

#include "engine/program/cli/standard_output.h"
#include "perf/accuracy/accuracy_run.h"

namespace tessera::accuracy {
namespace {

// Exit codes.
constexpr int kFailed = 1, kBadUsage = 2, kInterrupted = 130;

constexpr const char* kExamples = R"(examples:
  tessera accuracy -o costs                            all scenes; about seven minutes
  tessera accuracy -o costs --quick                    three scenes; less than a minute
  tessera accuracy -o costs --scenes none mine.json    one scene file)";

int run(int argc, char** argv) {
  CLI::App program(
      "Measures what accuracy costs in time: errors against a double-precision reference, and times of "
      "settings.",
      "tessera accuracy");
  program.footer(kExamples);
  AccuracyOptions options;
  add_options(program, options);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return program.exit(success);  // --help
  }
  if (options.time_process >= 0) return run_timing(options) ? 0 : kInterrupted;
  program::cli::write_to_stdout(run_accuracy(options, {argv + 1, argv + argc}));
  program::cli::require_stdout_written();
  return 0;
}

}  // namespace
}  // namespace tessera::accuracy

int main(int argc, char** argv) {
  using namespace tessera::accuracy;
  try {
    return run(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::cerr << "tessera accuracy: error: " << error.what() << " (see tessera accuracy --help)\n";
    return kBadUsage;
  } catch (const tessera::Cancelled&) {
    std::cerr << "tessera accuracy: interrupted; no results were written\n";
    return kInterrupted;
  } catch (const std::bad_alloc&) {
    std::cerr << "tessera accuracy: error: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "tessera accuracy: error: " << error.what() << "\n";
  }
  return kFailed;
}
