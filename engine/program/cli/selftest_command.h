// `tessera selftest`: checks that this machine renders correctly, and the same bits as every other machine.
#pragma once

#include <string>

namespace tessera::program::cli {

struct SelftestRequest {
  std::string expected;  ///< file of expected hashes (picture_hashes.h); empty: those of this version
  bool hashes = false;   ///< only print the hashes of this machine, in the format of `expected`
  int threads = 0;       ///< number of threads to compare with one; 0: all cores, at least 2
};

inline constexpr int kSelftestFailed = 3;  ///< exit code

/// Prints a report on stdout.
/// @return the exit code
/// @throws Error for a list that cannot be read or lacks a scene
int selftest(const SelftestRequest& request);

}  // namespace tessera::program::cli
