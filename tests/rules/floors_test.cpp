// The house rules that a compiler does not check: reads the #include lines of every source and compares them
// with the floors framebuffer < raster < shading < engine. Includes point down; tests and perf may include
// everything, nothing includes them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = TESSERA_SOURCE_DIR;
const std::vector<std::string> kFloors = {"framebuffer", "raster", "shading", "engine"};  // from the ground
const std::set<std::string> kFolders = {"framebuffer", "raster", "shading", "engine", "tests", "perf"};

struct Include {
  std::string file;  // that holds the line, relative to the root
  int line = 0;
  std::string target;  // relative to the root if it is ours, else as written
  bool ours = false;
};

bool is_source(const fs::path& path) {
  static const std::set<std::string> kExtensions = {".c",  ".cc",  ".cpp", ".cxx", ".h",
                                                    ".hh", ".hpp", ".hxx", ".inl", ".ipp"};
  return kExtensions.contains(path.extension().string());
}

std::vector<std::string> sources_below(const fs::path& folder) {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && is_source(entry.path()))
      found.push_back(fs::relative(entry.path(), kRoot).generic_string());
  std::sort(found.begin(), found.end());
  return found;
}

// Hidden folders and build trees are not ours to judge.
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

// An include is ours if it names a file beside the includer or below the root; brackets or quotes make no
// difference.
Include resolve(const std::string& file, int line, const std::string& written) {
  for (const fs::path& base : {(kRoot / file).parent_path(), kRoot}) {
    const fs::path path = (base / written).lexically_normal();
    if (fs::is_regular_file(path)) return {file, line, path.lexically_relative(kRoot).generic_string(), true};
  }
  return {file, line, written, false};
}

// What a line includes, as written: `# include "path"` or `#include <path>`, however spaced.
std::optional<std::string> written_include(const std::string& line) {
  std::string text = line;
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t'; });
  if (!text.starts_with("#include")) return std::nullopt;
  const std::size_t open = text.find_first_of("<\"");
  const std::size_t close = open == std::string::npos ? open : text.find_first_of(">\"", open + 1);
  if (close == std::string::npos) return std::nullopt;
  return text.substr(open + 1, close - open - 1);
}

std::vector<Include> includes_of(const std::string& file) {
  std::vector<Include> found;
  std::ifstream stream(kRoot / file);
  EXPECT_TRUE(stream) << file;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (const auto written = written_include(line)) found.push_back(resolve(file, number, *written));
  }
  return found;
}

// Every include of the project.
const std::vector<Include>& all_includes() {
  static const std::vector<Include> includes = [] {
    std::vector<Include> all;
    for (const std::string& folder : kFolders) {
      if (!fs::exists(kRoot / folder)) continue;
      for (const std::string& file : sources_below(kRoot / folder))
        for (const Include& include : includes_of(file)) all.push_back(include);
    }
    return all;
  }();
  return includes;
}

std::string folder_of(const std::string& file) { return file.substr(0, file.find('/')); }
int floor_of(const std::string& file) {  // -1: tests, perf, or not ours
  const auto found = std::find(kFloors.begin(), kFloors.end(), folder_of(file));
  return found == kFloors.end() ? -1 : static_cast<int>(found - kFloors.begin());
}
// The library itself: what is below the engine, and what lies in the engine's folder but not in one of its
// own folders.
bool in_core(const std::string& file) {
  const int floor = floor_of(file);
  return floor >= 0 &&
         (floor < 3 || std::count(file.begin(), file.end(), '/') == 1 || file.starts_with("engine/tessera/"));
}
bool starts_with_any(const std::string& text, const std::vector<std::string>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const std::string& prefix) { return text.starts_with(prefix); });
}
std::string where(const Include& include) {
  return include.file + ":" + std::to_string(include.line) + " includes " + include.target;
}

const std::vector<std::string> kThreads = {"tbb/", "oneapi/"};
const std::vector<std::string> kLanes = {"hwy/"};
const std::vector<std::string> kImageFiles = {"OpenImageIO/", "Imath/",    "OpenEXR/",
                                              "png.h",        "pngconf.h", "libpng"};
const std::vector<std::string> kProgramOnly = {"nlohmann/", "CLI/", "tiny_obj_loader.h", "assimp/"};
const std::vector<std::string> kMath = {"glm/"};

// Those includes of the four floors that name one of `prefixes` in a file that is not `allowed`.
template <class Allowed>
std::vector<std::string> offenders(const std::vector<std::string>& prefixes, Allowed allowed) {
  std::vector<std::string> found;
  for (const Include& include : all_includes())
    if (!include.ours && floor_of(include.file) >= 0 && starts_with_any(include.target, prefixes) &&
        !allowed(include.file))
      found.push_back(where(include));
  return found;
}

TEST(Floors, TheReaderSeesTheSources) {
  EXPECT_GT(all_includes().size(), 30u);
  EXPECT_TRUE(
      std::any_of(all_includes().begin(), all_includes().end(), [](const Include& i) { return i.ours; }));
}

