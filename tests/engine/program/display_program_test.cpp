// `tessera display`, and `tessera render` with --display.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/tessera/display_mode.hpp"
#include "framebuffer/tessera/screen.hpp"
#include "tests/engine/program/program.h"

namespace tessera::display_program_test {
namespace {

class DisplayProgram : public Program {
 protected:
  /// A PPM file of one colour.
  void write_field(const std::string& name, int width, int height, const std::string& rgb) const {
    std::string file = "P6 " + std::to_string(width) + " " + std::to_string(height) + " 255\n";
    for (int i = 0; i < width * height; ++i) file += rgb;
    write(name, file);
  }
  /// A PPM file whose pixels all differ.
  void write_ramp(const std::string& name, int width, int height) const {
    std::string file = "P6 " + std::to_string(width) + " " + std::to_string(height) + " 255\n";
    for (int i = 0; i < width * height; ++i)
      file += {static_cast<char>(i * 37), static_cast<char>(i * 11), static_cast<char>(i / width * 5)};
    write(name, file);
  }
  void expect_one_error(const std::string& arguments, int code, const std::string& fragment) const {
    const Result result = run(arguments);
    EXPECT_EQ(result.code, code) << arguments << "\n" << result.err;
    EXPECT_TRUE(contains(result.err, fragment)) << arguments << "\n" << result.err;
    EXPECT_TRUE(result.err.starts_with("tessera: error: ")) << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_FALSE(exists("out.png")) << arguments;
  }
};

/// Pixels of a binary PPM file without comments.
std::string pixels_of(const std::string& ppm, std::size_t count) {
  return ppm.size() < 3 * count ? "" : ppm.substr(ppm.size() - 3 * count);
}

/// The image of a screen as the library draws it.
std::string image_of(Screen& screen, const std::string& rgb, double time_ms) {
  std::string image(3 * static_cast<std::size_t>(screen.width()) * static_cast<std::size_t>(screen.height()),
                    '\0');
  screen.show({.rgb = {reinterpret_cast<const std::uint8_t*>(rgb.data()), rgb.size()}}, time_ms,
              {.rgb = reinterpret_cast<std::uint8_t*>(image.data())});
  return image;
}

/// Rows of a PFM file from the top.
std::vector<float> pfm_rows(const std::string& file, std::size_t columns, std::size_t rows) {
  std::vector<float> values(columns * rows);
  const std::size_t bytes = 4 * columns;
  if (file.size() < rows * bytes) return {};
  for (std::size_t y = 0; y < rows; ++y)
    std::memcpy(&values[y * columns], file.data() + file.size() - (y + 1) * bytes, bytes);
  return values;
}

TEST_F(DisplayProgram, ListsKindsParametersAndPresets) {
  const Result list = run("display --list");
  EXPECT_EQ(list.code, 0) << list.err;
  EXPECT_EQ(list.err, "");
  const auto json = nlohmann::json::parse(run("display --list --json").out);
  ASSERT_EQ(json["kinds"].size(), display_kinds().size());
  for (const auto& kind : json["kinds"]) {
    EXPECT_TRUE(contains(list.out, kind["name"].get<std::string>() + ": ")) << kind["name"];
    EXPECT_GE(kind["parameters"].size(), 6u);
    for (const auto& parameter : kind["parameters"]) {
      for (const char* key : {"values", "default", "description", "source"})
        EXPECT_FALSE(parameter[key].get<std::string>().empty()) << parameter;
      EXPECT_TRUE(contains(list.out, "\n  " + parameter["name"].get<std::string>() + "  ")) << parameter;
      EXPECT_TRUE(contains(list.out, parameter["description"].get<std::string>() + " (")) << parameter;
    }
  }
  ASSERT_EQ(json["presets"].size(), display_presets().size());
  for (const auto& preset : json["presets"])
    EXPECT_TRUE(contains(list.out, "\n  " + preset["name"].get<std::string>() + "  ")) << preset;
}

TEST_F(DisplayProgram, PresetsShowTheirTypicalModes) {
  for (const DisplayPreset& preset : display_presets()) {
    const DisplayMode mode = display_mode(std::string(preset.mode));
    write_field("in.ppm", mode.width, mode.height, "\xff\xff\xff");
    const std::string name(preset.name);
    const Result result = run("display in.ppm --mode " + mode.name + " --display " + name +
                              " --part 10,10,8,6 --scale 5 -o out.ppm");
    EXPECT_EQ(result.code, 0) << name << "\n" << result.err;
    EXPECT_TRUE(content("out.ppm").starts_with("P6\n40 30\n255\n")) << name;
  }
}

TEST_F(DisplayProgram, WritesTheImageOfTheLibrary) {
  write_ramp("in.ppm", 320, 200);
  const Result result =
      run("display in.ppm --mode cga --display cga:white=9300 --part 20,30,40,30 --scale 4 -o out.ppm");
  ASSERT_EQ(result.code, 0) << result.err;
  const DisplayMode mode = display_mode("cga");
  const VideoMode video{
      .width = 320, .height = 200, .pixel_aspect = mode.pixel_aspect.value(), .timing = mode.timing};
  Screen screen(find_display("cga:white=9300"), video,
                {.scale_px_per_mm = 4, .x_mm = 20, .y_mm = 30, .width_mm = 40, .height_mm = 30});
  const std::string expected = image_of(screen, pixels_of(content("in.ppm"), 320 * 200), 0);
  EXPECT_TRUE(content("out.ppm").starts_with("P6\n160 120\n255\n"));
  EXPECT_EQ(pixels_of(content("out.ppm"), 160 * 120), expected);
  for (const std::string& note : screen.notes())
    EXPECT_TRUE(contains(result.err, "tessera: note: " + note + "\n")) << result.err;
}

TEST_F(DisplayProgram, WithoutAModePixelsAreSquare) {
  write_ramp("in.ppm", 40, 30);
  ASSERT_EQ(run("display in.ppm --display lcd --scale 0.5 -o a.ppm").code, 0);
  ASSERT_EQ(run("display in.ppm --mode 40x30x24 --display lcd --scale 0.5 -o b.ppm").code, 0);
  EXPECT_EQ(content("a.ppm"), content("b.ppm"));
  EXPECT_TRUE(content("a.ppm").starts_with("P6\n152 114\n")) << "15 inches are 304.8 x 228.6 mm";
}

TEST_F(DisplayProgram, ImagesAreTheSameForAnyNumberOfThreads) {
  write_ramp("in.ppm", 40, 30);
  const std::string display = "display in.ppm --display crt:pitch=2,halation=0.1 --scale 1 ";
  ASSERT_EQ(run(display + "--threads 1 -o a.ppm").code, 0);
  ASSERT_EQ(run(display + "--threads 3 -o b.ppm").code, 0);
  EXPECT_EQ(content("a.ppm"), content("b.ppm"));
}

TEST_F(DisplayProgram, ScreensKeepTheirStateBetweenFrames) {
  write_field("white.ppm", 40, 30, "\xff\xff\xff");
  write_field("black.ppm", 40, 30, std::string(3, '\0'));
  const std::string screen = "--display mono12 --scale 0.5 ";
  ASSERT_EQ(run("display white.ppm black.ppm black.ppm " + screen + "-o 'f_{frame}.ppm'").code, 0);
  ASSERT_EQ(run("display black.ppm " + screen + "-o dark.ppm").code, 0);
  const auto sum = [&](const char* name) {
    long total = 0;
    for (const char c : content(name)) total += static_cast<std::uint8_t>(c);
    return total;
  };
  EXPECT_GT(sum("f_0000.ppm"), sum("f_0001.ppm"));
  EXPECT_GT(sum("f_0001.ppm"), sum("f_0002.ppm"));
  EXPECT_GT(sum("f_0002.ppm"), sum("dark.ppm"));
  EXPECT_FALSE(exists("f_0003.ppm"));
}

TEST_F(DisplayProgram, TimesOfFramesFollowFromTheOptions) {
  write_ramp("a.ppm", 40, 30);
  write_field("b.ppm", 40, 30, "\x20\x40\x80");
  const std::string first = pixels_of(content("a.ppm"), 1200), second = pixels_of(content("b.ppm"), 1200);
  const ScreenView view{.scale_px_per_mm = 0.5};
  const VideoMode mode{.width = 40, .height = 30};
  for (const double frame_ms : {0.0, 25.0}) {
    Screen screen(find_display("lcd:response=30"), mode, view);
    const double step = frame_ms > 0 ? frame_ms : screen.frame_ms();
    const std::string images[3] = {image_of(screen, first, 7), image_of(screen, second, 7 + step),
                                   image_of(screen, first, 7 + 2 * step)};
    const std::string option = frame_ms > 0 ? " --frame-ms 25" : "";
    ASSERT_EQ(run("display a.ppm b.ppm a.ppm --display lcd:response=30 --scale 0.5 --time 7" + option +
                  " -o '{frame}.ppm'")
                  .code,
              0);
    EXPECT_EQ(pixels_of(content("0000.ppm"), images[0].size() / 3), images[0]) << frame_ms;
    EXPECT_EQ(pixels_of(content("0001.ppm"), images[1].size() / 3), images[1]) << frame_ms;
    EXPECT_EQ(pixels_of(content("0002.ppm"), images[2].size() / 3), images[2]) << frame_ms;
  }
}

TEST_F(DisplayProgram, WritesLightAsPfm) {
  write_ramp("in.ppm", 40, 30);
  ASSERT_EQ(run("display in.ppm --display lcd --scale 0.1 -o out.pfm").code, 0);
  const std::string rgb = pixels_of(content("in.ppm"), 1200), pfm = content("out.pfm");
  Screen screen(find_display("lcd"), {.width = 40, .height = 30}, {.scale_px_per_mm = 0.1});
  const std::size_t row = 3 * static_cast<std::size_t>(screen.width());
  const auto height = static_cast<std::size_t>(screen.height());
  std::vector<float> light(row * height);
  screen.show({.rgb = {reinterpret_cast<const std::uint8_t*>(rgb.data()), rgb.size()}}, 0,
              {.light = light.data()});
  ASSERT_TRUE(pfm.starts_with("PF\n30 23\n-1.0\n"));
  EXPECT_EQ(pfm_rows(pfm, row, height), light);
}

TEST_F(DisplayProgram, GainBrightensTheImage) {
  write_ramp("in.ppm", 40, 30);
  const Result result = run("display in.ppm --display lcd --scale 0.5 --gain 2.5 -o out.ppm");
  ASSERT_EQ(result.code, 0) << result.err;
  const VideoMode mode{.width = 40, .height = 30};
  Screen screen(find_display("lcd"), mode, {.scale_px_per_mm = 0.5, .gain = 2.5});
  const std::string image = image_of(screen, pixels_of(content("in.ppm"), 1200), 0);
  EXPECT_EQ(pixels_of(content("out.ppm"), image.size() / 3), image);
  Screen plain(find_display("lcd"), mode, {.scale_px_per_mm = 0.5});
  EXPECT_NE(image_of(plain, pixels_of(content("in.ppm"), 1200), 0), image);
}

TEST_F(DisplayProgram, WritesTheSignalOfEachFrame) {
  write_ramp("a.ppm", 320, 200);
  write_field("b.ppm", 320, 200, "\xc0\x20\x20");
  const DisplayMode mode = display_mode("cga");
  const VideoMode video{
      .width = 320, .height = 200, .pixel_aspect = mode.pixel_aspect.value(), .timing = mode.timing};
  for (const std::string name : {"ntsc", "pal:cable=svideo"}) {
    const Result result = run("display a.ppm b.ppm --mode cga --display " + name +
                              " --scale 0.2 --time 3 -o '{frame}.ppm' --signal 's_{frame}.pfm'");
    ASSERT_EQ(result.code, 0) << result.err;
    for (int frame = 0; frame < 2; ++frame) {
      const std::string rgb = pixels_of(content(frame == 0 ? "a.ppm" : "b.ppm"), 320 * 200);
      const double frame_ms = 1000 / mode.timing->frame_rate_hz();
      const VideoSignal signal = video_signal(
          find_display(name), video, {.rgb = {reinterpret_cast<const std::uint8_t*>(rgb.data()), rgb.size()}},
          3 + frame * frame_ms);
      std::vector<float> expected = signal.samples;
      expected.insert(expected.end(), signal.chroma.begin(), signal.chroma.end());
      const auto columns = static_cast<std::size_t>(signal.samples_per_line);
      const std::string file = content(frame == 0 ? "s_0000.pfm" : "s_0001.pfm");
      EXPECT_EQ(pfm_rows(file, columns, expected.size() / columns), expected) << name << frame;
      EXPECT_TRUE(file.starts_with("Pf\n" + std::to_string(columns) + " " +
                                   std::to_string(expected.size() / columns) + "\n"));
      EXPECT_TRUE(contains(result.err, "note: the signal has " + std::to_string(signal.lines) + " lines of " +
                                           std::to_string(columns) + " samples in " +
                                           std::string(signal.unit)))
          << result.err;
    }
    EXPECT_EQ(result.err.find("the signal"), result.err.rfind("the signal")) << "one note";
  }
}

TEST_F(DisplayProgram, RenderShowsItsPicturesOnTheDisplay) {
  const std::string options = "--mode vga13h --frames 2 ";
  const std::string display = "--display mono12:phosphor=p1 --scale 1 --part 5,5,60,40 ";
  ASSERT_EQ(run("render --mode vga13h -o plain.ppm").code, 0);
  ASSERT_EQ(run("display plain.ppm plain.ppm --mode vga13h " + display + "-o 'two_{frame}.ppm'").code, 0);
  const Result one = run("render " + options + display +
                         "-o 'one_{frame}.ppm' --dump '{frame}.bin' --planes 'planes_{frame}'");
  ASSERT_EQ(one.code, 0) << one.err;
  EXPECT_EQ(content("one_0000.ppm"), content("two_0000.ppm"));
  EXPECT_EQ(content("one_0001.ppm"), content("two_0001.ppm"));
  EXPECT_TRUE(content("one_0000.ppm").starts_with("P6\n60 40\n"));
  EXPECT_EQ(content("0001.bin").size(), 64000u) << "the memory of the mode, not of the image";
  EXPECT_TRUE(content("planes_0001/color_07.pbm").starts_with("P4\n320 200\n"));
}

TEST_F(DisplayProgram, RenderWritesAndComparesRgbImages) {
  const std::string render = "render --size 40x30 --palette bw --display eink --scale 0.5 ";
  ASSERT_EQ(run(render + "-o a.png").code, 0);
  ASSERT_EQ(run(render + "-o a.ppm --compare a.png").code, 0);
  EXPECT_EQ(content("a.png")[25], 2) << "the PNG holds RGB, not indices";
  ASSERT_EQ(run(render + "-o b.ppm --compare a.ppm").code, 0);
  EXPECT_EQ(run("render --size 40x30 --palette bw --compare a.ppm -o c.ppm").code, 1) << "another size";
}

TEST_F(DisplayProgram, RefusesWrongArguments) {
  write_ramp("in.ppm", 40, 30);
  write_ramp("other.ppm", 41, 30);
  const struct {
    const char* arguments;
    int code;
    const char* fragment;
  } kBad[] = {
      {"", 2, "PICTURE: found none, expected a picture"},
      {"in.ppm -o out.png", 2, "--display: found none, expected a kind or a preset"},
      {"in.ppm --display crt", 2, "-o: found none, expected a file"},
      {"in.ppm --display crt -o ''", 2, "found \"\", expected FILE's name"},
      {"in.ppm --display vga15 -o out.png", 2, "did you mean \"vga14\"?"},
      {"in.ppm --display '' -o out.png", 2, "found display \"\", expected one of crt, lcd"},
      {"in.ppm --display crt:pich=0.3 -o out.png", 2, "did you mean \"pitch\"?"},
      {"in.ppm --display vga14:beam=0.3,maks=none -o out.png", 2, "did you mean \"mask\"?"},
      {"in.ppm --display crt:mask=dot -o out.png", 2,
       "mask: found \"dot\", expected none, dots, slots, grille"},
      {"in.ppm --display crt:pitch=9 -o out.png", 2, "pitch: found \"9\", expected 0.05 to 5 (mm)"},
      {"in.ppm --display crt:phosphor=p39 -o out.png", 2, "expected p22 or mask=none"},
      {"in.ppm --display ntsc:decoder=simple -o out.png", 2, "expected auto, notch, comb"},
      {"in.ppm --display crt --part 1,2,3 -o out.png", 2, "--part: found \"1,2,3\", expected X,Y,W,H"},
      {"in.ppm --display crt --part 1,2,3,0 -o out.png", 2, "--part: found \"1,2,3,0\""},
      {"in.ppm --display crt --part -1,2,3,4 -o out.png", 2, "--part: found \"-1,2,3,4\""},
      {"in.ppm --display crt --part 1,2,3000,4 -o out.png", 2, "width"},
      {"in.ppm --display crt --scale 0 -o out.png", 2, "--scale: found \"0\", expected a number above 0"},
      {"in.ppm --display crt --scale 1000 -o out.png", 2, "pixels per mm"},
      {"in.ppm --display crt --time -1 -o out.png", 2, "--time: found \"-1\", expected a number from 0"},
      {"in.ppm --display crt --frame-ms 0 -o out.png", 2, "--frame-ms: found \"0\""},
      {"in.ppm --display crt --threads 0 -o out.png", 2, "--threads: found \"0\""},
      {"in.ppm --display crt --mode cgaa -o out.png", 2, "did you mean \"cga\"?"},
      {"in.ppm --display crt --mode mda -o out.png", 2, "character cells"},
      {"in.ppm --display crt --mode cga -o out.png", 1,
       "\"in.ppm\" is 40x30, expected 320x200, the size of display mode \"cga\""},
      {"in.ppm other.ppm --display crt -o out.png", 2, "would overwrite \"out.png\" with every frame"},
      {"in.ppm --display crt -o in.ppm", 1, "would overwrite the input \"in.ppm\""},
      {"none.ppm --display crt -o out.png", 1, "cannot read \"none.ppm\""},
      {"in.ppm --display crt -o out.qqq", 1, "cannot write \"out.qqq\""},
      {"in.ppm --display crt -o none/out.png", 1, "none"},
      {"in.ppm --display crt --signal s.pfm -o out.png", 2, "--signal: the display has no signal"},
      {"in.ppm --display ntsc --signal s.png -o out.png", 2, "expected a name that ends in .pfm"},
      {"in.ppm --display ntsc --signal x.pfm -o x.pfm", 2, "the image and --signal are both \"x.pfm\""},
      {"in.ppm in.ppm --display ntsc --signal s.pfm -o 'x_{frame}.png'", 2, "would overwrite \"s.pfm\""},
      {"in.ppm --display crt --gain 0 -o out.png", 2, "--gain: found \"0\", expected a number from 0.01"},
      {"in.ppm --display crt --json -o out.png", 2, "--json: needs --list"},
      {"in.ppm --display crt --scael 2 -o out.png", 2, "did you mean \"--scale\"?"},
  };
  for (const auto& [arguments, code, fragment] : kBad)
    expect_one_error("display " + std::string(arguments), code, fragment);
  const Result second = run("display in.ppm other.ppm --display lcd --scale 0.1 -o 'x_{frame}.ppm'");
  EXPECT_EQ(second.code, 1);
  EXPECT_TRUE(contains(second.err,
                       "\"other.ppm\" is 41x30, expected 40x30, the size of the first picture \"in.ppm\""))
      << second.err;
  EXPECT_TRUE(exists("x_0000.ppm")) << "finished before the error";
}

TEST_F(DisplayProgram, RenderRefusesWrongDisplays) {
  const struct {
    const char* arguments;
    int code;
    const char* fragment;
  } kBad[] = {
      {"--scale 2", 2, "--scale: needs --display"},
      {"--part 1,2,3,4", 2, "--part: needs --display"},
      {"--gain 2", 2, "--gain: needs --display"},
      {"--frame-ms 20", 2, "--frame-ms: needs --display"},
      {"--display vga41", 2, "did you mean \"vga14\"?"},
      {"--display crt --part 300,0,1,1", 2, "width"},
      {"--display crt --part 0,0,1", 2, "--part: found \"0,0,1\""},
  };
  for (const auto& [arguments, code, fragment] : kBad)
    expect_one_error("render --size 8x8 -o out.png " + std::string(arguments), code, fragment);
}

}  // namespace
}  // namespace tessera::display_program_test
#endif
