// Permitted includes: compares the #include lines of all sources with the floors
// framebuffer < raster < shading < engine and with the rooms of the engine. Includes point down.
// Tests and perf may include everything; no floor includes them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tests/rules/source_files.h"

namespace tessera::rules::floors_test {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

const std::vector<std::string> kFloors = {"framebuffer", "raster", "shading", "engine"};  // lowest first
const std::string kProgram = "engine/program/";
const std::vector<std::string> kPublicFolders = {"engine/tessera/", "framebuffer/tessera/"};
const std::vector<std::string> kCore = {"framebuffer/",    "raster/",         "shading/",
                                        "engine/record/",  "engine/plan/",    "engine/stages/",
                                        "engine/buffers/", "engine/runtime/", "engine/tessera/"};

/// The library tessera::display, which is linked separately from the core.
const std::vector<std::string> kDisplay = {"framebuffer/display/",
                                           "framebuffer/tessera/color.hpp",
                                           "framebuffer/tessera/display.hpp",
                                           "framebuffer/tessera/display_export.h",
                                           "framebuffer/tessera/rgb_primaries.hpp",
                                           "framebuffer/tessera/screen.hpp",
                                           "framebuffer/tessera/transfer_curve.hpp"};
/// Files that both libraries are built with.
const std::set<std::string> kShared = {"framebuffer/check.h", "framebuffer/instruction_set.h",
                                       "framebuffer/lanes.h", "framebuffer/tessera/enums.hpp",
                                       "framebuffer/tessera/scan_timing.hpp"};
/// Headers that hold functions alone, and need nothing of a library.
const std::set<std::string> kArithmetic = {"framebuffer/exact_functions.h", "framebuffer/srgb.h",
                                           "framebuffer/trigonometry.h"};

const std::vector<std::string> kTbb = {"tbb/", "oneapi/"};
const std::vector<std::string> kHighway = {"hwy/"};
const std::vector<std::string> kImageFiles = {"OpenImageIO/", "Imath/", "OpenEXR/",    "png.h",
                                              "pngconf.h",    "libpng", "libdeflate.h"};
const std::vector<std::string> kProgramOnly = {"nlohmann/", "CLI/", "tiny_obj_loader.h", "assimp/"};

const std::set<std::string> kTbbFiles = {"engine/runtime/worker_pool.cpp",
                                         "engine/program/threads/thread_limit.cpp"};

struct Include {
  std::string file;    ///< includes `target`; relative to the root
  int line = 0;        ///< counted from 1
  std::string target;  ///< relative to the root if it names a file of the project, else as written
  bool ours = false;   ///< `target` is a file of the project
};

bool starts_with_any(const std::string& text, const std::vector<std::string>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const std::string& prefix) { return text.starts_with(prefix); });
}

std::string folder_of(const std::string& file) { return file.substr(0, file.find('/')); }
/// Index in kFloors; -1 for tests, perf and files outside the project.
int floor_of(const std::string& file) {
  const auto found = std::find(kFloors.begin(), kFloors.end(), folder_of(file));
  return found == kFloors.end() ? -1 : static_cast<int>(found - kFloors.begin());
}
bool in_display(const std::string& file) { return starts_with_any(file, kDisplay); }
bool in_core(const std::string& file) { return starts_with_any(file, kCore) && !in_display(file); }
bool in_program(const std::string& file) { return file.starts_with(kProgram); }
bool is_public(const std::string& file) { return starts_with_any(file, kPublicFolders); }

/// Searches like the compiler: next to the including file, below the root, and for <tessera/...> in the two
/// folders of public headers. Brackets and quotes are not distinguished.
Include resolve(const std::string& file, int line, const std::string& written) {
  std::vector<fs::path> bases = {(kRoot / file).parent_path(), kRoot};
  if (written.starts_with("tessera/"))
    for (const std::string& folder : kPublicFolders)
      bases.push_back((kRoot / folder).parent_path().parent_path());
  for (const fs::path& base : bases) {
    const fs::path path = (base / written).lexically_normal();
    if (fs::is_regular_file(path)) return {file, line, path.lexically_relative(kRoot).generic_string(), true};
  }
  return {file, line, written, false};
}

/// The path in `# include "path"` or `#include <path>`, with any spacing.
std::optional<std::string> written_include(const std::string& line) {
  std::string text = line;
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t'; });
  if (!text.starts_with("#include")) return std::nullopt;
  const std::size_t open = text.find_first_of("<\"");
  const std::size_t close = open == std::string::npos ? open : text.find_first_of(">\"", open + 1);
  if (close == std::string::npos) return std::nullopt;
  return text.substr(open + 1, close - open - 1);
}

const std::vector<Include>& all_includes() {
  static const std::vector<Include> includes = [] {
    std::vector<Include> all;
    for (const std::string& file : all_cpp_files()) {
      int number = 0;
      for (const std::string& line : lines_of(file)) {
        ++number;
        if (const auto written = written_include(line)) all.push_back(resolve(file, number, *written));
      }
    }
    return all;
  }();
  return includes;
}

std::string where(const Include& include) {
  return include.file + ":" + std::to_string(include.line) + " includes " + include.target;
}

/// Includes on the four floors that begin with one of `prefixes`, in files for which `allowed` is false.
template <class Allowed>
std::vector<std::string> offenders(const std::vector<std::string>& prefixes, Allowed allowed) {
  std::vector<std::string> found;
  for (const Include& include : all_includes())
    if (!include.ours && floor_of(include.file) >= 0 && starts_with_any(include.target, prefixes) &&
        !allowed(include.file))
      found.push_back(where(include));
  return found;
}

