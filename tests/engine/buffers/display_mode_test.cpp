// Display modes: rates and aspects against the data sheets, parameters, palettes, errors.
#include "engine/tessera/display_mode.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace tessera::display_mode_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(DisplayModes, HaveTheRatesAndAspectsOfTheirHardware) {
  const struct {
    const char* name;
    int width, height, bits;
    double line_khz, frame_hz;
    AspectRatio aspect;
  } kSheet[] = {
      {"hercules", 720, 348, 1, 18.816, 50.854, {29, 45}},
      {"cga", 320, 200, 2, 15.6998, 59.923, {5, 6}},
      {"cga-hi", 640, 200, 1, 15.6998, 59.923, {5, 12}},
      {"ega-lo", 320, 200, 4, 15.6998, 59.923, {5, 6}},
      {"ega", 640, 350, 4, 21.851, 59.702, {35, 48}},
      {"vga", 640, 480, 4, 31.469, 59.940, {1, 1}},
      {"mono", 640, 480, 1, 31.469, 59.940, {1, 1}},
      {"vga13h", 320, 200, 8, 31.469, 70.086, {5, 6}},
      {"vga-x", 320, 240, 8, 31.469, 59.940, {1, 1}},
      {"svga56", 800, 600, 8, 35.156, 56.250, {1, 1}},
      {"svga", 800, 600, 8, 37.879, 60.317, {1, 1}},
      {"8514a", 1024, 768, 8, 35.522, 43.479, {1, 1}},
      {"xga", 1024, 768, 8, 48.363, 60.004, {1, 1}},
      {"sxga", 1280, 1024, 24, 63.981, 60.020, {16, 15}},
      {"uxga", 1600, 1200, 24, 75.000, 60.000, {1, 1}},
      {"vesa1920", 1920, 1440, 24, 90.000, 60.000, {1, 1}},
      {"amiga", 320, 256, 5, 15.625, 49.920, {16, 15}},
      {"amiga-ntsc", 320, 200, 5, 15.734, 60.054, {5, 6}},
      {"mda", 720, 350, 1, 18.432, 49.816, {35, 54}},
  };
  for (const auto& row : kSheet) {
    const DisplayMode mode = display_mode(row.name);
    EXPECT_EQ(mode.width, row.width) << row.name;
    EXPECT_EQ(mode.height, row.height) << row.name;
    EXPECT_EQ(mode.color_bits, row.bits) << row.name;
    ASSERT_TRUE(mode.timing) << row.name;
    EXPECT_NEAR(mode.timing->line_rate_hz() / 1000, row.line_khz, 1e-4 * row.line_khz) << row.name;
    EXPECT_NEAR(mode.timing->frame_rate_hz(), row.frame_hz, 1e-4 * row.frame_hz) << row.name;
    EXPECT_EQ(mode.pixel_aspect.numerator, row.aspect.numerator) << row.name;
    EXPECT_EQ(mode.pixel_aspect.denominator, row.aspect.denominator) << row.name;
    EXPECT_NEAR(mode.screen_aspect(), 4.0 / 3, 1e-12) << row.name;
  }
  EXPECT_NEAR(display_mode("8514a").timing->field_rate_hz(), 86.958, 0.0087);
  EXPECT_EQ(display_mode("vga13h").timing->lines_per_row, 2);
}

TEST(DisplayModes, HaveDistinctNamesThatFindThem) {
  std::set<std::string> names;
  for (const DisplayMode& mode : display_modes()) {
    EXPECT_TRUE(names.insert(mode.name).second) << mode.name;
    EXPECT_EQ(display_mode(mode.name).description, mode.description);
    if (mode.layout == MemoryLayout::character_cells) continue;
    const FrameBufferFormat format = frame_buffer_format(mode);
    EXPECT_EQ(format.width, mode.width) << mode.name;
    EXPECT_NO_THROW(FrameBuffer{format}) << mode.name;
  }
  EXPECT_GE(names.size(), 28u);
}

/// Palette entries in levels of 255.
std::vector<std::array<int, 3>> levels(const DisplayMode& mode) {
  std::vector<std::array<int, 3>> list;
  for (const Color& c : mode.palette)
    list.push_back({static_cast<int>(std::lround(c.r * 255)), static_cast<int>(std::lround(c.g * 255)),
                    static_cast<int>(std::lround(c.b * 255))});
  return list;
}

