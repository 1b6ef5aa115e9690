// `tessera render` with palettes that are chosen: adaptive and ramps, for pictures and animations.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "framebuffer/oklab.h"
#include "tests/engine/program/program.h"

namespace tessera::palette_program_test {
namespace {

/// Two balls in coloured light; the lights' colours change over the animation.
constexpr const char* kBalls = R"({"tessera": 1, "framebuffer": {%s},
  "lights": [{"position": [1, 1, 1, 0], "diffuse": [{"keys": [[0, 1], [1, 0.3]]}, 0.6, 0.3, 1]}],
  "materials": {"gold": {"preset": "gold"}, "jade": {"preset": "jade"}},
  "meshes": {"ball": {"builtin": "sphere", "detail": 24}},
  "frame": [{"clear": {"color": [0.1, 0.1, 0.3, 1], "depth": 1}},
            {"draw": "ball", "material": "gold", "transform": [{"translate": [-1, 0, 0]}]},
            {"draw": "ball", "material": "jade", "transform": [{"translate": [1, 0, 0]}]}]})";

constexpr const char* kSize = R"("width": 96, "height": 64)";

class PaletteProgram : public Program {
 protected:
  /// Writes the scene with these keys of its frame buffer.
  void write_balls(const std::string& name, const std::string& keys) const {
    std::string text = kBalls;
    text.replace(text.find("%s"), 2, keys);
    write(name, text);
  }
  std::set<std::string> colors_of(const std::string& name, std::size_t pixels) const {
    const std::string ppm = content(name);
    std::set<std::string> colors;
    for (std::size_t i = ppm.size() - 3 * pixels; i < ppm.size(); i += 3) colors.insert(ppm.substr(i, 3));
    return colors;
  }
};

std::vector<detail::Rgb8> png_palette(const std::string& png) {
  const std::size_t at = png.find("PLTE");
  if (at == std::string::npos) return {};
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(png[i]); };
  std::vector<detail::Rgb8> entries;
  const std::size_t bytes = std::size_t{byte(at - 2)} << 8 | byte(at - 1);
  for (std::size_t i = at + 4; i < at + 4 + bytes; i += 3)
    entries.push_back({byte(i), byte(i + 1), byte(i + 2)});
  return entries;
}

TEST_F(PaletteProgram, ChoosesPalettesInScenesAndOptions) {
  for (const char* const palette : {"adaptive", "ramps"}) {
    write_balls(
        "a.json",
        std::string(R"("width": 96, "height": 64, "color": {"mode": "index", "bits": 4}, "palette": ")") +
            palette + "\"");
    write_balls("b.json", kSize);
    const Result in_scene = run("render a.json -o a.png");
    ASSERT_EQ(in_scene.code, 0) << in_scene.err;
    const std::string option = std::string("render b.json --palette ") + palette;
    ASSERT_EQ(run(option + " --color-bits 4 -o b.png").code, 0);
    EXPECT_EQ(content("a.png"), content("b.png"));
    EXPECT_EQ(png_palette(content("a.png")).size(), 16u);
    ASSERT_EQ(run(option + " -o c.ppm").code, 0);
    EXPECT_GT(colors_of("c.ppm", 96 * 64).size(), 64u) << palette;
  }
}

TEST_F(PaletteProgram, DisplayModesShowOnlyColorsOfTheirHardware) {
  write_balls("balls.json", kSize);
  const struct {
    const char* mode;
    std::size_t pixels, colors;
    std::uint32_t max_level;
  } kModes[] = {{"ega", 640 * 350, 16, 3}, {"amiga", 320 * 256, 32, 15}, {"vga13h", 320 * 200, 256, 63}};
  for (const auto& [mode, pixels, colors, max_level] : kModes)
    for (const char* const palette : {"adaptive", "ramps"})
      for (const char* const reduce : {"", " --reduce"}) {
        const std::string options = std::string(" --mode ") + mode + " --palette " + palette + reduce;
        const Result result = run("render balls.json" + options + " -o a.ppm --dump a.bin");
        ASSERT_EQ(result.code, 0) << options << result.err;
        const std::set<std::string> shown = colors_of("a.ppm", pixels);
        EXPECT_LE(shown.size(), colors) << options;
        EXPECT_GT(shown.size(), colors / 4) << options;
        for (const std::string& color : shown)
          for (const char component : color) {
            const auto level = static_cast<std::uint8_t>(component);
            const std::uint32_t v = (2 * level * max_level + 255) / 510;
            EXPECT_EQ((2 * 255 * v + max_level) / (2 * max_level), level) << options;
          }
      }
}

TEST_F(PaletteProgram, PicturesAreTheSameForAnyThreadsAndInstructionSet) {
  write_balls("balls.json", kSize);
  for (const char* const palette : {"adaptive", "ramps"}) {
    const std::string render = std::string("render balls.json --mode vga13h --palette ") + palette;
    ASSERT_EQ(run(render + " --threads 1 --isa scalar -o first.ppm").code, 0);
    for (const char* const options :
         {" --threads 1", " --threads 2", " --threads 8", " --threads 3 --tile-size 32"}) {
      ASSERT_EQ(run(render + options + " -o other.ppm").code, 0);
      EXPECT_EQ(content("other.ppm"), content("first.ppm")) << palette << options;
    }
  }
}

