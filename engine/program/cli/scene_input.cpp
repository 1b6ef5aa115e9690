#include "engine/program/cli/scene_input.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <utility>

#include <stdlib.h>
#include <unistd.h>

#include "engine/program/cli/printable.h"
#include "engine/program/cli/progress.h"
#include "engine/program/cli/usage_error.h"
#include "engine/program/import/model.h"
#include "engine/program/import/model_axes.h"
#include "engine/program/scene/file_extension.h"
#include "engine/program/scene/model_scene.h"
#include "engine/program/scene/text_file.h"
#include "engine/program/scene/turntable.h"

namespace tessera::program::cli {

namespace {

/// A file with the bytes of standard input, which disappears with the object.
class StandardInputFile {
 public:
  explicit StandardInputFile(const std::string& format) {
    std::string name = (std::filesystem::temp_directory_path() / "tessera-XXXXXX").string() + "." + format;
    const int file = ::mkstemps(name.data(), static_cast<int>(format.size()) + 1);
    if (file < 0) throw Error("cannot make a temporary file: " + std::string(std::strerror(errno)));
    ::close(file);
    path_ = name;
    std::ofstream(path_, std::ios::binary) << std::cin.rdbuf();
  }
  ~StandardInputFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  StandardInputFile(const StandardInputFile&) = delete;
  StandardInputFile& operator=(const StandardInputFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Applies the values of options. A value that the scene refuses is wrong usage.
void apply_options(const SceneOverrides& overrides, Scene& scene) {
  try {
    apply(overrides, scene);
  } catch (const Error& error) {
    throw UsageError(error.code(), error.what());
  }
}

}  // namespace

SceneInput::SceneInput(const std::string& path, const SceneOverrides& overrides, const ImportRequest& import,
                       ShowProgress show_progress)
    : overrides_(overrides) {
  const auto progress = std::make_shared<Progress>(show_progress);
  const ImportOptions options{
      .memory_bytes = static_cast<std::size_t>(import.memory_mib) << 20,
      .seconds = import.seconds,
      .should_continue = [] { return !Interrupt::pressed(); },
      .progress =
          [progress](const std::string& model, double done) {
            progress->show(done, "reading " + printable(std::filesystem::path(model).filename().string()));
          }};
  if (path.empty()) {
    scene_ = builtin_scene();
  } else if (path == "-") {
    const StandardInputFile file(import.format);
    if (import.format == "json") scene_ = parse_scene(read_text_file(file.path()), "standard input");
    else load_standard_input(file.path(), options);
  } else if (lower_case_extension(path) == ".json") {
    file_.emplace(path, options);
    scene_ = file_->at(0);
  } else {
    load_model(path, options);
  }
  progress->clear();
  apply_options(overrides_, scene_);
  camera_ = scene_.camera;
  lights_ = scene_.lights;
}

void SceneInput::load_standard_input(const std::string& copy, const ImportOptions& options) {
  try {
    load_model(copy, options);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {  // must not name a file that the user did not
    std::string message = error.what();
    for (std::size_t at = 0; (at = message.find(copy)) != std::string::npos;)
      message.replace(at, copy.size(), "standard input");
    throw Error(error.code(), message);
  }
}

void SceneInput::load_model(const std::string& path, const ImportOptions& options) {
  const FrameBufferFormat defaults;
  Model model = import_model(path, ModelUse::display, options);
  turn_up(overrides_.up.value_or(up_axis_of(path)), model);
  int width = overrides_.width.value_or(defaults.width);
  int height = overrides_.height.value_or(defaults.height);
  if (overrides_.mode) {  // only the aspect matters
    width = overrides_.mode->width * overrides_.mode->pixel_aspect.numerator;
    height = overrides_.mode->height * overrides_.mode->pixel_aspect.denominator;
  }
  scene_ = model_scene(std::move(model), path, width, height, overrides_.turntable);
}

double SceneInput::frame_time(int frame, int frames) const {
  const int intervals = overrides_.turntable ? frames : frames - 1;
  return intervals > 0 ? static_cast<double>(frame) / intervals : 0;
}

void SceneInput::move_to(double time) {
  if (file_ && is_animated()) {
    scene_ = file_->at(time);
    apply_options(overrides_, scene_);
  } else {
    scene_.camera = camera_;
    scene_.lights = lights_;
  }
  if (overrides_.turntable) turn_viewer(360 * time, scene_);
}

void SceneInput::print_warnings() const {
  for (const std::string& warning : scene_.warnings)
    std::cerr << "tessera: warning: " << printable(warning) << "\n";
}

}  // namespace tessera::program::cli
