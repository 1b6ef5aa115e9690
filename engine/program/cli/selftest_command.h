// `tessera selftest`: checks that this machine renders correctly, and the same bits as every other machine.
#pragma once

#include <string>

namespace tessera::program::cli {

struct SelftestRequest {
  /// File of expected hashes (picture_hashes.h). Empty: the hashes embedded in this program.
  std::string expected;
  /// Prints the hashes of this machine, in the format of that file, and checks nothing.
  bool hashes = false;
  /// Everything is drawn with 1 thread and with this number of threads. 0: all cores, but at least 2.
  int threads = 0;
};

/// Runs the self-test and prints a report on stdout.
/// @return 0, or kDiffers if a scene or a check fails
/// @throws Error if the file of expected hashes cannot be read or lacks a scene
int selftest(const SelftestRequest& request);

}  // namespace tessera::program::cli
