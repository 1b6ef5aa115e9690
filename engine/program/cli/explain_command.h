// `tessera explain`: which effects of each draw run, which are skipped, and why. Renders no picture.
#pragma once

#include <string>

#include "engine/program/scene/scene.h"

namespace tessera::program::cli {

struct ExplainRequest {
  std::string input;  ///< a scene or a model; empty: the built-in scene
  SceneOverrides overrides;
  bool json = false;
};

/// Prints the explanation on stdout, as text or as JSON.
/// @return the exit code
/// @throws Error
int explain(const ExplainRequest& request);

/// The text of `tessera explain` for a recorded scene.
std::string explanation_text(const Scene& scene, const Frame& frame);

}  // namespace tessera::program::cli
