// `tessera render`: a scene or a model becomes a picture.
#pragma once

#include <string>

#include "engine/scene/scene.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::cli {

struct RenderRequest {
  std::string input;          ///< a scene or a model; empty: the built-in scene
  std::string output;         ///< empty: the input's name with .png, in the current folder
  std::string planes_folder;  ///< empty: planes are not written
  SceneOverrides overrides;
  RendererOptions options;
  bool explain = false, stats = false;
};

/// Prints explanations on stdout, warnings and numbers on stderr.
/// @throws Error
void render(const RenderRequest& request);

}  // namespace tessera::cli