TEST_F(PaletteProgram, AnimationsShareAPaletteOrFollow) {
  write_balls("balls.json", R"("mode": "vga13h", "palette": "adaptive")");
  const auto palettes = [&](const std::string& options) {
    const Result result = run("render balls.json --frames 4 -o 'f_{frame}.png'" + options);
    EXPECT_EQ(result.code, 0) << result.err;
    std::vector<std::vector<detail::Rgb8>> all;
    for (const char* const name : {"f_0000.png", "f_0001.png", "f_0002.png", "f_0003.png"})
      all.push_back(png_palette(content(name)));
    for (const auto& palette : all) EXPECT_EQ(palette.size(), 256u);
    return all;
  };
  const auto shared = palettes("");
  EXPECT_EQ(shared[0], shared[3]);
  EXPECT_EQ(palettes(" --palette-over animation"), shared);
  const auto own = palettes(" --palette-over frame");
  EXPECT_NE(own[0], own[3]);
  const auto smooth = palettes(" --palette-over smooth");
  EXPECT_EQ(smooth[0], own[0]);
  EXPECT_NE(smooth[0], smooth[1]);
  for (std::size_t f = 1; f < smooth.size(); ++f)
    for (std::size_t i = 0; i < smooth[f].size(); ++i)
      EXPECT_LE(std::sqrt(detail::squared_distance(detail::oklab_from_rgb8(smooth[f][i]),
                                                   detail::oklab_from_rgb8(smooth[f - 1][i]))),
                0.02)
          << f << " " << i;
  write_balls("balls.json", R"("mode": "vga13h", "palette": "adaptive", "palette_over": "smooth")");
  EXPECT_EQ(palettes(""), smooth);
  const auto ramps = palettes(" --palette ramps --palette-over animation");
  EXPECT_EQ(ramps[0], ramps[3]);
}

TEST_F(PaletteProgram, RefusesWhatHasNoPaletteToChoose) {
  write_balls("balls.json", kSize);
  write_balls("cga.json", R"("mode": "cga", "palette": "ramps")");
  write_balls("over.json", R"("palette_over": "frame")");
  write("index.json", R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8,
    "color": {"mode": "index", "bits": 4}}, "frame": [{"clear": {"index": 3}}]})");
  const struct {
    const char* arguments;
    int code;
    const char* fragment;
  } kBad[] = {
      {"balls.json --mode cga --palette adaptive", 2, "mode \"cga\" has 4 fixed colours"},
      {"balls.json --mode vga16 --palette adaptive", 2, "mode \"vga16\" has no palette"},
      {"balls.json --mode hercules --palette ramps", 2, "colour components of 1 bit"},
      {"cga.json", 1, "/framebuffer/palette: palette_request: mode \"cga\" has 4 fixed colours"},
      {"over.json", 1, "/framebuffer/palette_over: needs \"palette\": \"adaptive\" or \"ramps\""},
      {"balls.json --palette-over frame --frames 2", 2, "needs the palette \"adaptive\" or \"ramps\""},
      {"balls.json --palette ramps --palette-over smooth --frames 2", 2, "a smooth palette follows pictures"},
      {"index.json --palette adaptive", 2, "/frame/0: a clear stores palette indices"},
      {"index.json --palette ramps", 2, "/frame/0: a clear stores palette indices"},
  };
  for (const auto& [arguments, code, fragment] : kBad) {
    const Result result = run(std::string("render ") + arguments + " -o 'a{frame}.ppm'");
    EXPECT_EQ(result.code, code) << arguments;
    EXPECT_TRUE(contains(result.err, fragment)) << arguments << "\n" << result.err;
  }
  EXPECT_EQ(run("render --palette adaptiv -o a.ppm").code, 2);
}

// Textures and vertex colours are known before anything is drawn.
TEST_F(PaletteProgram, RampsHoldVertexColorsAndBackgrounds) {
  write("quad.json", R"({"tessera": 1, "framebuffer": {"width": 32, "height": 32},
    "meshes": {"q": {"primitive": "triangles", "positions": [[-1, -1, 0], [1, -1, 0], [0, 1, 0]],
                     "colors": [[0.2, 0.4, 0.6, 1], [0.2, 0.4, 0.6, 1], [0.2, 0.4, 0.6, 1]]}},
    "frame": [{"clear": {"color": [1, 0.2, 0, 1], "depth": 1}}, {"draw": "q", "lighting": false}]})");
  ASSERT_EQ(run("render quad.json -o a.ppm").code, 0);
  const Result result = run("render quad.json --palette ramps -o b.ppm");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(content("a.ppm"), content("b.ppm"));
}

}  // namespace
}  // namespace tessera::palette_program_test
#endif
