// What the library draws on this machine, held against results that it has no part in.
#pragma once

#include <string>

#include "engine/cli/selftest_ways.h"

namespace tessera::cli {

struct OracleReport {
  std::string oracle;  ///< what is held against what
  std::string measured;
  std::size_t wrong_ways = 0;
  std::string first_wrong;  ///< of the first such way

  void add(const std::string& wrong, const RendererOptions& way) {
    if (wrong_ways++ == 0) first_wrong = wrong + ", by " + to_text(way);
  }
};

// Each draws the same frames in every one of the ways.

/// Pixels that triangles cover, against edge functions in 128-bit integers; meshes whose triangles share
/// their edges cover each pixel once.
OracleReport check_coverage(const Ways& ways);
/// Highlights x^shininess, against the host's pow in double.
OracleReport check_powers(const Ways& ways);
/// Colours and depths as they are stored: at most half a level off.
OracleReport check_levels(const Ways& ways);

}  // namespace tessera::cli
