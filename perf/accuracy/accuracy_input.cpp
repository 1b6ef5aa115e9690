#include "perf/accuracy/accuracy_input.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include "engine/program/import/model.h"
#include "engine/program/scene/embedded.h"
#include "engine/program/scene/model_scene.h"
#include "engine/program/scene/text_file.h"
#include "perf/accuracy/reference_scene.h"
#include "tests/reference/builtin_meshes.h"

namespace tessera::accuracy {
namespace {

namespace fs = std::filesystem;

reference::Scene parsed_by_reference(const SceneText& text) {
  try {
    return reference::parse_scene(text.json, text.folder);
  } catch (const std::exception& error) {
    throw Error(text.name + ": the reference renderer cannot draw this scene: " + error.what());
  }
}

AccuracyInput input_of(const SceneText& text) {
  AccuracyInput input{
      text.name, text.title, program::parse_scene(text.json, text.name, text.folder), {}, text.settings};
  if (input.scene.framebuffer.color_mode != ColorMode::rgb || input.scene.framebuffer.color_bits != 24)
    throw Error(text.name +
                ": errors are measured in levels of 24-bit RGB, found a frame buffer of another kind");
  input.reference = parsed_by_reference(text);
  return input;
}

/// A name for links and file names that no other input has.
std::string unique_name(const std::string& path, std::set<std::string>& names) {
  std::string name = fs::path(path).stem().string();
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_') c = '-';
  std::string unique = name.empty() ? "scene" : name;
  for (int number = 2; !names.insert(unique).second; ++number) unique = name + "-" + std::to_string(number);
  return unique;
}

AccuracyInput input_of_file(const std::string& path, const std::string& name) {
  if (fs::path(path).extension() == ".json") {
    const std::string folder = fs::path(path).parent_path().string();
    AccuracyInput input =
        input_of({.name = name, .title = path, .json = program::read_text_file(path), .folder = folder});
    if (!input.scene.title.empty()) input.title = input.scene.title;
    return input;
  }
  AccuracyInput input{name,
                      path,
                      program::model_scene(program::import_model(path, program::ModelUse::display), path,
                                           kSceneWidth, kSceneHeight),
                      {},
                      SettingChoice::all};
  input.reference = reference_scene(input.scene);
  return input;
}

std::vector<SceneText> selected_scenes(const AccuracyOptions& options) {
  std::vector<SceneText> scenes = scene_list();
  const auto starts_any = [&options](const SceneText& scene) {
    return std::any_of(options.scenes.begin(), options.scenes.end(),
                       [&](const std::string& prefix) { return scene.name.starts_with(prefix); });
  };
  if (options.scenes == std::vector<std::string>{"none"}) return {};
  if (options.scenes.empty()) {
    if (options.is_quick) std::erase_if(scenes, [](const SceneText& scene) { return !scene.in_quick_run; });
    return scenes;
  }
  std::string known;
  for (const SceneText& scene : scenes) known += (known.empty() ? "" : ", ") + scene.name;
  for (const std::string& prefix : options.scenes)
    if (std::none_of(scenes.begin(), scenes.end(),
                     [&](const SceneText& scene) { return scene.name.starts_with(prefix); }))
      throw CLI::ValidationError("--scenes",
                                 "found \"" + prefix + "\", expected none or prefixes of: " + known);
  std::erase_if(scenes, [&](const SceneText& scene) { return !starts_any(scene); });
  return scenes;
}

}  // namespace

std::vector<AccuracyInput> accuracy_inputs(const AccuracyOptions& options) {
  reference::set_teapot_patches_text(std::string(program::kTeapotPatches));
  std::vector<AccuracyInput> inputs;
  std::set<std::string> names;
  for (const SceneText& text : selected_scenes(options)) {
    names.insert(text.name);
    inputs.push_back(input_of(text));
  }
  for (const std::string& path : options.files)
    inputs.push_back(input_of_file(path, unique_name(path, names)));
  if (inputs.empty())
    throw CLI::ValidationError("--scenes", "found none without files, expected a scene to measure");
  return inputs;
}

}  // namespace tessera::accuracy
