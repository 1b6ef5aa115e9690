// `tessera render`: a scene or a model becomes a picture, or many.
#pragma once

#include <optional>
#include <string>

#include "engine/program/cli/output.h"
#include "engine/program/cli/progress.h"
#include "engine/program/cli/stats_text.h"
#include "engine/program/scene/scene.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {

struct RenderRequest {
  std::string input;          ///< a scene or a model; empty: the built-in scene
  OutputRequest output;       ///< path empty: the input's name with .png, in the current folder
  std::string planes_folder;  ///< empty: planes are not written
  SceneOverrides overrides;
  RendererOptions options;
  int frames = 1;  ///< pictures of an animation
  int repeat = 1;  ///< how often each is rendered
  bool explain = false;
  std::string stats_name;  ///< as it was typed
  StatsFormat stats = StatsFormat::none;
  std::string reference;  ///< a picture to compare the last one with; empty: none
  int threshold = 0;      ///< levels of 255
  ShowProgress progress = ShowProgress::automatic;
  std::optional<LogLevel> log;
};

inline constexpr int kDiffers = 3, kInterrupted = 130;  ///< exit codes

/// Prints explanations and JSON on stdout; warnings, numbers for people and the log on stderr. Returns the
/// exit code.
/// @throws Error
int render(RenderRequest request);

}  // namespace tessera::program::cli
