// Options of `tessera compare`.
#include <cstddef>

#include "engine/program/cli/command_options.h"
#include "engine/program/cli/validators.h"

namespace tessera::program::cli {
namespace {

constexpr const char* kCompareExamples = R"(Examples:
  tessera compare before.png after.png
  tessera compare before.png after.png --map errors.png
  tessera compare before.png after.png --ppd 20 --json)";

}  // namespace

CLI::App* add_compare(CLI::App& program, CompareRequest& request) {
  CLI::App* command = program.add_subcommand(
      "compare",
      "Compare two pictures: largest error, RMS, PSNR, shares of wrong pixels, and FLIP, which predicts how "
      "visible the differences are");
  command->footer(kCompareExamples);
  command->option_defaults()->take_last();
  for (std::size_t i = 0; i < request.pictures.size(); ++i)
    command->add_option(i == 0 ? "A" : "B", request.pictures[i], "picture of the same size as the other")
        ->option_text("FILE")
        ->required()
        ->check(not_empty("a picture's name"));
  command
      ->add_option("--ppd", request.pixels_per_degree,
                   "pixels per degree of the viewer's visual angle, 1 .. 1000, for FLIP; default: 67.02, a "
                   "monitor 0.7 m wide with 3840 pixels per row, seen from 0.7 m")
      ->option_text("N")
      ->check(number_from(kMinPixelsPerDegree, kMaxPixelsPerDegree));
  command
      ->add_option("--map", request.map,
                   "picture to write: the FLIP error of each pixel, from black (0) over purple and orange to "
                   "pale yellow (1); default: none is written")
      ->option_text("FILE")
      ->check(not_empty("FILE's name"));
  command->add_flag("--json", request.json, "print JSON");
  command->add_option("--threads", request.threads, "threads; default: TESSERA_THREADS, or all cores")
      ->option_text("N")
      ->transform(integer_from(1, 1024));
  return command;
}

}  // namespace tessera::program::cli
