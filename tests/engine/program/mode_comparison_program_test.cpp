// `tessera modes SCENE -o DIR`.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "engine/program/imageio/picture.h"
#include "engine/tessera/display_mode.hpp"
#include "tests/engine/program/program.h"

namespace tessera::mode_comparison_program_test {
namespace {

using Json = nlohmann::json;
using program::Picture;
using program::read_picture;

class ModeComparison : public Program {
 protected:
  Picture picture(const std::string& name) const { return read_picture((folder_ / name).string()); }
  Json rows(const std::string& folder) const { return Json::parse(content(folder + "/modes.json"))["rows"]; }
};

std::set<std::uint32_t> colors_of(const Picture& picture) {
  std::set<std::uint32_t> colors;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    colors.insert(std::uint32_t{picture.rgba[i]} << 16 | std::uint32_t{picture.rgba[i + 1]} << 8 |
                  picture.rgba[i + 2]);
  return colors;
}

/// All colours of a converter of `bits` bits per component.
std::set<std::uint32_t> converter_colors(int bits) {
  const std::uint32_t max_level = (1u << bits) - 1;
  const auto shown = [&](std::uint32_t v) { return (2 * 255 * v + max_level) / (2 * max_level); };
  std::set<std::uint32_t> colors;
  for (std::uint32_t i = 0; i < 1u << (3 * bits); ++i)
    colors.insert(shown(i >> (2 * bits)) << 16 | shown(i >> bits & max_level) << 8 | shown(i & max_level));
  return colors;
}

/// All colours that a mode can show; a mode of 12 bits has components of 4 bits.
std::set<std::uint32_t> colors_of(const DisplayMode& mode) {
  if (mode.palette_component_bits > 0) return converter_colors(mode.palette_component_bits);
  const auto level = [](float c) { return static_cast<std::uint32_t>(c * 255 + 0.5f); };
  std::set<std::uint32_t> colors;
  for (const Color& c : mode.palette) colors.insert(level(c.r) << 16 | level(c.g) << 8 | level(c.b));
  if (mode.color_bits == 12)
    for (std::uint32_t i = 0; i < 4096; ++i)
      colors.insert(((i >> 8) * 17) << 16 | ((i >> 4 & 15) * 17) << 8 | (i & 15) * 17);
  if (mode.color_mode == ColorMode::rgb && mode.color_bits == 1) colors = {0, 0xffffff};
  return colors;
}

TEST_F(ModeComparison, WritesAPictureForEachModeAndDither) {
  const Result result = run("modes -o a/b --modes hercules,cga,svga56,320x240x12,svga --dithers none,bayer8");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const Json rows = this->rows("a/b");
  ASSERT_EQ(rows.size(), 8u);
  const std::string csv = content("a/b/modes.csv");
  EXPECT_EQ(std::ranges::count(csv, '\n'), 9);
  EXPECT_TRUE(contains(csv, "\n\"svga56, svga\",800,600,8,bayer8,0,480000,")) << csv;
  EXPECT_EQ(std::ranges::count(result.out, '\n'), 10);
  EXPECT_TRUE(contains(result.out, "\nsvga56, svga  800x600x8      bayer8  directly      480000"))
      << result.out;
  EXPECT_TRUE(contains(result.out, "both are here because")) << result.out;
  for (const Json& row : rows) {
    const DisplayMode mode = display_mode(row["modes"][0].get<std::string>());
    const std::string file = mode.name + "-" + row["dither"].get<std::string>() + ".png";
    EXPECT_EQ(row["picture"], file);
    const Picture shown = picture("a/b/" + file);
    EXPECT_EQ(shown.width, mode.width) << file;
    EXPECT_EQ(shown.height, mode.height) << file;
    const std::set<std::uint32_t> found = colors_of(shown), known = colors_of(mode);
    EXPECT_GE(found.size(), 2u) << file;
    EXPECT_LE(found.size(), std::size_t{1} << mode.color_bits) << file;
    EXPECT_TRUE(std::ranges::includes(known, found)) << file;
    EXPECT_EQ(row["mode_bytes"], memory_bytes(mode));
    EXPECT_EQ(row["buffer_bytes"], FrameBuffer::memory_bytes(frame_buffer_format(mode))) << file;
    EXPECT_GT(row["frame_ms"].get<double>(), 0);
  }
}

TEST_F(ModeComparison, PicturesAreThoseOfRender) {
  ASSERT_EQ(run("modes -o all --modes ega-lo,320x200x24:aspect=5:6 --dithers bayer4").code, 0);
  ASSERT_EQ(run("render --mode ega-lo --dither bayer4 -o shown.png").code, 0);
  EXPECT_EQ(picture("shown.png").rgba, picture("all/ega-lo-bayer4.png").rgba);
  ASSERT_EQ(run("render --mode 320x200x24:aspect=5:6 -o exact.png").code, 0);
  EXPECT_EQ(picture("exact.png").rgba, picture("all/reference-320x200-pixels-5x6.png").rgba);
  EXPECT_TRUE(exists("all/320x200x24_aspect=5_6-bayer4.png"));
  for (const Json& row : rows("all")) EXPECT_EQ(row["reference"], "reference-320x200-pixels-5x6.png");
}

TEST_F(ModeComparison, FlipIsThatOfCompare) {
  const Result result = run("modes -o all --modes vga,gray2,vga24 --dithers none,bayer2 --json");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, content("all/modes.json"));
  for (const Json& row : rows("all")) {
    const std::string pair = "compare --json all/" + row["picture"].get<std::string>() + " all/" +
                             row["reference"].get<std::string>();
    EXPECT_EQ(Json::parse(run(pair).out)["flip"]["mean"], row["flip_monitor"]) << row;
    const std::string own = " --ppd " + row["own_pixels_per_degree"].dump();
    EXPECT_EQ(Json::parse(run(pair + own).out)["flip"]["mean"], row["flip_own"]) << row;
    if (row["width"] == 640) {
      EXPECT_NEAR(row["own_pixels_per_degree"].get<double>(), 19.6, 0.05);
    }
    const bool is_exact = row["color_bits"] == 24 && row["dither"] == "none";
    EXPECT_EQ(row["flip_monitor"] == 0.0, is_exact) << row;
  }
}

TEST_F(ModeComparison, ReducesScenesThatPaletteBuffersRefuse) {
  write("blend.json", R"({"tessera": 1, "framebuffer": {"dither": "bayer8"},
    "meshes": {"q": {"builtin": "quad"}},
    "frame": [{"clear": {"color": [1, 0.5, 0, 1]}}, {"draw": "q", "blend": {}, "lighting": false}]})");
  const Result result = run("modes blend.json -o all --modes cga,320x200x15 --dithers none,bayer8");
  ASSERT_EQ(result.code, 0) << result.err;
  for (const Json& row : rows("all")) EXPECT_EQ(row["reduced"], row["color_bits"] == 2) << row;
  ASSERT_EQ(run("render blend.json --mode cga --reduce -o cga.png").code, 0);
  EXPECT_EQ(picture("cga.png").rgba, picture("all/cga-bayer8.png").rgba);
  EXPECT_NE(picture("cga.png").rgba, picture("all/cga-none.png").rgba);
}

