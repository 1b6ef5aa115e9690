// Options of `tessera color`.
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

#include "engine/program/cli/choice_option.h"
#include "engine/program/cli/color_space_choice.h"
#include "engine/program/cli/color_values.h"
#include "engine/program/cli/command_options.h"
#include "engine/program/cli/given_options.h"
#include "engine/program/cli/validators.h"
#include "engine/tessera/types.hpp"

namespace tessera::program::cli {
namespace {

constexpr const char* kColorExamples = R"(Examples:
  tessera color 0.5 1 1 --to hsv                  180 0.5 1
  tessera color '#80ff00' --to oklab
  tessera color 182 156 137 161 57 152 --from photoycc-8 --to rgb
  tessera color 1 1 1 --from trinitron-9300 --to rgb --adapt bradford
  tessera color 0.5 0.5 0.5 --from rgb:curve=bt1886,black=0.001 --to xyz
  tessera color --from rgb --to lab < colors.txt  one colour per line
  tessera color --list                            units, ranges and sources)";

/// Names and ranges of all spaces, for --help.
std::string spaces_help() {
  std::string text = "\nSpaces:\n";
  for (const NamedColorSpace& named : color_spaces()) {
    std::string line = "  " + std::string(named.name);
    line.resize(18, ' ');
    text += line + components_text(named) + "\n";
  }
  text.pop_back();
  return text;
}

void add_spaces(CLI::App& command, ColorRequest& request) {
  add_parsed(command, "--from", request.from, parse_color_space,
             "space of VALUES, one of those below; default: rgb")
      ->option_text("SPACE");
  add_parsed(
      command, "--to", request.to, parse_color_space,
      "space to convert to; no default. Spaces of R'G'B' (rgb to hitachi-9300) take another curve after a "
      "colon: curve=srgb, bt709, bt1886, bt1886-1, linear or an exponent; and black=LIGHT, the light of "
      "black over white's, for the BT.1886 curves")
      ->option_text("SPACE");
}

std::vector<ColorValues> given_colors(const ColorRequest& request) {
  try {
    return parse_colors(request.words, request.from);
  } catch (const Error& error) {
    throw UsageError(std::string("VALUES: ") + error.what());
  }
}

/// Fills in what depends on several options.
void complete(const CLI::App& command, ColorRequest& request, bool adapts) {
  if (command.remaining_size() > 0) return;  // reported as unexpected
  if (request.list)
    return GivenOptions(command).allow_only({"--list", "--json"}, "has no effect with --list");
  if (!request.to)
    throw CLI::ValidationError("--to", "found no space, expected one of " + color_space_names());
  if (adapts) request.from.space.adaptation = ChromaticAdaptation::bradford;
  if (!request.words.empty()) request.given = given_colors(request);
  else if (::isatty(STDIN_FILENO) != 0)
    throw CLI::ValidationError("VALUES",
                               "found no colours, expected 3 values per colour, or colours on the "
                               "standard input");
}

}  // namespace

CLI::App* add_color(CLI::App& program, ColorRequest& request) {
  CLI::App* command = program.add_subcommand("color", "Convert colours between colour spaces");
  command->footer(kColorExamples + ("\n" + spaces_help()));
  command->option_defaults()->take_last();
  command
      ->add_option(
          "values", request.words,
          "colours to convert: three numbers each, or #RRGGBB for R'G'B'; none: one colour per line of "
          "the standard input")
      ->option_text("[VALUES...]")
      ->take_all();
  request.from = *find_color_space("rgb");
  add_spaces(*command, request);
  const auto adaptation = std::make_shared<std::string>("none");
  command
      ->add_option("--adapt", *adaptation,
                   "what happens to a white other than the target's: none keeps its light, so that 9300 K is "
                   "bluish in rgb; bradford makes it the target's white; default: none")
      ->option_text("none|bradford")
      ->check(one_of({"none", "bradford"}));
  command->add_flag("--list", request.list, "list the colour spaces with units, ranges and sources");
  command->add_flag("--json", request.json, "print JSON, with all digits");
  command->parse_complete_callback(
      [command, &request, adaptation] { complete(*command, request, *adaptation == "bradford"); });
  return command;
}

}  // namespace tessera::program::cli
