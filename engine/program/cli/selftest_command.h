// `tessera selftest`: is what this machine renders right, and the same as everywhere?
#pragma once

#include <string>

namespace tessera::program::cli {

struct SelftestRequest {
  std::string expected;  ///< a list of hashes to compare with (picture_hashes.h); empty: that of this version
  bool hashes = false;   ///< print what the scenes come to here as such a list, and nothing else
  int threads = 0;       ///< of the renderings by many; 0: all cores, two at least
};

inline constexpr int kSelftestFailed = 3;  ///< exit code

/// Prints on stdout. Returns the exit code.
/// @throws Error for a list that cannot be read or lacks a scene
int selftest(const SelftestRequest& request);

}  // namespace tessera::program::cli
