#include "engine/program/cli/bench_command.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <unistd.h>

#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {

void exec_bench(const std::vector<std::string>& arguments) {
  namespace fs = std::filesystem;
  std::error_code no_program;
  const fs::path folder = fs::read_symlink("/proc/self/exe", no_program).parent_path();
  if (no_program)
    throw Error("/proc/self/exe cannot be read, beside which tessera-bench is: " + no_program.message());
  std::vector<std::string> words{"tessera-bench"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  for (const fs::path& place :
       {folder / words.front(), folder.parent_path() / "libexec" / "tessera" / words.front()}) {
    ::execv(place.c_str(), pointers.data());
    if (errno != ENOENT) throw Error(place.string() + " cannot be started: " + std::strerror(errno));
  }
  throw Error(
      "found no tessera-bench beside this program or in ../libexec/tessera, which measures: builds of the "
      "program make it, and the package tessera holds it");
}

}  // namespace tessera::program::cli
