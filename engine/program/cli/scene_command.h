// `tessera scene`: writes the scene that is drawn for a model as a scene file.
#pragma once

#include <string>

#include "engine/program/scene/scene.h"

namespace tessera::program::cli {

struct SceneRequest {
  std::string input;         ///< a model
  std::string output;        ///< the scene file, .json
  SceneOverrides overrides;  ///< size, camera and lights
};

/// Writes the scene file, and its textures next to it; warnings go to stderr.
/// @throws Error
void write_model_scene(const SceneRequest& request);

}  // namespace tessera::program::cli
