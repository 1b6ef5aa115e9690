#include "engine/program/cli/scene_command.h"

#include "engine/program/cli/printable.h"
#include "engine/program/cli/progress.h"
#include "engine/program/cli/scene_input.h"
#include "engine/program/imageio/atomic_file.h"
#include "engine/program/scene/file_extension.h"
#include "engine/program/scene/write_scene.h"

namespace tessera::program::cli {

void write_model_scene(const SceneRequest& request) {
  if (lower_case_extension(request.input) == ".json")
    throw Error(cli::quoted(request.input) + " is a scene already, expected a model");
  if (lower_case_extension(request.output) != ".json")
    throw Error("the scene file is " + cli::quoted(request.output) + ", its name must end in .json");
  require_writable(request.output);
  const Interrupt interrupt;
  const SceneInput input(request.input, request.overrides);
  input.print_warnings();
  write_scene(input.scene(), request.output);
}

}  // namespace tessera::program::cli
