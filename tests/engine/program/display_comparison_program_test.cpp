// `tessera display --presets`.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>

#include "engine/program/imageio/picture.h"
#include "framebuffer/tessera/display.hpp"
#include "tests/engine/program/program.h"

namespace tessera::display_comparison_program_test {
namespace {

using program::Picture;
using program::read_picture;

class DisplayComparison : public Program {
 protected:
  Picture picture(const std::string& name) const { return read_picture((folder_ / name).string()); }
  void expect_equal(const std::string& a, const std::string& b) const {
    const Picture first = picture(a), second = picture(b);
    EXPECT_EQ(first.width, second.width) << a;
    EXPECT_TRUE(first.rgba == second.rgba) << a;
  }
};

/// Options that the program prints for a preset.
struct Views {
  std::string mode, whole, near;
};

std::map<std::string, Views> views_of(const std::string& text) {
  std::map<std::string, Views> views;
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string name, option, gain;
    Views found;
    words >> name >> found.mode >> option >> gain;
    found.whole = option + " " + gain;
    std::getline(words, found.near);
    views[name] = found;
  }
  return views;
}

/// The pixels of a part of a picture.
Picture part_of(const Picture& source, int left, int top, int width, int height) {
  Picture part(width, height);
  for (int y = 0; y < height; ++y) {
    const auto from = source.rgba.begin() + 4 * ((top + y) * source.width + left);
    std::copy(from, from + 4 * width, part.rgba.begin() + 4 * y * width);
  }
  return part;
}

constexpr const char* kScene = R"({"tessera": 1,
  "framebuffer": {"width": 640, "height": 480},
  "meshes": {"q": {"builtin": "quad"}},
  "frame": [{"clear": {"color": [0.2, 0.5, 0.3, 1], "depth": 1}},
            {"draw": "q", "transform": [{"scale": [0.5, 0.5, 1]}], "lighting": false}]})";

TEST_F(DisplayComparison, ShowsASceneOnEachPreset) {
  write("scene.json", kScene);
  const Result result = run("display --presets scene.json --near 0.6,0.55 -o a/b");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const std::map<std::string, Views> views = views_of(result.out);
  ASSERT_EQ(views.size(), display_presets().size()) << result.out;
  for (const DisplayPreset& preset : display_presets()) {
    const std::string name(preset.name);
    EXPECT_EQ(views.at(name).mode, preset.mode);
    EXPECT_EQ(picture("a/b/" + name + ".png").height, 1440) << name;
    EXPECT_EQ(picture("a/b/" + name + "-near.png").width, 640) << name;
    EXPECT_EQ(picture("a/b/" + name + "-near.png").height, 480) << name;
  }
  const std::map<std::string, std::string> dithers{
      {"mono12", "--dither blue_noise --dither-in light"},
      {"1084s", "--dither blue_noise --dither-in light --palette adaptive"},
      {"cga-composite", "--dither bayer4 --dither-in levels"},
      {"plasma-tv", ""}};
  for (const auto& [name, dither] : dithers) {
    const Views& view = views.at(name);
    const std::string render =
        "render scene.json --mode " + view.mode + " --display " + name + " " + dither + " ";
    ASSERT_EQ(run(render + view.near + " -o near.png").code, 0) << name;
    expect_equal("a/b/" + name + "-near.png", "near.png");
  }
  ASSERT_EQ(run("render scene.json --mode 852x480x24 --display plasma-tv " + views.at("plasma-tv").whole +
                " -o whole.png")
                .code,
            0);
  expect_equal("a/b/plasma-tv.png", "whole.png");
  const Picture sheet = picture("a/b/contact.png"), near = picture("a/b/cga-near.png");
  EXPECT_EQ(sheet.width, 16 + 5 * 336);
  EXPECT_TRUE(part_of(sheet, 16 + 336, 16 + 240 + 6, 320, 240).rgba == part_of(near, 160, 120, 320, 240).rgba)
      << "the second cell has the middle of the close-up of the second preset";
}

TEST_F(DisplayComparison, ReportsErrorsInOneLine) {
  write("broken.json", R"({"tessera": 1, "frame": [{"draw": "nothing"}]})");
  write("file", "");
  const struct {
    const char* arguments;
    int code;
    const char* fragment;
  } kBad[] = {
      {"--presets", 2, "-o: found none, expected a folder"},
      {"--presets -o -", 2, "-o: found \"-\", expected a folder"},
      {"--presets -o term", 2, "-o: found \"term\", expected a folder"},
      {"--presets a.json b.json -o all", 2, "--presets: found 2 scenes, expected one or none"},
      {"--presets --display cga -o all", 2, "--display: excludes --presets"},
      {"--presets --mode cga -o all", 2, "--mode: excludes --presets"},
      {"--presets --scale 2 -o all", 2, "--scale: excludes --presets"},
      {"--presets --part 1,2,3,4 -o all", 2, "--part: excludes --presets"},
      {"--presets --gain 2 -o all", 2, "--gain: excludes --presets"},
      {"--presets --time 2 -o all", 2, "--time: excludes --presets"},
      {"--presets --frame-ms 2 -o all", 2, "--frame-ms: excludes --presets"},
      {"--presets --signal s.pfm -o all", 2, "--signal: excludes --presets"},
      {"--presets --compression 2 -o all", 2, "--compression: excludes --presets"},
      {"--presets --list -o all", 2, "--list: excludes --presets"},
      {"--presets --json -o all", 2, "--json: excludes --presets"},
      {"--presets --near 0.5 -o all", 2, "--near: found \"0.5\", expected X,Y from 0 to 1"},
      {"--presets --near 0.5,1.1 -o all", 2, "--near: found \"0.5,1.1\""},
      {"--presets --near -0.5,1 -o all", 2, "--near: found \"-0.5,1\""},
      {"--near 0.5,0.5 a.png --display crt -o all", 2, "--near: needs --presets"},
      {"--presets broken.json -o all", 1, "broken.json: /frame/0/draw"},
      {"--presets missing.json -o all", 1, "missing.json"},
      {"--presets -o file", 1, "file"},
      {"--presets -o file/all", 1, "cannot make the folder \"file/all\""},
  };
  for (const auto& row : kBad) {
    const Result result = run("display " + std::string(row.arguments));
    EXPECT_EQ(result.code, row.code) << row.arguments << "\n" << result.err;
    EXPECT_TRUE(contains(result.err, row.fragment)) << row.arguments << "\n" << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
    EXPECT_EQ(result.out, "") << row.arguments;
    EXPECT_FALSE(exists("all")) << row.arguments;
  }
}

}  // namespace
}  // namespace tessera::display_comparison_program_test
#endif
