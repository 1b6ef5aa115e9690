#include "tests/rules/source_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

namespace tessera::rules {
namespace {

namespace fs = std::filesystem;

std::string relative_to_root(const fs::path& path) { return fs::relative(path, kRoot).generic_string(); }

}  // namespace

bool is_cpp(const fs::path& path) {
  static const std::set<std::string> kExtensions = {".c",  ".cc",  ".cpp", ".cxx", ".h",
                                                    ".hh", ".hpp", ".hxx", ".inl", ".ipp"};
  return kExtensions.contains(path.extension().string());
}

std::vector<std::string> cpp_files_below(const fs::path& folder) {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && is_cpp(entry.path())) found.push_back(relative_to_root(entry.path()));
  std::sort(found.begin(), found.end());
  return found;
}

const std::vector<std::string>& all_cpp_files() {
  static const std::vector<std::string> files = [] {
    std::vector<std::string> all;
    for (const std::string& folder : kFolders) {
      if (!fs::exists(kRoot / folder)) continue;
      const std::vector<std::string> below = cpp_files_below(kRoot / folder);
      all.insert(all.end(), below.begin(), below.end());
    }
    return all;
  }();
  return files;
}

std::vector<std::string> all_markdown_files() {
  std::vector<std::string> found;
  const auto add = [&](const fs::directory_entry& entry) {
    if (entry.is_regular_file() && entry.path().extension() == ".md")
      found.push_back(relative_to_root(entry.path()));
  };
  for (const auto& entry : fs::directory_iterator(kRoot)) add(entry);
  for (const std::string& folder : kFolders) {
    if (!fs::exists(kRoot / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) add(entry);
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> top_folders() {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(kRoot)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && name.front() != '.' && !name.starts_with("build") &&
        !fs::exists(entry.path() / "CMakeCache.txt"))
      found.push_back(name);
  }
  return found;
}

std::string text_of(const std::string& file) {
  std::ifstream stream(kRoot / file, std::ios::binary);
  EXPECT_TRUE(stream) << file << " cannot be read";
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> lines_of(const std::string& file) {
  std::istringstream stream(text_of(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace tessera::rules
