#include "perf/bench/resident_memory.h"

#include <cstdlib>
#include <fstream>
#include <string>

#include <malloc.h>

namespace tessera::bench {

ResidentMemory resident_memory() {
  ResidentMemory memory;
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    const auto bytes_after = [&line](const char* name) {
      return line.starts_with(name) ? std::strtoull(line.c_str() + line.find(':') + 1, nullptr, 10) * 1024
                                    : 0;
    };
    if (const std::uint64_t bytes = bytes_after("VmRSS:"); bytes != 0) memory.now = bytes;
    if (const std::uint64_t bytes = bytes_after("VmHWM:"); bytes != 0) memory.peak = bytes;
  }
  return memory;
}

void reset_peak() {
  ::malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // resets VmHWM, see proc(5)
}

}  // namespace tessera::bench
