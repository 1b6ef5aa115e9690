// `tessera display`: shows pictures on a simulated display, or lists the displays.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/program/cli/display_comparison.h"
#include "engine/program/cli/display_request.h"
#include "engine/program/cli/output.h"
#include "engine/tessera/display_mode.hpp"

namespace tessera::program::cli {

struct DisplayCommandRequest {
  std::vector<std::string> pictures;  ///< files; several are frames in order. Presets: a scene, or none
  OutputRequest output;               ///< presets: a folder
  std::string signal;                 ///< file for the signal of ntsc or pal; empty: not written
  DisplayRequest display;
  std::optional<DisplayMode> mode;  ///< absent: that of the pictures' size, with square pixels
  int threads = 0;                  ///< 0: all cores
  bool presets = false;             ///< shows a scene on all presets
  ScreenPlace place = kHighlight;   ///< middle of the presets' close-ups
  bool list = false;
  bool json = false;
};

/// Writes the images, or the list to stdout; notes to stderr. For presets see compare_displays().
/// @throws Error, DisplayError
void display(const DisplayCommandRequest& request);

}  // namespace tessera::program::cli
