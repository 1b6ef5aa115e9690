// The scenes of a run, as the renderer and the reference see them.
#pragma once

#include <string>
#include <vector>

#include "engine/program/scene/scene.h"
#include "perf/accuracy/accuracy_options.h"
#include "perf/accuracy/scene_list.h"
#include "tests/reference/scene.h"

namespace tessera::accuracy {

struct AccuracyInput {
  std::string name;  ///< unique; letters, digits, hyphens, underscores and dots
  std::string title;
  program::Scene scene;
  /// Parsed by the reference's own parser from the same text; for models, converted from the imported scene.
  reference::Scene reference;
  SettingChoice settings = SettingChoice::all;
};

/// The built-in scenes that the options select, and the files.
/// @throws Error for a file that cannot be read, or a scene that the reference cannot render;
///     CLI::ValidationError for a name that selects no scene
std::vector<AccuracyInput> accuracy_inputs(const AccuracyOptions& options);

}  // namespace tessera::accuracy
