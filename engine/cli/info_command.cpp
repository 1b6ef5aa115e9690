#include "engine/cli/info_command.h"

#include <fstream>
#include <vector>

#include <unistd.h>

#include "engine/imageio/picture.h"
#include "engine/import/model.h"
#include "engine/parallel.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::cli {
namespace {

std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (const std::size_t colon = line.find(": "); line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  return "unknown";
}

std::string cache(int name) {
  const long bytes = ::sysconf(name);
  return bytes > 0 ? std::to_string(bytes / 1024) + " KiB" : "unknown";
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
  return text;
}

std::string count_of(std::vector<std::string> endings(), const char* what) {
  try {
    return std::to_string(endings().size()) + " endings " + what;
  } catch (const Error& missing) {
    return missing.what();
  }
}

}  // namespace

std::string machine_text() {
  std::vector<std::string> sets;
  for (const InstructionSet set : available_instruction_sets()) sets.emplace_back(name(set));
  std::string text = "tessera            " + std::string(version()) + "\n";
#if defined(__clang__)
  text += "compiler           clang " __clang_version__ "\n";
#else
  text += "compiler           g++ " __VERSION__ "\n";
#endif
  text += "CPU                " + cpu_name() + "\n";
  text += "cores              " + std::to_string(available_cores()) + " for this process\n";
  text += "caches             L1 " + cache(_SC_LEVEL1_DCACHE_SIZE) + ", L2 " + cache(_SC_LEVEL2_CACHE_SIZE) + ", L3 " + cache(_SC_LEVEL3_CACHE_SIZE) + "\n";
  return text + "instruction sets   " + listed(sets) + "; chosen: " + sets.front() + "\n";
}

std::string info_text() {
  std::string text = machine_text();
  text += "image module       " + count_of(module_endings, "written") + "\n";
  return text + "import module      " + count_of(model_endings, "read") + "\n";
}

std::string formats_text() {
  std::string text = "scenes    .json\nmodels    .obj\n";
  try {
    text += "          by the import module: " + listed(model_endings()) + "\n";
  } catch (const Error& missing) {
    text += "          " + std::string(missing.what()) + "\n";
  }
  text += "pictures  " + listed(own_endings()) + "\n";
  try {
    text += "          by the image module: " + listed(module_endings()) + "\n";
  } catch (const Error& missing) {
    text += "          " + std::string(missing.what()) + "\n";
  }
  return text;
}

}  // namespace tessera::cli
