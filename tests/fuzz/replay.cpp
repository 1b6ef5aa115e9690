// Runs a fuzz target over files and folders of files: the tests of every build replay the corpus.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/target.h"

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_below(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t count = 0;
  for (int i = 1; i < argc; ++i)
    for (const fs::path& path : files_below(argv[i])) {
      std::fprintf(stderr, "%s\n", path.c_str());  // the last line before a crash names its input
      std::ifstream file(path, std::ios::binary);
      if (!file) {
        std::fprintf(stderr, "replay: cannot read it\n");
        return 1;
      }
      const std::string bytes(std::istreambuf_iterator<char>(file), {});
      // An exact copy, so that sanitizers detect reads past the end.
      const std::vector<std::uint8_t> input(bytes.begin(), bytes.end());
      LLVMFuzzerTestOneInput(input.data(), input.size());
      ++count;
    }
  std::fprintf(stderr, "replay: %zu inputs\n", count);
  return count > 0 ? 0 : 1;  // an empty corpus tests nothing
}
