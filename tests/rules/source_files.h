// The project's source files as text, for tests of the rules that a compiler does not check.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace tessera::rules {

inline const std::filesystem::path kRoot = TESSERA_SOURCE_DIR;
/// The only top-level folders that hold C++.
inline const std::set<std::string> kFolders = {"framebuffer", "raster", "shading", "engine", "tests", "perf"};

bool is_cpp(const std::filesystem::path& path);

/// C++ files below `folder`, sorted, relative to kRoot.
std::vector<std::string> cpp_files_below(const std::filesystem::path& folder);
/// C++ files below kFolders.
const std::vector<std::string>& all_cpp_files();
/// Markdown files at the root and below kFolders.
std::vector<std::string> all_markdown_files();
/// Top-level folders, without hidden folders and build trees.
std::vector<std::string> top_folders();

/// `file` is relative to kRoot. A test failure if it cannot be read.
std::string text_of(const std::string& file);
std::vector<std::string> lines_of(const std::string& file);

}  // namespace tessera::rules
