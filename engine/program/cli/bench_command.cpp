#include "engine/program/cli/bench_command.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <unistd.h>

#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {

void exec_measurement(const std::string& name, const std::vector<std::string>& arguments) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error) throw Error("cannot read /proc/self/exe, which locates " + name + ": " + error.message());
  std::vector<std::string> words{name};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  for (const fs::path& program :
       {folder / words.front(), folder.parent_path() / "libexec" / "tessera" / words.front()}) {
    ::execv(program.c_str(), pointers.data());
    if (errno != ENOENT) throw Error("cannot start \"" + program.string() + "\": " + std::strerror(errno));
  }
  throw Error("found no " + name +
              " next to this program or in ../libexec/tessera; it is built with the program and part of the "
              "package tessera");
}

}  // namespace tessera::program::cli
