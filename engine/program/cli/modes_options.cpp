// Options of `tessera modes`.
#include <string>
#include <string_view>
#include <vector>

#include "engine/program/cli/choice_option.h"
#include "engine/program/cli/command_options.h"
#include "engine/program/cli/given_options.h"
#include "engine/program/cli/mode_selection.h"
#include "engine/program/cli/validators.h"
#include "engine/program/scene/dither_names.h"

namespace tessera::program::cli {
namespace {

constexpr const char* kModesExamples = R"(Examples:
  tessera modes                                   all named modes
  tessera modes --diagonal 17 --pitch 0.28        the standard mode of a screen
  tessera modes --json > modes.json
  tessera modes scene.json -o compared            a scene in all modes, with all dithers
  tessera modes truck.glb -o compared --modes cga,ega,640x480x12 --dithers none,bayer8)";

void add_screen_options(CLI::App& command, ModesRequest& request) {
  command
      .add_option("--diagonal", request.diagonal_in,
                  "diagonal of a 4:3 screen in inches, with --pitch; default: all modes are listed")
      ->option_text("INCHES")
      ->check(positive_number());
  command
      .add_option("--pitch", request.pitch_mm,
                  "distance of its dots of one colour in millimetres, with --diagonal; no default")
      ->option_text("MM")
      ->check(positive_number());
}

void add_mode_comparison(CLI::App& command, ModeComparisonRequest& request) {
  command
      .add_option("input", request.input,
                  "scene or model to draw in all modes, with -o; default: the built-in scene")
      ->option_text("[SCENE.json | MODEL]")
      ->check(not_empty("a scene's or a model's name"));
  add_import_limits(command, request.import);
  command
      .add_option("-o,--output", request.folder,
                  "folder for the scene in every mode with every dither: MODE-DITHER.png, contact.png, "
                  "modes.csv, modes.json; the table is also printed; default: none is drawn")
      ->option_text("DIR")
      ->check(not_empty("DIR's name"));
  add_parsed(
      command, "--modes", request.modes, parse_modes,
      "modes to compare, with parameters (cga:palette=0) or as WIDTHxHEIGHTxBITS; default: all named modes "
      "with pixels")
      ->option_text("MODE,...");
  add_parsed(command, "--dithers", request.dithers, parse_dithers,
             "dithers to compare: " + dither_name_list(", ") + "; default: all")
      ->option_text("DITHER,...");
  add_choice<DitherSpace, DitherSpace>(
      command, "--dither-in", request.dither_in,
      {{"levels", DitherSpace::levels}, {"light", DitherSpace::light}},
      "what the dithers preserve on average: stored values, or the light of a display; default: levels");
  command.add_option("--threads", request.threads, "threads of -o; default: TESSERA_THREADS, or all cores")
      ->option_text("N")
      ->transform(integer_from(1, 1024));
}

/// Refuses options of another use of the command than the one asked for.
void check_use(const CLI::App& command, const ModesRequest& request) {
  if (command.remaining_size() > 0) return;  // reported as unexpected
  const GivenOptions given(command);
  const bool compares = given.has("--output");
  const bool dithers = request.comparison.dithers != std::vector{Dither::none};
  constexpr std::string_view kNeeded = "needs -o DIR, the folder for pictures and tables";
  if (!compares && given.has("input"))
    throw UsageError(request.comparison.input + ": " + std::string(kNeeded));
  given.require({
      {"--import-memory", compares, kNeeded},
      {"--import-seconds", compares, kNeeded},
      {"--modes", compares, kNeeded},
      {"--dithers", compares, kNeeded},
      {"--dither-in", compares, kNeeded},
      {"--threads", compares, kNeeded},
      {"--dither-in", dithers, "has no effect with --dithers none"},
      {"--diagonal", !compares, "finds the mode of a screen, excludes -o"},
      {"--diagonal", given.has("--pitch"), "needs --pitch, the distance of the screen's dots"},
      {"--pitch", given.has("--diagonal"), "needs --diagonal, the size of the screen"},
  });
  check_import_options(given, request.comparison.input);
}

}  // namespace

CLI::App* add_modes(CLI::App& program, ModesRequest& request) {
  CLI::App* command = program.add_subcommand(
      "modes",
      "List the display modes of render --mode, find the standard mode of a screen, or draw a scene in all "
      "modes to compare them");
  command->footer(kModesExamples);
  command->option_defaults()->take_last();
  add_screen_options(*command, request);
  add_mode_comparison(*command, request.comparison);
  command->add_flag("--json", request.json, "print JSON");
  command->parse_complete_callback([command, &request] { check_use(*command, request); });
  return command;
}

}  // namespace tessera::program::cli
