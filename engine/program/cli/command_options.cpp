// Options of `tessera render` and `tessera explain`.
#include "engine/program/cli/command_options.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/program/cli/animation_options.h"
#include "engine/program/cli/choice_option.h"
#include "engine/program/cli/parse_overrides.h"
#include "engine/program/cli/validators.h"
#include "engine/program/scene/dither_names.h"
#include "engine/program/scene/file_extension.h"
#include "engine/program/scene/quality_names.h"
#include "engine/program/scene/scene_mode.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {
namespace {

constexpr const char* kRenderExamples = R"(Examples:
  tessera render                                  the built-in teapot, as tessera.png
  tessera render scene.json -o picture.png        a scene
  tessera render truck.glb --size 1280x720        a model, as truck.render.png
  tessera render --palette ega16 -o ega.png       16 colours, nearest entry
  tessera render --mode cga -o cga.png --dump cga.bin              as a CGA stores it
  tessera render --mode vga13h --display vga14 -o tube.png         as its monitor shows it
  tessera render --planes planes --stats          also every bitplane, and statistics
  tessera render scene.json --frames 50 -o 'frame_{frame}.png'     an animation
  tessera render truck.glb --turntable 50 -o truck.png             one turn, as an animated PNG
  tessera render -o term                          the picture in the terminal
  tessera render scene.json --compare right.png --threshold 2      exits with 3 if it differs)";

constexpr const char* kExplainExamples = R"(Examples:
  tessera explain scene.json
  tessera explain scene.json --measure --threads 1
  tessera explain truck.glb --json > effects.json)";

void add_input(CLI::App& command, std::string& input) {
  command.add_option("input", input, "scene or model; default: the built-in scene")
      ->option_text("[SCENE.json | MODEL]")
      ->check(not_empty("a scene's or a model's name"));
}

void add_input_format(CLI::App& command, RenderRequest& request) {
  command
      .add_option(
          "--input-format", request.import.format,
          "format of the input -, standard input: json for a scene, or the extension of a model's file: "
          "stl, glb, ...; no default, the input - needs it")
      ->option_text("FORMAT")
      ->check(not_empty("FORMAT"));
}

void add_output(CLI::App& command, RenderRequest& request) {
  command
      .add_option(
          "-o,--output", request.output.path,
          "picture to write: .png, .ppm, .pgm, .pfm, .raw or another format of OpenImageIO; {frame} in "
          "the name is the frame's number, several frames without it are an animated PNG; - is the standard "
          "output (PPM), term the terminal; default: "
          "INPUT.render.png in the current folder, tessera.png for the built-in scene")
      ->option_text("FILE")
      ->check(not_empty("FILE's name"));
  command
      .add_option("--compression", request.output.compression,
                  "compression of PNG files, 0 (none) to 9 (smallest); default: 3")
      ->option_text("N")
      ->transform(integer_from(0, 9));
}

void add_scene_overrides(CLI::App& command, SceneOverrides& overrides) {
  add_size(command, overrides);
  add_choice<std::optional<Shading>, Shading>(
      command, "--shading", overrides.shading,
      {{"flat", Shading::flat}, {"gouraud", Shading::gouraud}, {"phong", Shading::phong}},
      "shading of every draw; default: the scene's");
  add_parsed(
      command, "--quality", overrides.quality, parse_quality,
      "caps on what draws ask for, in place of the scene's: shading (as_asked, phong_2x2, phong_4x4, "
      "gouraud, flat), renormalize (on, off), viewer (as_asked, infinite), interpolation (perspective, "
      "affine), texture (as_asked, bilinear, nearest), light_threshold (0 to 1); default: the scene's")
      ->option_text("KEY=VALUE,...");
  command
      .add_option("--color-bits", overrides.color_bits, "colour planes, 1 to 24; default: the scene's, or 24")
      ->option_text("N")
      ->transform(integer_from(1, 24));
  command
      .add_option(
          "--palette", overrides.palette,
          "palette; the colour buffer then holds indices. adaptive: chosen for the picture at 24 bits; "
          "ramps: chosen for the materials and lights; default: the scene's, or none")
      ->option_text("bw|gray|ega16|vga256|web216|adaptive|ramps")
      ->check(one_of({"bw", "gray", "ega16", "vga256", "web216", "adaptive", "ramps"}));
  std::vector<Choice<Dither>> dithers;
  for (const auto& [name, dither] : kDithers) dithers.push_back({name, dither});
  add_choice<std::optional<Dither>, Dither>(command, "--dither", overrides.dither, dithers,
                                            "dither of the colours that are stored; default: the scene's");
  add_choice<std::optional<DitherSpace>, DitherSpace>(
      command, "--dither-in", overrides.dither_in,
      {{"levels", DitherSpace::levels}, {"light", DitherSpace::light}},
      "what a dither preserves on average: stored values, or the light of a display; default: the scene's");
  command
      .add_option("--dither-gamma", overrides.dither_gamma,
                  "light is the stored value raised to this power, 1 to 4; default: the curve of sRGB")
      ->option_text("G")
      ->check(number_from(1, 4));
}

