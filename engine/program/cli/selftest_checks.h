// Checks what the library draws on this machine against results computed without it.
#pragma once

#include <string>

#include "engine/program/cli/selftest_configurations.h"

namespace tessera::program::cli {

// The checks of powers and levels draw one point per pixel of a square frame.
inline constexpr int kFrameSide = 64;
inline constexpr int kFramePoints = kFrameSide * kFrameSide;

struct CheckReport {
  std::string name;      ///< "checked quantity, reference"
  std::string measured;  ///< summary of the results
  std::size_t failed_configurations = 0;
  std::string first_failure;  ///< failure of the first configuration that failed

  void add(const std::string& failure, const RendererOptions& configuration) {
    if (failed_configurations++ == 0) first_failure = failure + ", by " + to_text(configuration);
  }
};

// Each check draws the same frames with every configuration.

/// Covered pixels of triangles, against edge functions in exact integers; meshes with shared edges cover each
/// pixel exactly once.
CheckReport check_coverage(const Configurations& configurations);
/// Highlights x^shininess, against the host's pow() in double.
CheckReport check_powers(const Configurations& configurations);
/// Stored colours and depths, which must be within half a level of the exact value.
CheckReport check_levels(const Configurations& configurations);

}  // namespace tessera::program::cli
