// `tessera gallery`.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "engine/program/imageio/picture.h"
#include "tests/engine/program/program.h"

namespace tessera::gallery_program_test {
namespace {

using program::Picture;
using program::read_picture;

/// Texts between two marks, one for each pair of them.
std::vector<std::string> all_between(const std::string& text, const std::string& begin,
                                     const std::string& end) {
  std::vector<std::string> found;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    at += begin.size();
    found.push_back(text.substr(at, text.find(end, at) - at));
  }
  return found;
}

std::string text_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Names of the scenes in the sources.
std::set<std::string> scenes_in_sources() {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(TESSERA_SOURCE_DIR "/engine/program/gallery"))
    if (entry.path().extension() == ".json") names.insert(entry.path().stem().string());
  return names;
}

/// Pictures whose commands have options or whose scenes have stages, and every eighth of the others.
std::vector<std::string> pictures_of_all_kinds() {
  const std::string folder = TESSERA_SOURCE_DIR "/engine/program/gallery/";
  std::vector<std::string> names;
  std::istringstream list(text_of(folder + "gallery.txt"));
  int others = 0;
  for (std::string line; std::getline(list, line);) {
    const std::string name = line.substr(0, line.find(' '));
    if (name.empty() || name == "#" || name == "==" || name == "+") continue;
    const bool is_special = contains(line, " --") || contains(text_of(folder + name + ".json"), "\"stages\"");
    if (is_special || others++ % 8 == 0) names.push_back(name);
  }
  return names;
}

bool has_several_colors(const Picture& picture) {
  for (std::size_t i = 4; i < picture.rgba.size(); i += 4)
    if (!std::equal(picture.rgba.begin(), picture.rgba.begin() + 3,
                    picture.rgba.begin() + static_cast<std::ptrdiff_t>(i)))
      return true;
  return false;
}

class GalleryProgram : public Program {
 protected:
  std::set<std::string> files(const std::string& folder) const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / folder))
      names.insert(entry.path().filename().string());
    return names;
  }
  Picture picture(const std::string& name) const { return read_picture((folder_ / name).string()); }
  /// Width of a PNG file, from its header.
  int width_of(const std::string& name) const {
    const std::string file = content(name);
    int width = 0;
    for (std::size_t i = 16; i < 20; ++i) width = width << 8 | static_cast<std::uint8_t>(file.at(i));
    return width;
  }
  /// Runs the page's commands for the pictures, and compares their files with those of the folder.
  void expect_same_bytes_from_commands(const std::string& gallery, const std::vector<std::string>& names) {
    const std::string page = content(gallery + "/index.html");
    std::filesystem::create_directories(folder_ / "alone");
    for (const std::string& name : names) {
      const std::vector<std::string> commands =
          all_between(page, "<code>tessera render " + name + ".json -o ", "</code>");
      ASSERT_EQ(commands.size(), 1u) << name;
      const std::string line = "cd '" + (folder_ / gallery).string() + "' && '" TESSERA_PROGRAM "' render " +
                               name + ".json -o ../../alone/" + commands.front();
      EXPECT_EQ(std::system(line.c_str()), 0) << line;
      const std::string file = "/" + name + ".png";
      EXPECT_TRUE(content("alone" + file) == content(gallery + file)) << name;
    }
  }
};

// Chunks of animated PNG: acTL with the number of frames, and an fcTL before each frame.
TEST_F(GalleryProgram, AnimationsAreAnimatedPng) {
  ASSERT_EQ(run("gallery g zoom").code, 0);
  const std::string file = content("g/zoom.png");
  EXPECT_TRUE(contains(file, std::string("acTL\0\0\0\x18", 8))) << "24 frames";
  EXPECT_EQ(all_between(file, "fcTL", "IEND").size(), 24u);
  EXPECT_TRUE(contains(content("g/index.html"), "zoom.json -o zoom.png --frames 24 --delay 70</code>"));
  EXPECT_EQ(width_of("g/zoom.png"), 320);
}

// The lower right part of the picture shows other values, and labels cover the lowest rows of each part.
TEST_F(GalleryProgram, LightingIsEqualInEyeAndWorldSpace) {
  constexpr int kPartWidth = 319, kPartHeight = 239, kLabelRows = 24;
  const std::string scene = TESSERA_SOURCE_DIR "/engine/program/gallery/lighting_spaces.json";
  ASSERT_EQ(run("render '" + scene + "' -o spaces.ppm").code, 0);
  const Picture drawn = picture("spaces.ppm");
  const auto level = [&](int x, int y, int c) {
    return int{drawn.rgba[static_cast<std::size_t>(4 * (y * drawn.width + x) + c)]};
  };
  int largest = 0, lowest = 255, highest = 0;
  for (int y = 0; y < kPartHeight - kLabelRows; ++y)
    for (int x = 0; x < kPartWidth; ++x)
      for (int c = 0; c < 3; ++c) {
        const int eye = level(drawn.width - kPartWidth + x, y, c);
        const int world = level(x, drawn.height - kPartHeight + y, c);
        largest = std::max(largest, std::abs(eye - world));
        lowest = std::min(lowest, eye);
        highest = std::max(highest, eye);
      }
  EXPECT_LE(largest, 1);
  EXPECT_GT(highest - lowest, 150);
}

