// `tessera explain`: which effects of each draw run, which are skipped, and why. Writes no picture.
#pragma once

#include <string>

#include "engine/program/cli/given_options.h"
#include "engine/program/cli/scene_input.h"
#include "engine/program/scene/scene.h"

namespace tessera::program::cli {

struct MeasuredScene;

struct ExplainRequest {
  GivenOptions given;
  std::string input;     ///< a scene or a model; empty: the built-in scene
  ImportRequest import;  ///< for a model
  SceneOverrides overrides;
  bool json = false;
  bool measure = false;  ///< also renders the scene, and prints times and shares
  int threads = 0;       ///< for `measure`; 0: all cores
};

/// Prints the explanation on stdout, as text or as JSON.
/// @return the exit code
/// @throws Error
int explain(const ExplainRequest& request);

/// The text of `tessera explain` for a recorded scene.
/// @param measured  null: not measured
std::string explanation_text(const Scene& scene, const Frame& frame, const MeasuredScene* measured = nullptr);

}  // namespace tessera::program::cli