TEST(DisplayModes, PalettesHoldOnlyColorsOfTheHardware) {
  for (const DisplayMode& mode : display_modes()) {
    if (mode.color_mode == ColorMode::rgb) continue;
    EXPECT_EQ(mode.palette.size(), std::size_t{1} << mode.color_bits) << mode.name;
    for (const auto& color : levels(mode))
      for (const int level : color) {
        const bool is_grey = color[0] == color[1] && color[1] == color[2] && level % 17 == 0;
        if (mode.name.starts_with("amiga")) EXPECT_EQ(level % 17, 0) << mode.name;
        else if (mode.name == "gray4") EXPECT_TRUE(is_grey) << level;
        else if (mode.color_bits <= 4 && !mode.name.starts_with("vga")) EXPECT_EQ(level % 85, 0) << mode.name;
        else EXPECT_EQ(std::lround(std::lround(level * 63 / 255.0) * 255 / 63.0), level) << mode.name;
      }
  }
  std::vector<std::array<int, 3>> amiga = levels(display_mode("amiga"));
  std::sort(amiga.begin(), amiga.end());
  EXPECT_EQ(std::unique(amiga.begin(), amiga.end()), amiga.end()) << "32 different colours";
}

TEST(DisplayModes, CgaHasItsPalettesIntensitiesAndBackgrounds) {
  using Entries = std::vector<std::array<int, 3>>;
  const auto entries = [](const std::string& parameters) { return levels(display_mode("cga" + parameters)); };
  EXPECT_EQ(entries(""), (Entries{{0, 0, 0}, {85, 255, 255}, {255, 85, 255}, {255, 255, 255}}));
  EXPECT_EQ(entries(":palette=1,intensity=low"),
            (Entries{{0, 0, 0}, {0, 170, 170}, {170, 0, 170}, {170, 170, 170}}));
  EXPECT_EQ(entries(":palette=0,intensity=low"),
            (Entries{{0, 0, 0}, {0, 170, 0}, {170, 0, 0}, {170, 85, 0}}));
  EXPECT_EQ(entries(":intensity=high,palette=0,background=1"),
            (Entries{{0, 0, 170}, {85, 255, 85}, {255, 85, 85}, {255, 255, 85}}));
  EXPECT_EQ(entries(":palette=mode5,background=15"),
            (Entries{{255, 255, 255}, {85, 255, 255}, {255, 85, 85}, {255, 255, 255}}));
  EXPECT_EQ(entries(":palette=mode5,intensity=low,background=6"),
            (Entries{{170, 85, 0}, {0, 170, 170}, {170, 0, 0}, {170, 170, 170}}));
}

TEST(DisplayModes, SizesAndBitsNameModes) {
  for (int bits = 1; bits <= 24; ++bits) {
    const DisplayMode mode = display_mode("100x50x" + std::to_string(bits));
    EXPECT_EQ(mode.width, 100);
    EXPECT_EQ(mode.height, 50);
    EXPECT_EQ(mode.color_bits, bits);
    EXPECT_EQ(mode.color_mode, bits == 4 || bits == 8 ? ColorMode::index : ColorMode::rgb) << bits;
    EXPECT_EQ(mode.pixel_aspect.value(), 1);
    EXPECT_FALSE(mode.timing);
  }
  EXPECT_EQ(display_mode("8x8x8:color=rgb").color_mode, ColorMode::rgb);
  EXPECT_EQ(display_mode("8x8x12:color=index").palette.size(), 256u);
  EXPECT_EQ(display_mode("8x8x3:color=gray").palette[7].g, 1);
  EXPECT_EQ(display_mode("8x8x3:color=gray").palette_component_bits, 0);
  EXPECT_EQ(display_mode("8x8x15:bytes=big").byte_order, ByteOrder::big);
  EXPECT_EQ(display_mode("svga16:bytes=big").byte_order, ByteOrder::big);
  const DisplayMode wide = display_mode("320x200x4:aspect=10:12");
  EXPECT_EQ(wide.pixel_aspect.numerator, 5);
  EXPECT_EQ(wide.pixel_aspect.denominator, 6);
}

