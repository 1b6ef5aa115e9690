// Options of `tessera scene`, and those of a scene's size and view.
#include <string>

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
  command
      .add_option_function<std::string>(
          "--size",
          [&overrides](const std::string& text) {
            if (!parse_size(text, overrides))
              throw CLI::ValidationError("--size", "found \"" + text +
                                                       "\", expected WIDTHxHEIGHT, each 1 to " +
                                                       std::to_string(kMaxFrameBufferSize));
          },
          "size of the picture; default: the scene's, or 640x480 for a model")
      ->option_text("WIDTHxHEIGHT");
}

void add_view(CLI::App& command, SceneOverrides& overrides) {
  command
      .add_option_function<std::string>(
          "--camera",
          [&overrides](const std::string& text) {
            if (!parse_camera(text, overrides))
              throw CLI::ValidationError(
                  "--camera",
                  "found \"" + text +
                      "\", expected EX,EY,EZ,TX,TY,TZ[,FOVY]: eye, target, vertical angle in degrees");
          },
          "camera for the whole frame, in place of the scene's or the model's")
      ->option_text("EX,EY,EZ,TX,TY,TZ[,FOVY]");
  command
      .add_option_function<std::string>(
          "--light",
          [&overrides](const std::string& text) {
            if (!parse_light(text, overrides))
              throw CLI::ValidationError(
                  "--light",
                  "found \"" + text + "\", expected X,Y,Z[,W]: a position, or with W = 0 a direction");
          },
          "white light for the whole frame, in place of the scene's; may be repeated")
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
                   "scene file to write, .json; textures are written next to it as NAME.texture0.png, ...")
      ->option_text("FILE.json")
      ->required()
      ->check(not_empty("FILE's name"));
  add_size(*command, request.overrides);
  add_view(*command, request.overrides);
  return command;
}

}  // namespace tessera::program::cli
