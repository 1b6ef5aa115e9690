#include "engine/program/cli/scene_input.h"

#include <iostream>
#include <utility>

#include "engine/program/cli/printable.h"
#include "engine/program/cli/progress.h"
#include "engine/program/import/model.h"
#include "engine/program/scene/file_extension.h"
#include "engine/program/scene/model_scene.h"

namespace tessera::program::cli {

SceneInput::SceneInput(const std::string& path, const SceneOverrides& overrides) : overrides_(overrides) {
  const auto should_continue = [] { return !Interrupt::pressed(); };
  if (path.empty()) {
    scene_ = builtin_scene();
  } else if (lower_case_extension(path) == ".json") {
    file_.emplace(path, should_continue);
    scene_ = file_->at(0);
  } else {
    const FrameBufferFormat defaults;
    Model model = import_model(path, ModelUse::display, should_continue);
    int width = overrides_.width.value_or(defaults.width);
    int height = overrides_.height.value_or(defaults.height);
    if (overrides_.mode) {  // only the aspect matters
      width = overrides_.mode->width * overrides_.mode->pixel_aspect.numerator;
      height = overrides_.mode->height * overrides_.mode->pixel_aspect.denominator;
    }
    scene_ = model_scene(std::move(model), path, width, height);
  }
  apply(overrides_, scene_);
}

void SceneInput::move_to(double time) {
  if (!is_animated()) return;
  scene_ = file_->at(time);
  apply(overrides_, scene_);
}

void SceneInput::print_warnings() const {
  for (const std::string& warning : scene_.warnings)
    std::cerr << "tessera: warning: " << printable(warning) << "\n";
}

}  // namespace tessera::program::cli