TEST(Floors, TestReadsTheSources) {
  const auto& includes = all_includes();
  EXPECT_GT(includes.size(), 1000u);
  EXPECT_TRUE(std::any_of(includes.begin(), includes.end(), [](const Include& i) { return i.ours; }));
}

TEST(Floors, CodeLivesInSixFolders) {
  std::set<std::string> with_code;
  for (const std::string& folder : top_folders())
    if (!cpp_files_below(kRoot / folder).empty()) with_code.insert(folder);
  EXPECT_EQ(with_code, kFolders);
  for (const auto& entry : fs::directory_iterator(kRoot))
    EXPECT_FALSE(entry.is_regular_file() && is_cpp(entry.path()))
        << entry.path().filename() << " lies outside the folders";
}

TEST(Floors, EverySourceOfTheEngineLiesInARoom) {
  for (const std::string& file : cpp_files_below(kRoot / "engine"))
    EXPECT_TRUE(in_core(file) || in_program(file)) << file;
}

TEST(Floors, IncludesPointDown) {
  for (const Include& include : all_includes()) {
    const int from = floor_of(include.file);
    if (from < 0 || !include.ours) continue;
    const int to = floor_of(include.target);
    EXPECT_GE(to, 0) << where(include) << ": only tests and perf may include files outside the floors";
    EXPECT_LE(to, from) << where(include) << ": a floor above";
  }
}

TEST(Floors, EveryProjectPathExists) {
  for (const Include& include : all_includes()) {
    const std::string folder = folder_of(include.target);
    const bool names_project = kFolders.contains(folder) || folder == "tessera";
    const bool has_folder = include.target.find('/') != std::string::npos;
    EXPECT_FALSE(!include.ours && names_project && has_folder) << where(include) << ": no such file";
  }
}

TEST(Floors, CoreIncludesNeitherTheProgramNorTheDisplayLibrary) {
  for (const Include& include : all_includes())
    if (include.ours && in_core(include.file)) {
      EXPECT_TRUE(in_core(include.target)) << where(include);
    }
  EXPECT_THAT(offenders(kProgramOnly, in_program), IsEmpty());
}

// Programs may use one library without the other.
TEST(Floors, DisplayLibraryIncludesOnlyItselfAndWhatBothLibrariesHave) {
  for (const Include& include : all_includes())
    if (include.ours && in_display(include.file)) {
      const bool is_common = kArithmetic.contains(include.target) || kShared.contains(include.target);
      EXPECT_TRUE(in_display(include.target) || is_common) << where(include);
    }
}

TEST(Floors, ProgramIncludesOnlyItselfPublicHeadersAndArithmetic) {
  for (const Include& include : all_includes())
    if (include.ours && in_program(include.file)) {
      const bool is_arithmetic = kArithmetic.contains(include.target);
      EXPECT_TRUE(in_program(include.target) || is_public(include.target) || is_arithmetic) << where(include);
    }
}

TEST(Floors, OneTbbIsIncludedByTwoFiles) {
  std::set<std::string> users;
  for (const Include& include : all_includes())
    if (!include.ours && floor_of(include.file) >= 0 && starts_with_any(include.target, kTbb))
      users.insert(include.file);
  EXPECT_EQ(users, kTbbFiles);
}

TEST(Floors, HighwayIsIncludedByLanesOnly) {
  EXPECT_THAT(offenders(kHighway, [](const std::string& file) { return file == "framebuffer/lanes.h"; }),
              IsEmpty());
}

TEST(Floors, ImageLibrariesStayInTheirModule) {
  const auto allowed = [](const std::string& file) { return file.starts_with("engine/program/imageio/"); };
  EXPECT_THAT(offenders(kImageFiles, allowed), IsEmpty());
}

// Users install these headers alone. Standard headers have neither a folder nor an extension.
TEST(Floors, PublicHeadersIncludeTheStandardLibraryAndEachOther) {
  int headers = 0;
  for (const std::string& folder : kPublicFolders)
    headers += static_cast<int>(cpp_files_below(kRoot / folder).size());
  EXPECT_GE(headers, 5);
  for (const Include& include : all_includes()) {
    if (!is_public(include.file)) continue;
    if (include.ours) EXPECT_TRUE(is_public(include.target)) << where(include);
    else EXPECT_EQ(include.target.find_first_of("/."), std::string::npos) << where(include);
  }
}

/// The name k... of a constant whose definition begins on `line` of a header.
std::optional<std::string> constant_of(const std::string& line) {
  if (!line.starts_with("inline constexpr ")) return std::nullopt;
  const auto in_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  const std::size_t value = line.find_first_of("={[");
  std::size_t end = std::min(value, line.size());
  while (end > 0 && !in_name(line[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && in_name(line[begin - 1])) --begin;
  const std::string name = line.substr(begin, end - begin);
  const bool is_function = line.find('(') < value;
  return is_function || !name.starts_with("k") ? std::nullopt : std::optional(name);
}

// The core shares the namespace tessera::detail, the program tessera::program. The linker merges two inline
// constants of one name in one namespace: part of the code would then read the wrong value.
TEST(Floors, ConstantsOfHeadersHaveUniqueNames) {
  std::map<std::pair<bool, std::string>, std::string> headers;  // (in the program, name) -> file
  for (const std::string& file : all_cpp_files()) {
    const bool is_header = file.ends_with(".h") || file.ends_with(".hpp");
    if (!is_header || floor_of(file) < 0) continue;
    for (const std::string& line : lines_of(file))
      if (const auto name = constant_of(line)) {
        const auto [first, is_new] = headers.emplace(std::pair(in_program(file), *name), file);
        EXPECT_TRUE(is_new) << *name << " is in " << first->second << " and in " << file;
      }
  }
  EXPECT_GT(headers.size(), 50u);
}

}  // namespace
}  // namespace tessera::rules::floors_test
