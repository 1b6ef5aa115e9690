// `tessera modes`: lists the display modes, or finds the mode of a screen.
#pragma once

#include <string>

namespace tessera::program::cli {

struct ModesRequest {
  double diagonal_in = 0;  ///< inches; 0: list the modes
  double pitch_mm = 0;     ///< millimetres; above 0 if the diagonal is
  bool json = false;
};

/// Returns the answer as text, or as JSON.
/// @throws Error
std::string modes_text(const ModesRequest& request);

}  // namespace tessera::program::cli