/// Message of the Error that run() throws; empty if it does not.
template <class Run>
std::string message_of(const Run& run) {
  try {
    run();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(DisplayModes, RefuseWrongNamesAndParameters) {
  const struct {
    const char* name;
    const char* fragment;
  } kBad[] = {
      {"", "mode \"\" is unknown"},
      {"vgaa", "mode \"vgaa\" is unknown, expected one of mda, hercules"},
      {"640x480", "is unknown"},
      {"640x480x0", "\"640x480x0\" has 0 bits per pixel, must be 1 to 24"},
      {"640x480x25", "has 25 bits per pixel, must be 1 to 24"},
      {"640x480x-1", "is unknown"},
      {"0x480x8", "each side must be 1 to 16384"},
      {"640x16385x8", "each side must be 1 to 16384"},
      {"99999999999x1x1", "is unknown"},
      {"cga:", ""},
      {"cga:palette", "expected key=value"},
      {"cga:palette=1,", "expected key=value"},
      {"cga:palette=2", "palette is \"2\", expected one of 0, 1, mode5"},
      {"cga:palette=1,palette=1", "given twice"},
      {"cga:background=16", "background is \"16\", expected 0 to 15"},
      {"cga:intensity=bright", "expected one of low, high"},
      {"cga:colour=1", "no parameter \"colour\", expected palette, intensity, background"},
      {"vga:palette=1", "it takes none"},
      {"8x8x9:color=gray", "gray takes 1 to 8 bits, found 9"},
      {"8x8x8:aspect=5", "expected WIDTH:HEIGHT"},
      {"8x8x8:aspect=0:1", "expected WIDTH:HEIGHT"},
      {"8x8x8:bytes=big", "no parameter \"bytes\""},
  };
  for (const auto& [name, fragment] : kBad)
    EXPECT_THAT(message_of([&] { display_mode(name); }), HasSubstr(fragment)) << name;
  for (const char* const name : {"spectrum", "c64", "msx", "ham", "ham6", "ham8"}) {
    try {
      display_mode(name);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::unsupported) << name;
      EXPECT_THAT(error.what(), HasSubstr("is not supported: ")) << name;
    }
  }
  EXPECT_THAT(message_of([] { frame_buffer_format(display_mode("mda")); }), HasSubstr("character cells"));
}

TEST(DisplayModes, CheckPalettes) {
  const auto checked = [](const char* name, std::vector<Color> palette) {
    return message_of([&] { check_palette(display_mode(name), palette); });
  };
  const Color pink{170 / 255.0f, 85 / 255.0f, 1};
  EXPECT_THAT(checked("ega", {pink}), IsEmpty());
  EXPECT_THAT(
      checked("ega", {{0, 0, 0}, {100 / 255.0f, 0, 0}}),
      HasSubstr("palette entry 1 is (100, 0, 0), which mode \"ega\" cannot show: its components have 2 "
                "bits; the nearest colour is (85, 0, 0)"));
  EXPECT_THAT(checked("ega", std::vector<Color>(16, pink)), IsEmpty());
  EXPECT_THAT(checked("ega", std::vector<Color>(17, pink)),
              HasSubstr("17 entries, mode \"ega\" takes 1 to 16"));
  EXPECT_THAT(checked("ega", {}), HasSubstr("0 entries"));
  EXPECT_THAT(checked("ega", {{1.5f, 0, 0}}), HasSubstr("must be 0 to 1"));
  EXPECT_THAT(checked("ega", {{std::nanf(""), 0, 0}}), HasSubstr("must be 0 to 1"));
  EXPECT_THAT(checked("amiga", {{0.2f, 0.4f, 0.6f}}), IsEmpty());
  EXPECT_THAT(checked("amiga", {pink}), IsEmpty());
  EXPECT_THAT(checked("amiga", {{1 / 255.0f, 0, 0}}),
              HasSubstr("have 4 bits; the nearest colour is (0, 0, 0)"));
  EXPECT_THAT(checked("vga13h", {{4 / 255.0f, 8 / 255.0f, 12 / 255.0f}}), IsEmpty());
  EXPECT_THAT(checked("vga13h", {{51 / 255.0f, 0, 0}}),
              HasSubstr("have 6 bits; the nearest colour is (49, 0, 0)"));
  EXPECT_THAT(checked("64x64x8", {{1 / 255.0f, 0, 0}}), IsEmpty());
  EXPECT_THAT(checked("cga", display_mode("cga").palette), IsEmpty());
  EXPECT_THAT(checked("cga", display_mode("cga:background=1").palette), HasSubstr("fixed"));
  EXPECT_THAT(checked("ega-lo", {pink}), HasSubstr("fixed"));
  EXPECT_THAT(checked("vga24", {pink}), HasSubstr("has no palette"));
}

TEST(DisplayModes, RefuseValuesThatDoNotFitTogether) {
  const auto message = [](void change(DisplayMode&), const char* name = "vga13h") {
    DisplayMode mode = display_mode(name);
    change(mode);
    return message_of([&] { memory_bytes(mode); });
  };
  EXPECT_THAT(message([](DisplayMode& m) { m.width = 0; }), HasSubstr("width is 0, must be 1 to 16384"));
  EXPECT_THAT(message([](DisplayMode& m) { m.color_bits = 25; }), HasSubstr("is 25, must be 1 to 24"));
  EXPECT_THAT(message([](DisplayMode& m) { m.color_bits = 5; }), HasSubstr("packed pixels take"));
  EXPECT_THAT(message([](DisplayMode& m) { m.palette.clear(); }), HasSubstr("0 entries"));
  EXPECT_THAT(message([](DisplayMode& m) { m.color_mode = ColorMode::rgb; }), HasSubstr("belong to index"));
  EXPECT_THAT(message([](DisplayMode& m) { m.layout = MemoryLayout{9}; }), HasSubstr("9"));
  EXPECT_THAT(message([](DisplayMode& m) { m.width = 318; }, "vga-x"), HasSubstr("multiple of 4"));
  EXPECT_THAT(message([](DisplayMode& m) { m.height = 206; }, "cga"), HasSubstr("two banks"));
  EXPECT_THAT(message([](DisplayMode& m) { m.height = 204; }, "cga"), IsEmpty());
  EXPECT_THAT(message([](DisplayMode& m) { m.height = 365; }, "hercules"), HasSubstr("four banks"));
}

}  // namespace
}  // namespace tessera::display_mode_test
