// `tessera render`: renders a scene or a model to one picture or to an animation.
#pragma once

#include <optional>
#include <string>

#include "engine/program/cli/display_request.h"
#include "engine/program/cli/exit_codes.h"
#include "engine/program/cli/given_options.h"
#include "engine/program/cli/output.h"
#include "engine/program/cli/progress.h"
#include "engine/program/cli/scene_input.h"
#include "engine/program/cli/stats_text.h"
#include "engine/program/scene/scene.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {

struct RenderRequest {
  GivenOptions given;
  std::string input;          ///< a scene or a model; empty: the built-in scene; "-": standard input
  ImportRequest import;       ///< for a model, and the format of standard input
  OutputRequest output;       ///< path empty: INPUT.render.png in the current folder
  std::string planes_folder;  ///< empty: planes are not written
  std::string dump;           ///< file for the memory of the display mode; empty: not written
  DisplayRequest display;     ///< shows the pictures before they are written
  SceneOverrides overrides;
  RendererOptions options;
  int frames = 1;  ///< pictures of the animation
  int repeat = 1;  ///< renderings of each picture
  bool explain = false;
  std::string stats_name;  ///< the value of --stats as typed
  StatsFormat stats = StatsFormat::none;
  std::string reference;  ///< picture to compare the last frame with; empty: none
  int threshold = 0;      ///< tolerated difference, in levels of 255
  ShowProgress progress = ShowProgress::automatic;
  std::optional<LogLevel> log;
};

/// Writes explanations and JSON to stdout; warnings, readable statistics and the log to stderr.
/// @return the exit code
/// @throws Error
int render(RenderRequest request);

}  // namespace tessera::program::cli
