// `tessera modes SCENE -o DIR`: a scene in every display mode with every dither, as pictures, a contact sheet
// and a table.
#pragma once

#include <string>
#include <vector>

#include "engine/program/cli/scene_input.h"
#include "engine/tessera/display_mode.hpp"

namespace tessera::program::cli {

struct ModeComparisonRequest {
  std::string input;               ///< a scene or a model; empty: the built-in scene
  ImportRequest import;            ///< for a model
  std::string folder;              ///< created if it does not exist
  std::vector<DisplayMode> modes;  ///< with pixels; empty: all named ones
  std::vector<Dither> dithers;     ///< empty: all
  DitherSpace dither_in = DitherSpace::levels;
  bool json = false;  ///< prints JSON, not text
  int threads = 0;    ///< 0: all cores
};

/// Writes MODE-DITHER.png for each mode and dither, reference-WIDTHxHEIGHT.png at 24 bits for each size,
/// contact.png, modes.csv and modes.json into the folder, and the table to stdout.
/// - Modes that show the same picture are drawn once and listed together; see grouped().
/// - Without `modes`, the contact sheet has one row per family of modes, else one per mode.
/// @return the exit code
/// @throws Error
int compare_modes(const ModeComparisonRequest& request);

}  // namespace tessera::program::cli
