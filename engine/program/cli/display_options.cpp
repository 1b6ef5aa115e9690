// Options of `tessera display`, and those of `tessera render` that concern a display.
#include <algorithm>
#include <string>
#include <vector>

#include "engine/program/cli/choice_option.h"
#include "engine/program/cli/command_options.h"
#include "engine/program/cli/given_options.h"
#include "engine/program/cli/output.h"
#include "engine/program/cli/parse_overrides.h"
#include "engine/program/cli/printable.h"
#include "engine/program/cli/shown_pictures.h"
#include "engine/program/cli/validators.h"
#include "engine/program/scene/file_extension.h"
#include "engine/program/scene/scene_mode.h"

namespace tessera::program::cli {
namespace {

constexpr const char* kDisplayExamples = R"(Examples:
  tessera display picture.png --display vga14 -o screen.png        on a VGA monitor of 14 inches
  tessera display cga.png --mode cga --display cga -o tube.png     on the monitor of a CGA
  tessera display a.png --display crt:pitch=0.31,mask=slots --part 100,80,12,9 --scale 100 -o near.png
  tessera display f*.png --display lcd-laptop -o 'lcd_{frame}.png'  frames in order
  tessera display p.png --mode cga-hi --display cga-composite -o artifacts.png --signal lines.pfm
  tessera display --presets -o screens            the teapot on all presets, with a contact sheet
  tessera display --presets truck.glb --near 0.7,0.4 -o screens
  tessera display --list                          kinds, parameters and presets)";

void add_display_name(CLI::App& command, DisplayRequest& request) {
  add_parsed(command, "--display", request.display, named_display,
             "display that shows the picture: a kind (crt, lcd, plasma, eink, ntsc, pal) or a preset, with "
             "parameters (crt:pitch=0.31,mask=grille); tessera display --list has all; no default")
      ->option_text("DISPLAY[:KEY=VALUE,...]");
}

void add_view(CLI::App& command, DisplayRequest& request) {
  command
      .add_option(
          "--scale", request.view.scale_px_per_mm,
          "pixels of the image per millimetre of the screen, up to 1000; default: as many as give 1440 rows")
      ->option_text("PX_PER_MM")
      ->check(positive_number());
  add_text(
      command, "--part", [&request](const std::string& text) { parse_part(text, request.view); },
      "part of the screen in millimetres from its upper left corner; default: all of it")
      ->option_text("X,Y,W,H");
  command
      .add_option(
          "--gain", request.view.gain,
          "brightest pixel of a white picture in the image, 0.01 to 100; above 1, bright structure is "
          "clipped; default: 1")
      ->option_text("G")
      ->check(number_from(.01, 100));
  command
      .add_option("--frame-ms", request.frame_ms,
                  "milliseconds from each picture to the next; default: one frame of the mode")
      ->option_text("MS")
      ->check(positive_number());
}

void add_pictures(CLI::App& command, DisplayCommandRequest& request) {
  command
      .add_option(
          "pictures", request.pictures,
          "pictures of the size of the mode; several are frames in order. With --presets: a scene or a "
          "model; default: the built-in scene")
      ->option_text("[PICTURE...]")
      ->take_all()
      ->check(not_empty("a picture's name"));
  command
      .add_option(
          "-o,--output", request.output.path,
          "image to write: .png, .ppm, ... as for render; .pfm receives linear light (BT.709); {frame} "
          "in the name is the frame's number; - is the standard output (PPM), term the terminal. With "
          "--presets: a folder. No default")
      ->option_text("FILE")
      ->check(not_empty("FILE's name"));
  command
      .add_option("--compression", request.output.compression,
                  "compression of PNG files, 0 (none) to 9 (smallest); default: 3")
      ->option_text("N")
      ->transform(integer_from(0, 9));
  add_parsed(
      command, "--mode", request.mode, named_display_mode,
      "display mode of the pictures: shape of the pixels and timing; a name that tessera modes lists, or "
      "WIDTHxHEIGHTxBITS; default: the pictures' size, square pixels, 60 Hz")
      ->option_text("MODE");
}

void add_signal(CLI::App& command, DisplayCommandRequest& request) {
  command
      .add_option("--signal", request.signal,
                  "file for the lines of the signal of ntsc or pal, with sync and burst, in IRE or mV; .pfm; "
                  "default: none is written")
      ->option_text("FILE.pfm")
      ->check(not_empty("FILE's name"));
}

/// Refuses a signal that the display or the file does not have.
void check_signal(const DisplayCommandRequest& request) {
  const DisplayKind kind = request.display.display->kind;
  if (request.signal.empty()) return;
  if (kind != DisplayKind::ntsc && kind != DisplayKind::pal)
    throw CLI::ValidationError("--signal", "the display has no signal, expected one of kind ntsc or pal");
  if (lower_case_extension(request.signal) != ".pfm")
    throw CLI::ValidationError(
        "--signal", "found " + cli::quoted(request.signal) + ", expected a name that ends in .pfm");
}

/// Refuses modes without pixels.
void check_mode(const DisplayCommandRequest& request) {
  try {
    if (request.mode) video_mode(*request.mode);
  } catch (const Error& error) {
    throw UsageError(std::string("--mode: ") + error.what());
  }
}

void add_presets(CLI::App& command, DisplayCommandRequest& request) {
  command.add_flag("--presets", request.presets,
                   "draw a scene in the typical mode of each preset, show it on the preset's display, and "
                   "write PRESET.png "
                   "(the whole screen), PRESET-near.png (a close-up) and contact.png into the folder -o");
  command
      .add_option_function<std::string>(
          "--near",
          [&request](const std::string& text) {
            const std::vector<double> place = parse_numbers(text, 2, 2);
            const auto is_share = [](double value) { return value >= 0 && value <= 1; };
            if (place.empty() || !std::ranges::all_of(place, is_share))
              throw CLI::ValidationError("--near", "found \"" + text +
                                                       "\", expected X,Y from 0 to 1: shares of the screen's "
                                                       "width and height");
            request.place = {place[0], place[1]};
          },
          "middle of the close-ups of --presets in shares of the screen's width and height, from the upper "
          "left corner; default: 0.53,0.44")
      ->option_text("X,Y");
}

/// Refuses what does not belong to a comparison of presets.
void check_presets(const GivenOptions& given, const DisplayCommandRequest& request) {
  given.allow_only({"--presets", "pictures", "--output", "--near", "--threads"},
                   "excludes --presets, which chooses displays, modes and views");
  if (request.pictures.size() > 1)
    throw UsageError("--presets: found " + std::to_string(request.pictures.size()) +
                     " scenes, expected one or none");
  if (request.output.path.empty() || is_stream(request.output.path))
    throw UsageError("-o: found " +
                     (request.output.path.empty() ? "none" : cli::quoted(request.output.path)) +
                     ", expected a folder");
}

/// Refuses missing operands, and options without effect.
void check_use(const CLI::App& command, const DisplayCommandRequest& request) {
  if (command.remaining_size() > 0) return;  // reported as unexpected
  const GivenOptions given(command);
  if (request.presets) return check_presets(given, request);
  if (request.list) return given.allow_only({"--list", "--json"}, "has no effect with --list");
  const bool is_png = lower_case_extension(request.output.path) == ".png";
  given.require({
      {"--near", request.presets, "needs --presets"},
      {"--json", request.list, "needs --list"},
      {"--compression", is_png, "is for PNG files, and the image is none"},
      {"--frame-ms", request.pictures.size() != 1, "needs more than one picture"},
  });
  if (request.pictures.empty())
    throw UsageError("PICTURE: found none, expected a picture, frames in order, or --list");
  if (!request.display.display)
    throw UsageError("--display: found none, expected a kind or a preset; tessera display --list has all");
  if (request.output.path.empty()) throw UsageError("-o: found none, expected a file");
  check_signal(request);
  check_mode(request);
}

}  // namespace

void add_display_view(CLI::App& command, DisplayRequest& request) {
  add_display_name(command, request);
  add_view(command, request);
}

CLI::App* add_display(CLI::App& program, DisplayCommandRequest& request) {
  CLI::App* command = program.add_subcommand(
      "display", "Show pictures on a simulated tube, panel or television, or list the displays");
  command->footer(kDisplayExamples);
  command->option_defaults()->take_last();
  add_pictures(*command, request);
  add_display_view(*command, request.display);
  command
      ->add_option("--time", request.display.start_ms,
                   "time of the first picture in milliseconds, at least 0; default: 0")
      ->option_text("MS")
      ->check(number_from(0, 1e9));
  add_signal(*command, request);
  command->add_option("--threads", request.threads, "threads; default: TESSERA_THREADS, or all cores")
      ->option_text("N")
      ->transform(integer_from(1, 1024));
  add_presets(*command, request);
  command->add_flag("--list", request.list,
                    "list the kinds with their parameters, units, ranges and sources, and the presets");
  command->add_flag("--json", request.json, "print the list as JSON");
  command->parse_complete_callback([command, &request] { check_use(*command, request); });
  return command;
}

}  // namespace tessera::program::cli