TEST_F(ModeComparison, ContactSheetFillsCellsOfFourToThree) {
  ASSERT_EQ(run("modes -o all --modes vga,cga,120x120x12 --dithers none,bayer8").code, 0);
  const Picture sheet = picture("all/contact.png"), vga = picture("all/vga-bayer8.png");
  EXPECT_EQ(sheet.width, 16 + 2 * (640 + 16));
  const auto row_of = [&](int x, int y, int width) {
    const auto begin = sheet.rgba.begin() + 4 * (y * sheet.width + x);
    return std::vector<std::uint8_t>(begin, begin + 4 * width);
  };
  for (int y = 0; y < 480; ++y)  // the second cell of the first row, pixel by pixel
    ASSERT_TRUE(
        std::ranges::equal(row_of(16 + 656, 16 + y, 640),
                           std::span(vga.rgba).subspan(static_cast<std::size_t>(4 * 640 * y), 4 * 640)))
        << y;
  const int row_height = (sheet.height - 16) / 3;
  const Picture cga = picture("all/cga-none.png");
  for (int x = 0; x < 640; ++x)  // 320 columns twice
    for (const int y : {0, 479}) {
      const auto from = static_cast<std::size_t>(4 * (320 * (y == 0 ? 0 : 199) + x / 2));
      ASSERT_EQ(row_of(16 + x, 16 + row_height + y, 1),
                std::vector<std::uint8_t>(cga.rgba.begin() + static_cast<std::ptrdiff_t>(from),
                                          cga.rgba.begin() + static_cast<std::ptrdiff_t>(from + 4)));
    }
  // A square picture leaves 80 columns to its left and right.
  const auto background = row_of(0, 0, 1);
  for (const int x : {16, 16 + 79, 16 + 560, 16 + 639})
    EXPECT_EQ(row_of(x, 16 + 2 * row_height + 240, 1), background) << x;
  for (const int x : {16 + 80, 16 + 559}) EXPECT_NE(row_of(x, 16 + 2 * row_height + 240, 1), background) << x;
}

TEST_F(ModeComparison, ReportsErrorsInOneLine) {
  write("broken.json", R"({"tessera": 1, "frame": [{"draw": "nothing"}]})");
  write("file", "");
  write("index.json", R"({"tessera": 1, "framebuffer": {"color": {"mode": "index"}},
    "frame": [{"clear": {"index": 3}}]})");
  const struct {
    const char* arguments;
    int code;
    const char* fragment;
  } kBad[] = {
      {"scene.json", 2, "scene.json: needs -o DIR"},
      {"--modes cga", 2, "--modes: needs -o DIR"},
      {"--dithers none", 2, "--dithers: needs -o DIR"},
      {"-o all --modes cga,vgaa", 2, "did you mean \"vga\"?"},
      {"-o all --modes mda", 2, "has character cells"},
      {"-o all --dithers none,bayer3", 2, "expected one of none, bayer2"},
      {"-o all --dithers baeyr8", 2, "did you mean \"bayer8\"?"},
      {"-o all --diagonal 14 --pitch 0.28", 2, "--diagonal: finds the mode of a screen, excludes -o"},
      {"-o ''", 2, "expected DIR's name"},
      {"-o file --modes cga", 1, "file"},
      {"-o file/all --modes cga", 1, "cannot make the folder \"file/all\""},
      {"-o /proc/all --modes cga", 1, "cannot make the folder \"/proc/all\""},
      {"broken.json -o all", 1, "broken.json: /frame/0/draw"},
      {"missing.json -o all", 1, "missing.json"},
      {"index.json -o all --modes cga", 1,
       "the scene cannot be drawn at 24 bits, to compare with: index.json"},
  };
  for (const auto& row : kBad) {
    const Result result = run("modes " + std::string(row.arguments));
    EXPECT_EQ(result.code, row.code) << row.arguments << "\n" << result.err;
    EXPECT_TRUE(contains(result.err, row.fragment)) << row.arguments << "\n" << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
    EXPECT_FALSE(exists("all/modes.csv")) << row.arguments;
  }
}

}  // namespace
}  // namespace tessera::mode_comparison_program_test
#endif
