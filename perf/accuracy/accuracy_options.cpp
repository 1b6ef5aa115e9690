#include "perf/accuracy/accuracy_options.h"

#include <sstream>

#include "engine/program/cli/validators.h"

namespace tessera::accuracy {

void add_options(CLI::App& program, AccuracyOptions& options) {
  program.option_defaults()->take_last();
  program
      .add_option("files", options.files,
                  "scenes and models to measure in addition to the built-in scenes; default: none")
      ->option_text("[FILE...]")
      ->take_all();
  program
      .add_option("-o,--output", options.folder,
                  "folder for report.html, results.csv, results.json and pictures; required")
      ->option_text("DIR")
      ->check(program::cli::not_empty("DIR's name"))
      ->required();
  program.add_flag("--quick", options.is_quick, "fewer scenes and rounds: less than a minute");
  program
      .add_option("--threads", options.threads, "also measure with N threads, in addition to one; default: 2")
      ->option_text("N")
      ->transform(program::cli::integer_from(1, 1024));
  program
      .add_option("--rounds", options.rounds,
                  "rounds in which settings take turns, 3 to 10000; default: 31, with --quick 9")
      ->option_text("N")
      ->transform(program::cli::integer_from(3, 10000));
  program
      .add_option_function<std::string>(
          "--scenes",
          [&options](const std::string& text) {
            options.scenes.clear();
            std::istringstream names(text);
            for (std::string name; std::getline(names, name, ',');) options.scenes.push_back(name);
          },
          "built-in scenes, by name or prefix; none: only FILES; default: all")
      ->option_text("NAME,...");
  program
      .add_option_function<std::string>(
          "--isa",
          [&options](const std::string& text) {
            for (const InstructionSet set : available_instruction_sets())
              if (name(set) == text) {
                options.instruction_set = set;
                return;
              }
            throw CLI::ValidationError(
                "--isa", "found \"" + text +
                             "\", expected an instruction set of this machine: scalar, avx2 or avx512");
          },
          "instruction set; default: the best of this machine")
      ->option_text("scalar|avx2|avx512");
  program.add_option("--time-process", options.time_process)->group("");  // for the program's own processes
}

}  // namespace tessera::accuracy
