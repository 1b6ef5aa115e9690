// `tessera display --presets`: a scene on the display of every preset.
#pragma once

#include <string>

#include "engine/program/cli/close_up.h"

namespace tessera::program::cli {

/// The highlight of the built-in teapot.
inline constexpr ScreenPlace kHighlight{0.53, 0.44};

struct DisplayComparisonRequest {
  std::string input;               ///< a scene or a model; empty: the built-in scene
  std::string folder;              ///< created if it does not exist
  ScreenPlace place = kHighlight;  ///< middle of the close-ups
  int threads = 0;                 ///< 0: all cores
};

/// Draws the scene in the typical mode of each preset and shows it on the preset's display. Writes
/// PRESET.png, the whole screen, PRESET-near.png, a close-up, and contact.png into the folder, and the views
/// to stdout.
/// - Modes with few colours are dithered in light, with an adaptive palette if theirs can be chosen.
/// - The contact sheet has the whole screen, drawn for the size of its cells, and the middle of the close-up.
/// - Each image is exposed by exposure_gain().
/// @throws Error
void compare_displays(const DisplayComparisonRequest& request);

}  // namespace tessera::program::cli