TEST(Floors, CodeLivesInSixFolders) {
  std::set<std::string> with_code;
  for (const std::string& folder : top_folders())
    if (!sources_below(kRoot / folder).empty()) with_code.insert(folder);
  EXPECT_EQ(with_code, kFolders);
  for (const auto& entry : fs::directory_iterator(kRoot))
    EXPECT_FALSE(entry.is_regular_file() && is_source(entry.path()))
        << entry.path().filename() << " lies outside the folders";
}

TEST(Floors, IncludesPointDown) {
  for (const Include& include : all_includes()) {
    const int from = floor_of(include.file);
    if (from < 0 || !include.ours) continue;
    const int to = floor_of(include.target);
    EXPECT_GE(to, 0) << where(include) << ": nothing includes tests, perf or what lies outside the floors";
    EXPECT_LE(to, from) << where(include) << ": a floor above";
  }
}

TEST(Floors, EveryQuotedProjectPathExists) {
  for (const Include& include : all_includes())
    EXPECT_FALSE(!include.ours && kFolders.contains(folder_of(include.target)) &&
                 include.target.find('/') != std::string::npos)
        << where(include) << ": no such file";
}

TEST(Floors, TheLibraryDoesNotIncludeTheProgram) {
  for (const Include& include : all_includes())
    EXPECT_TRUE(!include.ours || !in_core(include.file) || in_core(include.target)) << where(include);
  EXPECT_THAT(offenders(kProgramOnly, [](const std::string& file) { return !in_core(file); }),
              testing::IsEmpty());
}

TEST(Floors, OneFileIncludesOneTbb) {
  EXPECT_THAT(
      offenders(kThreads, [](const std::string& file) { return file == "engine/runtime/worker_pool.cpp"; }),
      testing::IsEmpty());
  const auto in_parallel = [](const Include& i) {
    return i.file == "engine/runtime/worker_pool.cpp" && starts_with_any(i.target, kThreads);
  };
  EXPECT_TRUE(std::any_of(all_includes().begin(), all_includes().end(), in_parallel))
      << "engine/runtime/worker_pool.cpp";
}

TEST(Floors, HighwayComesThroughLanes) {
  EXPECT_THAT(offenders(kLanes, [](const std::string& file) { return file == "framebuffer/lanes.h"; }),
              testing::IsEmpty());
}

TEST(Floors, ImageLibrariesStayInTheirModule) {
  EXPECT_THAT(offenders(kImageFiles,
                        [](const std::string& file) { return file.starts_with("engine/program/imageio"); }),
              testing::IsEmpty());
}

// The name of a constant that a line of a header begins to define: what stands before its value.
std::optional<std::string> constant_of(const std::string& line) {
  if (!line.starts_with("inline constexpr ")) return std::nullopt;
  const auto is_of_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  const std::size_t value = line.find_first_of("={[");
  std::size_t end = std::min(value, line.size());
  while (end > 0 && !is_of_name(line[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && is_of_name(line[begin - 1])) --begin;
  const std::string name = line.substr(begin, end - begin);
  const bool is_function = line.find('(') < value;
  return is_function || !name.starts_with("k") ? std::nullopt : std::optional(name);
}

// One namespace holds all floors: of two constants with one name, which a linker takes for one, half of the
// code reads the other.
TEST(Floors, ConstantsOfHeadersHaveNamesOfTheirOwn) {
  std::map<std::string, std::string> headers;
  for (const std::string& floor : kFloors)
    for (const std::string& file : sources_below(kRoot / floor)) {
      if (!file.ends_with(".h") && !file.ends_with(".hpp")) continue;
      std::ifstream stream(kRoot / file);
      for (std::string line; std::getline(stream, line);)
        if (const auto name = constant_of(line)) {
          const auto [first, is_new] = headers.emplace(*name, file);
          EXPECT_TRUE(is_new) << *name << " is in " << first->second << " and in " << file;
        }
    }
  EXPECT_GT(headers.size(), 50u);
}

TEST(Floors, ThePublicHeaderBringsTheStandardLibraryAlone) {
  std::set<std::string> seen;
  std::vector<std::string> open = {"engine/tessera/tessera.hpp"};
  while (!open.empty()) {
    const std::string file = open.back();
    open.pop_back();
    if (!seen.insert(file).second) continue;
    for (const Include& include : includes_of(file)) {
      for (const auto* library : {&kThreads, &kLanes, &kImageFiles, &kProgramOnly, &kMath})
        EXPECT_FALSE(starts_with_any(include.target, *library)) << where(include);
      if (include.ours) open.push_back(include.target);
      EXPECT_TRUE(include.ours || include.target.find('/') == std::string::npos) << where(include);
    }
  }
  EXPECT_THAT(seen, testing::Each(testing::StartsWith("engine/tessera/"))) << "no other header is installed";
}

}  // namespace
