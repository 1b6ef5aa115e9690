// What the library draws on this machine, held against results that it has no part in.
#pragma once

#include <string>

#include "engine/program/cli/selftest_configurations.h"

namespace tessera::program::cli {

struct OracleReport {
  std::string oracle;  ///< what is held against what
  std::string measured;
  std::size_t failed_configurations = 0;
  std::string first_failure;  ///< of the first such configuration

  void add(const std::string& wrong, const RendererOptions& configuration) {
    if (failed_configurations++ == 0) first_failure = wrong + ", by " + to_text(configuration);
  }
};

// Each draws the same frames in every one of the configurations.

/// Pixels that triangles cover, against edge functions in 128-bit integers; meshes whose triangles share
/// their edges cover each pixel once.
OracleReport check_coverage(const Configurations& configurations);
/// Highlights x^shininess, against the host's pow in double.
OracleReport check_powers(const Configurations& configurations);
/// Colours and depths as they are stored: at most half a level off.
OracleReport check_levels(const Configurations& configurations);

}  // namespace tessera::program::cli
