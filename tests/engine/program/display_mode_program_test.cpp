// `tessera modes`, and `tessera render` with --mode, --reduce and --dump.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>

#include "tests/engine/program/program.h"

namespace tessera::display_mode_program_test {
namespace {

class DisplayModeProgram : public Program {};

TEST_F(DisplayModeProgram, ListsDisplayModes) {
  const Result list = run("modes");
  EXPECT_EQ(list.code, 0) << list.err;
  for (const char* part : {"hercules    720x348x1      29:45   18.816   50.854      32768",
                           "8514a       1024x768x8       1:1   35.522   43.479i    786432",
                           "vga13h      320x200x8        5:6   31.469   70.086      64000", "mda"})
    EXPECT_TRUE(contains(list.out, part)) << part << "\n" << list.out;
  const Result json = run("modes --json");
  EXPECT_EQ(json.code, 0);
  for (const char* part : {"\"name\": \"amiga\"", "\"memory_bytes\": 51200", "\"interlaced\": true"})
    EXPECT_TRUE(contains(json.out, part)) << part;
}

TEST_F(DisplayModeProgram, FindsTheStandardModeOfAScreen) {
  const Result text = run("modes --diagonal 17 --pitch 0.28");
  EXPECT_EQ(text.out,
            "17-inch screen, 0.28 mm: 13.60 x 10.20 inches, 1233 x 925 dots; standard mode: 1280x1024\n");
  const Result json = run("modes --diagonal 14 --pitch 0.39 --json");
  EXPECT_TRUE(contains(json.out, "\"width\": 800")) << json.out;
  const struct {
    const char* arguments;
    const char* fragment;
  } kBad[] = {{"--diagonal 0 --pitch 0.28", "--diagonal: found \"0\", expected a number above 0"},
              {"--diagonal 17 --pitch 0", "--pitch: found \"0\", expected a number above 0"},
              {"--diagonal 17 --pitch nan", "expected a number above 0"},
              {"--diagonal 17", "--pitch"},
              {"--pitch 0.28", "--diagonal"},
              {"--diagonel 17", "did you mean \"--diagonal\"?"}};
  for (const auto& [arguments, fragment] : kBad) {
    const Result result = run("modes " + std::string(arguments));
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_TRUE(contains(result.err, fragment)) << arguments << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
  }
}

TEST_F(DisplayModeProgram, RefusesWrongDisplayModes) {
  const struct {
    const char* arguments;
    int code;
    const char* fragment;
  } kBad[] = {
      {"--mode cgaa", 2, "did you mean \"cga\"?"},
      {"--mode 640x480x0", 2, "has 0 bits per pixel, must be 1 to 24"},
      {"--mode 640x480x25", 2, "has 25 bits per pixel, must be 1 to 24"},
      {"--mode spectrum", 2, "is not supported: it has two colours per cell"},
      {"--mode ham", 2, "is not supported: a pixel may change one component"},
      {"--mode mda", 2, "character cells"},
      {"--mode cga --size 10x10", 2, "the size is that of display mode \"cga\""},
      {"--mode cga --color-bits 4", 2, "the color bits are those of display mode \"cga\""},
      {"--mode cga --palette gray", 2, "fixed"},
      {"--mode vga13h --palette web216", 2, "the nearest colour is"},
      {"--mode ega --palette vga256", 2, "256 entries"},
      {"--reduce", 2, "--mode"},
      {"--dump x.bin", 2, "--dump writes the memory of a display mode"},
      {"--mode cga --dump a.png", 2, "the picture and --dump are both \"a.png\""},
      {"--mode cga --frames 2 --dump x.bin -o 'y_{frame}.png'", 2, "put {frame} into the name"},
  };
  for (const auto& row : kBad) {
    const Result result = run("render -o a.png " + std::string(row.arguments));
    EXPECT_EQ(result.code, row.code) << row.arguments << "\n" << result.err;
    EXPECT_TRUE(contains(result.err, row.fragment)) << row.arguments << "\n" << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
    EXPECT_FALSE(exists("a.png")) << row.arguments;
  }
}

/// Colours of a binary PPM file as red, green, blue.
std::set<std::string> colors_of(const std::string& ppm, std::size_t pixels) {
  std::set<std::string> colors;
  for (std::size_t at = ppm.size() - 3 * pixels; at < ppm.size(); at += 3) colors.insert(ppm.substr(at, 3));
  return colors;
}

TEST_F(DisplayModeProgram, RendersIntoTheMemoryOfADisplayMode) {
  const std::string cga = "render --mode cga:palette=0,intensity=high,background=1 ";
  ASSERT_EQ(run(cga + "-o cga.ppm --dump cga.bin --planes planes").code, 0);
  const std::string memory = content("cga.bin");
  const std::string ppm = content("cga.ppm");
  ASSERT_EQ(memory.size(), 16384u);
  ASSERT_TRUE(ppm.starts_with("P6\n320 200\n"));
  for (std::size_t gap = 8000; gap < 8192; ++gap) ASSERT_EQ(memory[gap] | memory[gap + 8192], 0);
  const std::string kEntries[4] = {{'\0', '\0', '\xaa'}, "\x55\xff\x55", "\xff\x55\x55", "\xff\xff\x55"};
  for (std::size_t y = 0; y < 200; ++y)
    for (std::size_t x = 0; x < 320; ++x) {
      const auto byte = static_cast<std::uint8_t>(memory[y % 2 * 8192 + y / 2 * 80 + x / 4]);
      ASSERT_EQ(ppm.substr(ppm.size() - 3 * (320 * (200 - y) - x), 3), kEntries[byte >> (6 - x % 4 * 2) & 3])
          << x << " " << y;
    }
  EXPECT_TRUE(exists("planes/color_01.pbm"));
  EXPECT_FALSE(exists("planes/color_02.pbm"));
  for (const char* name : {"a.iff", "a.ILBM", "a.lbm", "a.pcx"})
    ASSERT_EQ(run(cga + "-o again.ppm --dump " + name).code, 0) << name;
  EXPECT_EQ(content("a.iff").substr(8, 8), "ILBMBMHD");
  EXPECT_EQ(content("a.iff"), content("a.ILBM"));
  EXPECT_EQ(content("a.iff"), content("a.lbm"));
  EXPECT_EQ(content("a.pcx").substr(0, 4), std::string("\x0a\x05\x01\x01"));
}

TEST_F(DisplayModeProgram, WritesFramesOfOneBitAsPbm) {
  ASSERT_EQ(run("render --mode 75x40x1 -o a.pbm --dump a.bin").code, 0);
  const std::string pbm = content("a.pbm"), memory = content("a.bin");
  ASSERT_TRUE(pbm.starts_with("P4\n75 40\n"));
  const std::size_t header = pbm.size() - memory.size();
  std::size_t black = 0;
  for (std::size_t y = 0; y < 40; ++y)
    for (std::size_t x = 0; x < 75; ++x) {
      const std::size_t at = 10 * y + x / 8;
      const int pixel = pbm[header + at] >> (7 - x % 8) & 1;  // 1 is black
      ASSERT_NE(pixel, memory[at] >> (7 - x % 8) & 1) << x << " " << y;
      black += pixel == 1 ? 1 : 0;
    }
  EXPECT_GT(black, 0u);
  EXPECT_LT(black, 75u * 40);
  EXPECT_TRUE(contains(run("render --mode cga -o b.pbm").err, "holds 1 bit per pixel"));
}

TEST_F(DisplayModeProgram, ReducesPicturesToADisplayMode) {
  write("blend.json", R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8, "dither": "bayer8"},
    "meshes": {"q": {"builtin": "quad"}},
    "frame": [{"clear": {"color": [1, 0.5, 0, 1]}}, {"draw": "q", "blend": {}, "lighting": false}]})");
  const Result refused = run("render blend.json --mode ega -o a.ppm");
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(contains(refused.err, "blend")) << refused.err;
  const Result reduced =
      run("render blend.json --mode ega --reduce -o a.ppm --dump a.bin --planes planes --stats");
  ASSERT_EQ(reduced.code, 0) << reduced.err;
  EXPECT_EQ(content("a.bin").size(), 112000u);
  EXPECT_TRUE(exists("planes/color_03.pbm"));
  EXPECT_FALSE(exists("planes/color_04.pbm"));
  EXPECT_TRUE(exists("planes/depth_00.pbm"));
  const std::set<std::string> colors = colors_of(content("a.ppm"), 640 * 350);
  EXPECT_GE(colors.size(), 3u);
  EXPECT_LE(colors.size(), 16u);
  for (const std::string& color : colors)
    for (const char component : color) EXPECT_EQ(static_cast<std::uint8_t>(component) % 85, 0);
}

