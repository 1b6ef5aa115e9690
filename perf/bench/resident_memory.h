// Resident memory of this process.
#pragma once

#include <cstdint>

namespace tessera::bench {

/// Bytes; 0 if the system does not report them.
struct ResidentMemory {
  std::uint64_t now = 0;
  std::uint64_t peak = 0;
};
ResidentMemory resident_memory();

/// Returns free heap memory to the system and restarts the peak from the current size.
void reset_peak();

}  // namespace tessera::bench