void add_mode(CLI::App& command, SceneOverrides& overrides) {
  add_parsed(command, "--mode", overrides.mode, named_display_mode,
             "display mode: size, colours and shape of the pixels; a name that tessera modes lists, with "
             "parameters (cga:palette=0,background=1), or WIDTHxHEIGHTxBITS; default: the scene's, or none")
      ->option_text("MODE");
  command.add_flag("--reduce", overrides.reduce,
                   "draw at 24 bits and reduce the picture to the colours of the display mode");
}

void add_palette_over(CLI::App& command, SceneOverrides& overrides) {
  add_choice<std::optional<PaletteOver>, PaletteOver>(
      command, "--palette-over", overrides.palette_over,
      {{"animation", PaletteOver::animation}, {"frame", PaletteOver::frame}, {"smooth", PaletteOver::smooth}},
      "pictures that share a chosen palette: all of the animation; each frame has its own; or its own whose "
      "entries move little from frame to frame (adaptive only); default: animation");
}

void add_dump(CLI::App& command, RenderRequest& request) {
  command
      .add_option(
          "--dump", request.dump,
          "file for the memory of the display mode: .iff, .ilbm, .lbm (ILBM), .pcx, or any other name "
          "for the bytes as the hardware had them; default: none is written")
      ->option_text("FILE")
      ->check(not_empty("FILE's name"));
}

void add_planes(CLI::App& command, RenderRequest& request) {
  command
      .add_option("--planes", request.planes_folder,
                  "folder for all planes of colour, depth, stencil and accumulation: color_00.pbm, ...; set "
                  "bits are PBM's 1; default: none is written")
      ->option_text("DIR")
      ->check(not_empty("DIR's name"));
}

/// Options that change how a scene or a model is drawn.
void add_drawing(CLI::App& command, SceneOverrides& overrides) {
  command
      .add_option("--samples", overrides.samples,
                  "coverage samples per pixel: 1, 4 or 8; default: the scene's")
      ->option_text("N")
      ->check(one_of({"1", "4", "8"}));
  add_text(
      command, "--background", [&overrides](const std::string& text) { parse_background(text, overrides); },
      "colour of the background: #RRGGBB, or R,G,B, each 0 to 1; none: transparent, the picture gets alpha "
      "(.png, .tif, ...); default: the scene's")
      ->option_text("none|COLOR");
  command.add_flag("--wireframe", overrides.wireframe, "draw the edges of polygons");
  add_choice<std::optional<UpAxis>, UpAxis>(
      command, "--up", overrides.up,
      {{"x", UpAxis::x},
       {"y", UpAxis::y},
       {"z", UpAxis::z},
       {"-x", UpAxis::x_down},
       {"-y", UpAxis::y_down},
       {"-z", UpAxis::z_down}},
      "axis of a model's file that points up; default: z for .3mf and .smd, else y");
}

void add_repetition(CLI::App& command, RenderRequest& request) {
  command
      .add_option("--repeat", request.repeat,
                  "render each picture N times; --stats shows the median; default: 1")
      ->option_text("N")
      ->transform(integer_from(1, 1000000));
}

void add_comparison(CLI::App& command, RenderRequest& request) {
  command
      .add_option("--compare", request.reference,
                  "reference for the last frame; exits with 3 if the frame differs; default: none")
      ->option_text("FILE")
      ->check(not_empty("FILE's name"));
  command
      .add_option("--threshold", request.threshold,
                  "difference that --compare tolerates, in levels of 255; default: 0")
      ->option_text("N")
      ->transform(integer_from(0, 255));
}

void add_renderer_options(CLI::App& command, RendererOptions& options) {
  command.add_option("--threads", options.threads, "threads; default: TESSERA_THREADS, or all cores")
      ->option_text("N")
      ->transform(integer_from(1, 1024));
  command.add_option("--tile-size", options.tile_size, "side of a tile in pixels; default: chosen per frame")
      ->option_text("32|64|128")
      ->check(one_of({"32", "64", "128"}));
  add_choice<InstructionSet, InstructionSet>(command, "--isa", options.instruction_set,
                                             {{"scalar", InstructionSet::scalar},
                                              {"avx2", InstructionSet::avx2},
                                              {"avx512", InstructionSet::avx512}},
                                             "instruction set; default: the best of this machine");
  add_choice<bool, bool>(command, "--elide", options.elide, {{"on", true}, {"off", false}},
                         "leave out effects that the data of a draw make unnecessary; the picture is the "
                         "same; default: on");
}