TEST_F(DisplayModeProgram, PixelAspectKeepsRoundThingsRound) {
  write("ball.json", R"({"tessera": 1, "lights": [], "light_model": {"ambient": [1, 1, 1, 1]},
    "materials": {"white": {"ambient": [1, 1, 1, 1]}},
    "meshes": {"ball": {"builtin": "sphere", "detail": 64}},
    "frame": [{"draw": "ball", "material": "white"}]})");
  for (const auto& [mode, width, height, aspect] : {std::tuple{"cga-hi", 640, 200, 5.0 / 12},
                                                    {"sxga", 1280, 1024, 16.0 / 15},
                                                    {"640x480x24:aspect=2:1", 640, 480, 2.0}}) {
    ASSERT_EQ(run("render ball.json --mode " + std::string(mode) + " -o ball.ppm").code, 0);
    const std::string ppm = content("ball.ppm");
    const std::size_t begin = ppm.size() - static_cast<std::size_t>(3 * width * height);
    const auto is_lit = [&](int x, int y) {
      return ppm[begin + static_cast<std::size_t>(3 * (y * width + x))] != 0;
    };
    double columns = 0, rows = 0;
    for (int x = 0; x < width; ++x) columns += is_lit(x, height / 2) ? 1 : 0;
    for (int y = 0; y < height; ++y) rows += is_lit(width / 2, y) ? 1 : 0;
    EXPECT_NEAR(columns * aspect / rows, 1, 2.5 / rows) << mode << " " << columns << " " << rows;
  }
}

}  // namespace
}  // namespace tessera::display_mode_program_test
#endif
