// `tessera modes`: lists the display modes, finds the mode of a screen, or compares the modes with a scene.
#pragma once

#include <string>

#include "engine/program/cli/mode_comparison.h"

namespace tessera::program::cli {

struct ModesRequest {
  double diagonal_in = 0;  ///< inches; 0: list the modes
  double pitch_mm = 0;     ///< millimetres; above 0 if the diagonal is
  bool json = false;
  ModeComparisonRequest comparison;  ///< folder empty: no comparison
};

/// Returns the list or the mode of a screen as text, or as JSON.
/// @throws Error
std::string modes_text(const ModesRequest& request);

}  // namespace tessera::program::cli
