#include "engine/program/import/memory_limit.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include <unistd.h>

namespace tessera::program {
namespace {

constexpr std::size_t kMinBytes = std::size_t{1} << 30;

std::size_t machine_memory() {
  return static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

/// The limit of a control group, version 2 or 1; the largest number if there is none. Containers see their
/// own group at these paths.
std::size_t group_memory() {
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const char* const path :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::size_t bytes = 0;
    if (std::ifstream(path) >> bytes && bytes > 0) least = std::min(least, bytes);
  }
  return least;
}

}  // namespace

std::size_t default_import_memory() {
  return std::max(std::min(machine_memory(), group_memory()) / 4, kMinBytes);
}

}  // namespace tessera::program
