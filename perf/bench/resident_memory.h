// What of this process stands in memory.
#pragma once

#include <cstdint>

namespace tessera::bench {

/// Bytes; 0 where the system does not tell.
struct ResidentMemory {
  std::uint64_t now = 0, peak = 0;
};
ResidentMemory resident_memory();

/// Gives back what is free, and lets the peak start from there.
void reset_peak();

}  // namespace tessera::bench
