// `tessera compare`: how much two pictures differ.
#pragma once

#include <array>
#include <string>

#include "engine/program/compare/flip.h"

namespace tessera::program::cli {

struct CompareRequest {
  std::array<std::string, 2> pictures;
  double pixels_per_degree = kDefaultPixelsPerDegree;
  std::string map;  ///< file for the FLIP error of each pixel; empty: none
  bool json = false;
  int threads = 0;  ///< 0: all cores
};

/// Prints the errors on stdout, as text or as JSON.
/// @return the exit code: 0, whether or not the pictures differ
/// @throws Error for files that cannot be read or written, and for pictures of different sizes
int compare(const CompareRequest& request);

}  // namespace tessera::program::cli
