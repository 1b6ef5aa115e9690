#include "engine/program/cli/machine_text.h"

#include <vector>

#include <unistd.h>

#include "engine/program/threads/processor_name.h"
#include "engine/program/threads/thread_limit.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {
namespace {

std::string cache(int name) {
  const long bytes = ::sysconf(name);
  return bytes > 0 ? std::to_string(bytes / 1024) + " KiB" : "unknown";
}

}  // namespace

std::string machine_text() {
  const std::vector<InstructionSet> available = available_instruction_sets();
  std::string sets;
  for (const InstructionSet set : available) sets.append(sets.empty() ? "" : " ").append(name(set));
  std::string text = "tessera            " + std::string(version()) + "\n";
#if defined(__clang__)
  text += "compiler           clang " __clang_version__ "\n";
#else
  text += "compiler           g++ " __VERSION__ "\n";
#endif
  text += "CPU                " + processor_name() + "\n";
  text += "cores              " + std::to_string(available_cores()) + " for this process\n";
  text += "caches             L1 " + cache(_SC_LEVEL1_DCACHE_SIZE) + ", L2 " + cache(_SC_LEVEL2_CACHE_SIZE) +
          ", L3 " + cache(_SC_LEVEL3_CACHE_SIZE) + "\n";
  return text + "instruction sets   " + sets + "; chosen: " + std::string(name(available.front())) + "\n";
}

}  // namespace tessera::program::cli