TEST_F(GalleryProgram, WritesAPageThatNeedsOnlyItsFolderAndWhoseCommandsDrawTheSameBytes) {
  const Result result = run("gallery a/b");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const std::string page = content("a/b/index.html");
  for (const char* unwanted : {"http", "<script", "@import", "url("}) EXPECT_FALSE(contains(page, unwanted));
  std::set<std::string> linked{"index.html"};
  for (const char* attribute : {"href=\"", "src=\""})
    for (const std::string& file : all_between(page, attribute, "\"")) linked.insert(file);
  EXPECT_EQ(linked, files("a/b"));
  for (const std::string& name : scenes_in_sources()) {
    EXPECT_TRUE(linked.contains(name + ".json") && linked.contains(name + ".png")) << name;
    EXPECT_TRUE(has_several_colors(picture("a/b/" + name + ".png"))) << name;
  }
  EXPECT_TRUE(has_several_colors(picture("a/b/index.png")));
  EXPECT_TRUE(contains(page, "aspect-ratio: 1.3333")) << "modes have pixels that are not square";
  EXPECT_EQ(all_between(page, "<code>tessera render ", "</code>").size(), scenes_in_sources().size());
  const std::vector<std::string> compared = pictures_of_all_kinds();
  EXPECT_GE(compared.size(), 25u);
  expect_same_bytes_from_commands("a/b", compared);
}

TEST_F(GalleryProgram, ReplacesItsOwnFilesOnly) {
  std::filesystem::create_directories(folder_ / "g");
  write("g/notes.txt", "mine");
  write("g/planes.png", "mine");
  const Result refused = run("gallery g planes");
  EXPECT_EQ(refused.code, 1);
  EXPECT_TRUE(contains(refused.err, "\"g/planes.png\" exists and is not a file of a gallery")) << refused.err;
  EXPECT_EQ(files("g").size(), 2u);
  ASSERT_EQ(run("gallery g bits_01").code, 0);
  write("g/bits_01.png", "damaged");
  ASSERT_EQ(run("gallery g bits_01 bits_02").code, 0);
  EXPECT_EQ(run("gallery g planes").code, 1) << "the page does not link planes.png";
  EXPECT_EQ(content("g/notes.txt") + content("g/planes.png"), "minemine");
  EXPECT_NE(content("g/bits_01.png"), "damaged");
  write("g/index.html", "<p>mine</p>");
  EXPECT_EQ(run("gallery g bits_01").code, 1);
  EXPECT_EQ(content("g/index.html"), "<p>mine</p>");
}

TEST_F(GalleryProgram, KeepsPicturesOfEarlierRunsOnItsPage) {
  ASSERT_EQ(run("gallery g bits_02").code, 0);
  const int width_of_one = width_of("g/index.png");
  EXPECT_LT(width_of_one, 700) << "one column of at most 640";
  const Result second = run("gallery g bits_01");
  EXPECT_EQ(second.out, "1 picture in g; index.html shows 2\n");
  EXPECT_GT(width_of("g/index.png"), width_of_one);
  const std::string page = content("g/index.html");
  EXPECT_LT(page.find("bits_01.png"), page.find("bits_02.png")) << "the order is that of the list";
  std::filesystem::remove(folder_ / "g/bits_02.png");
  EXPECT_EQ(run("gallery g bits_01").out, "1 picture in g; index.html shows 1\n");
}

TEST_F(GalleryProgram, ListsItsPictures) {
  const Result result = run("gallery --list");
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(result.out, '\n')), scenes_in_sources().size());
  for (const std::string& name : scenes_in_sources())
    EXPECT_TRUE(contains("\n" + result.out, "\n" + name + " "));
  EXPECT_TRUE(contains(result.out, "  One bit for each pixel: black and white\n")) << result.out;
  EXPECT_GE(scenes_in_sources().size(), 60u);
}

TEST_F(GalleryProgram, NamesPicturesNearAnUnknownOne) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"g shadow",
       "found \"shadow\", expected a picture of the gallery; near it: shadow_directional, shadow_point, "
       "shadow_volumes, soft_shadow; tessera gallery --list names all"},
      {"g plains", "near it: planes; "},
      {"g bits_32", "near it: bits_01, bits_02, "},
      {"g zzzzzz", "expected a picture of the gallery; tessera gallery --list"},
      {"", "DIR: found none, expected the folder for the pictures, or --list"},
      {"--list g", "--list: prints names without drawing, excludes DIR"}};
  for (const auto& [arguments, message] : cases) {
    const Result result = run("gallery " + arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_TRUE(contains(result.err, message)) << result.err;
    EXPECT_FALSE(exists("g"));
  }
}

}  // namespace
}  // namespace tessera::gallery_program_test
#endif
