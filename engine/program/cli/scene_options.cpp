// Options of `tessera scene`, and those of a scene's size and view.
#include <string>

#include "engine/program/cli/choice_option.h"
#include "engine/program/cli/command_options.h"
#include "engine/program/cli/parse_overrides.h"
#include "engine/program/cli/validators.h"

namespace tessera::program::cli {
namespace {

constexpr const char* kSceneExamples = R"(Examples:
  tessera scene truck.glb -o truck.json
  tessera scene truck.glb -o truck.json --size 1280x720 --camera 4,2,6,0,0,0
  tessera render truck.json)";

}  // namespace

void add_size(CLI::App& command, SceneOverrides& overrides) {
  add_text(
      command, "--size", [&overrides](const std::string& text) { parse_size(text, overrides); },
      "size of the picture in pixels, each 1 to " + std::to_string(kMaxFrameBufferSize) +
          "; default: the scene's, or 640x480 for a model")
      ->option_text("WIDTHxHEIGHT");
}

void add_view(CLI::App& command, SceneOverrides& overrides) {
  add_text(
      command, "--camera", [&overrides](const std::string& text) { parse_camera(text, overrides); },
      "eye, target and vertical angle of view in degrees of a camera for the whole frame; default: the "
      "scene's or the model's camera; default of FOVY: 45")
      ->option_text("EX,EY,EZ,TX,TY,TZ[,FOVY]");
  add_text(
      command, "--light", [&overrides](const std::string& text) { parse_light(text, overrides); },
      "white light for the whole frame at a position, or with W = 0 from a direction; may be repeated; "
      "default: the scene's lights; default of W: 1")
      ->option_text("X,Y,Z[,W]")
      ->trigger_on_parse();  // called once per occurrence
}

CLI::App* add_scene(CLI::App& program, SceneRequest& request) {
  CLI::App* command = program.add_subcommand(
      "scene", "Write the scene that is drawn for a model as a scene file, to be edited");
  command->footer(kSceneExamples);
  command->option_defaults()->take_last();
  command->add_option("model", request.input, "model")
      ->option_text("MODEL")
      ->required()
      ->check(not_empty("a model's name"));
  command
      ->add_option("-o,--output", request.output,
                   "scene file to write, .json; textures are written next to it as "
                   "NAME.texture0.png, ...; required")
      ->option_text("FILE.json")
      ->required()
      ->check(not_empty("FILE's name"));
  add_size(*command, request.overrides);
  add_view(*command, request.overrides);
  return command;
}

}  // namespace tessera::program::cli