void add_reports(CLI::App& command, RenderRequest& request) {
  command.add_flag("--explain", request.explain,
                   "list for each draw the effects that run or are skipped, and why");
  command
      .add_flag("--stats{text}", request.stats_name,
                "print statistics of the frame: as text on stderr, or with =json as JSON on stdout")
      ->option_text("[=text|json]")
      ->check(one_of({"text", "json"}));
  add_choice<ShowProgress, ShowProgress>(
      command, "--progress", request.progress,
      {{"auto", ShowProgress::automatic}, {"always", ShowProgress::always}, {"never", ShowProgress::never}},
      "show progress on stderr; default: auto, on a terminal after a second");
  add_choice<std::optional<LogLevel>, LogLevel>(
      command, "--log", request.log,
      {{"debug", LogLevel::debug}, {"info", LogLevel::info}, {"warning", LogLevel::warning}},
      "print the library's log messages of this level and above on stderr; default: none");
}

/// Refuses options of `render` that have no effect, as far as the command line tells.
void check_render_options(const RenderRequest& request) {
  const bool is_stdin = request.input == "-";
  if (is_stdin && request.import.format.empty())
    throw UsageError("--input-format: found none, the input - needs one, such as stl");
  const bool has_display = request.display.display.has_value();
  const bool has_several = request.frames > 1;
  const std::string& file = request.output.path;
  const bool is_png = file.empty() || lower_case_extension(file) == ".png";
  request.given.require({
      {"--input-format", is_stdin, "is for the input -, standard input, alone"},
      {"--compression", is_png, "is for PNG files, and the picture is none"},
      {"--turntable", has_several, "needs at least 2 pictures, one alone shows no turn"},
      {"--palette-over", has_several, "needs --frames or --turntable with more than one picture"},
      {"--scale", has_display, "needs --display"},
      {"--part", has_display, "needs --display"},
      {"--gain", has_display, "needs --display"},
      {"--frame-ms", has_display, "needs --display"},
      {"--frame-ms", has_several, "needs --frames or --turntable with more than one picture"},
      {"--threshold", request.given.has("--compare"), "needs --compare, the reference"},
  });
  check_import_options(request.given, request.input);
}

}  // namespace

void check_import_options(const GivenOptions& given, const std::string& input) {
  const bool has_input = !input.empty();
  given.require({{"--import-memory", has_input, "limits reading a model, and the built-in scene has none"},
                 {"--import-seconds", has_input, "limits reading a model, and the built-in scene has none"}});
}

void add_import_limits(CLI::App& command, ImportRequest& request) {
  command
      .add_option(
          "--import-memory", request.memory_mib,
          "memory in MiB that reading a model may take; default: a quarter of the machine's, at least "
          "1024")
      ->option_text("MIB")
      ->transform(integer_from(16, 1 << 24));
  command
      .add_option("--import-seconds", request.seconds,
                  "seconds that reading a model may take without progress; default: 10")
      ->option_text("N")
      ->transform(integer_from(1, 1000000));
}

CLI::App* add_render(CLI::App& program, RenderRequest& request) {
  CLI::App* command = program.add_subcommand("render",
                                             "Render a scene (.json) or a model (.obj, .gltf, .glb, .ply, "
                                             ".stl, ...); without one, the built-in teapot");
  command->footer(kRenderExamples);
  command->option_defaults()->take_last();
  add_input(*command, request.input);
  add_input_format(*command, request);
  add_import_limits(*command, request.import);
  add_output(*command, request);
  add_scene_overrides(*command, request.overrides);
  add_mode(*command, request.overrides);
  add_palette_over(*command, request.overrides);
  add_display_view(*command, request.display);
  add_dump(*command, request);
  add_planes(*command, request);
  add_view(*command, request.overrides);
  add_drawing(*command, request.overrides);
  add_animation(*command, request);
  add_repetition(*command, request);
  add_comparison(*command, request);
  add_renderer_options(*command, request.options);
  add_reports(*command, request);
  command->parse_complete_callback([command, &request] {
    if (command->remaining_size() > 0) return;  // reported as unexpected
    request.given = GivenOptions(*command);
    check_render_options(request);
    check_animation(request);
  });
  return command;
}

CLI::App* add_explain(CLI::App& program, ExplainRequest& request) {
  CLI::App* command = program.add_subcommand(
      "explain", "List for each draw of a scene or a model the effects that run or are skipped, and why");
  command->footer(kExplainExamples);
  command->option_defaults()->take_last();
  add_input(*command, request.input);
  add_import_limits(*command, request.import);
  add_scene_overrides(*command, request.overrides);
  add_mode(*command, request.overrides);
  add_view(*command, request.overrides);
  command->add_flag("--json", request.json, "print JSON, with stable codes for effects and reasons");
  command->add_flag("--measure", request.measure,
                    "also render the scene and print the time of each draw, and for each effect the share "
                    "of batches, tiles and pixels for which it was left out");
  command
      ->add_option("--threads", request.threads,
                   "threads of --measure; default: TESSERA_THREADS, or all cores")
      ->option_text("N")
      ->transform(integer_from(1, 1024));
  command->parse_complete_callback([command, &request] {
    if (command->remaining_size() > 0) return;  // reported as unexpected
    request.given = GivenOptions(*command);
    request.given.require({{"--threads", request.measure, "needs --measure"}});
    check_import_options(request.given, request.input);
  });
  return command;
}

}  // namespace tessera::program::cli
