// Scenes in display modes, and the reduction of pictures to their colours.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "engine/program/imageio/picture.h"
#include "engine/program/scene/scene.h"
#include "engine/program/scene/scene_mode.h"

namespace tessera::program::scene_mode_test {
namespace {

using testing::HasSubstr;

Scene scene_of(const std::string& framebuffer, const std::string& draw = "") {
  return parse_scene(R"({"tessera": 1, "framebuffer": )" + framebuffer +
                         R"(, "meshes": {"q": {"builtin": "quad"}},
                     "frame": [{"draw": "q")" +
                         draw + "}]}",
                     "s.json");
}
std::string error_of(const std::string& framebuffer, const std::string& draw = "") {
  try {
    scene_of(framebuffer, draw);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SceneMode, DeterminesSizeColorsAndAspect) {
  const Scene scene = scene_of(R"({"mode": "ega", "dither": "bayer4", "depth": "unorm16"})");
  EXPECT_EQ(scene.framebuffer.width, 640);
  EXPECT_EQ(scene.framebuffer.height, 350);
  EXPECT_EQ(scene.framebuffer.color_mode, ColorMode::index);
  EXPECT_EQ(scene.framebuffer.color_bits, 4);
  EXPECT_EQ(scene.framebuffer.palette.size(), 16u);
  EXPECT_EQ(scene.framebuffer.dither, Dither::bayer4);
  EXPECT_EQ(scene.framebuffer.depth, DepthFormat::unorm16);
  ASSERT_TRUE(scene.mode);
  EXPECT_EQ(scene.mode->screen_aspect(), 4.0 / 3);
  EXPECT_FALSE(scene.reduced);
}

TEST(SceneMode, TakesAPaletteOfTheHardware) {
  const Scene scene = scene_of(R"({"mode": "vga", "palette": [[0, 0, 0], [1, 0, 0]]})");
  ASSERT_EQ(scene.framebuffer.palette.size(), 2u);
  EXPECT_EQ(scene.mode->palette[1].r, 1);
  EXPECT_THAT(error_of(R"({"mode": "vga", "palette": [[0.2, 0, 0]]})"),
              HasSubstr("/framebuffer/palette: check_palette: palette entry 0 is (51, 0, 0), which mode"));
  EXPECT_THAT(error_of(R"({"mode": "cga", "palette": "gray"})"), HasSubstr("fixed"));
  EXPECT_THAT(error_of(R"({"mode": "vga24", "palette": "gray"})"), HasSubstr("has no palette"));
}

TEST(SceneMode, RefusesValuesThatTheModeDetermines) {
  for (const char* const key : {R"("width": 320)", R"("height": 200)", R"("color": {"bits": 8})"})
    EXPECT_THAT(error_of(R"({"mode": "cga", )" + std::string(key) + "}"),
                HasSubstr("the display mode determines it"));
  EXPECT_THAT(error_of(R"({"mode": "vgaa"})"), HasSubstr("did you mean \"vga"));
  EXPECT_THAT(error_of(R"({"mode": "ham"})"), HasSubstr("is not supported"));
  EXPECT_THAT(error_of(R"({"reduce": true})"), HasSubstr("needs a display \"mode\""));
  Scene scene = scene_of(R"({"mode": "cga"})");
  EXPECT_THROW(apply({.width = 10}, scene), Error);
  EXPECT_THROW(apply({.color_bits = 8}, scene), Error);
  Scene plain = scene_of("{}");
  EXPECT_THROW(apply({.reduce = true}, plain), Error);
}

TEST(SceneMode, ReducedScenesMayBlend) {
  const std::string blend = R"(, "blend": {})";
  EXPECT_THAT(error_of(R"({"mode": "cga"})", blend), HasSubstr("an index buffer does not blend"));
  const Scene scene = scene_of(R"({"mode": "cga", "reduce": true, "dither": "bayer2", "samples": 4})", blend);
  EXPECT_EQ(scene.framebuffer.color_mode, ColorMode::rgb);
  EXPECT_EQ(scene.framebuffer.color_bits, 24);
  EXPECT_EQ(scene.framebuffer.samples, 4);
  EXPECT_EQ(scene.framebuffer.dither, Dither::none);
  ASSERT_TRUE(scene.reduced);
  EXPECT_EQ(scene.reduced->color_bits, 2);
  EXPECT_EQ(scene.reduced->dither, Dither::bayer2);
}

TEST(SceneMode, OverridesReplaceTheModeAndKeepReductionAndDither) {
  Scene scene = scene_of(R"({"mode": "cga", "reduce": true, "dither": "bayer2"})");
  apply({.mode = display_mode("ega")}, scene);
  ASSERT_TRUE(scene.reduced);
  EXPECT_EQ(scene.reduced->width, 640);
  EXPECT_EQ(scene.framebuffer.height, 350);
  EXPECT_EQ(scene.reduced->dither, Dither::bayer2);
  apply({.palette = "gray"}, scene = scene_of(R"({"mode": "64x64x4"})"));
  EXPECT_EQ(scene.framebuffer.palette[1].g, 17 / 255.0f);
}

/// A picture of noise.
Picture noise(int width, int height) {
  std::mt19937 random(7);
  Picture picture(width, height);
  for (std::uint8_t& component : picture.rgba) component = static_cast<std::uint8_t>(random());
  return picture;
}

std::vector<std::uint32_t> reduced_words(const FrameBufferFormat& format, Picture& picture) {
  FrameBuffer buffer(format);
  Renderer renderer;
  reduce_picture(renderer, picture, buffer);
  std::vector<std::uint32_t> words(picture.rgba.size() / 4);
  buffer.read_packed_colors(words);
  return words;
}

TEST(ReducePicture, ChoosesTheNearestEntryOfAllPalettes) {
  for (const char* const name : {"cga", "ega", "amiga", "vga13h", "gray4"}) {
    const FrameBufferFormat format = frame_buffer_format(display_mode(name));
    const Picture source = noise(format.width, format.height);
    Picture shown = source;
    const std::vector<std::uint32_t> words = reduced_words(format, shown);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < words.size(); i += 7) {
      const auto distance = [&](std::size_t entry) {
        const Color& c = format.palette[entry];
        const long dr = std::lround(255 * c.r) - source.rgba[4 * i];
        const long dg = std::lround(255 * c.g) - source.rgba[4 * i + 1];
        const long db = std::lround(255 * c.b) - source.rgba[4 * i + 2];
        return dr * dr + dg * dg + db * db;
      };
      long nearest = distance(0);
      for (std::size_t entry = 1; entry < format.palette.size(); ++entry)
        nearest = std::min(nearest, distance(entry));
      wrong += distance(words[i]) != nearest ? 1u : 0u;
      wrong += shown.rgba[4 * i + 1] != std::lround(255 * format.palette[words[i]].g) ? 1u : 0u;
    }
    EXPECT_EQ(wrong, 0u) << name;
  }
}

TEST(ReducePicture, RoundsAndDithersComponents) {
  constexpr int kBayer4[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
  for (const Dither dither : {Dither::none, Dither::bayer4}) {
    FrameBufferFormat format = frame_buffer_format(display_mode("61x35x16"));
    format.dither = dither;
    const Picture source = noise(61, 35);
    Picture shown = source;
    const std::vector<std::uint32_t> words = reduced_words(format, shown);
    for (int y = 0; y < 35; ++y)
      for (int x = 0; x < 61; ++x) {
        const auto i = static_cast<std::size_t>(61 * y + x);
        const int from_below = 34 - y;
        // t = 1/2, or (M + 1/2) / 16; in units of 1/32.
        const int t32 = dither == Dither::none ? 16 : 2 * kBayer4[from_below % 4][x % 4] + 1;
        const auto level = [&](std::size_t c, int bits) {
          return static_cast<std::uint32_t>((32 * source.rgba[4 * i + c] * ((1 << bits) - 1) + 255 * t32) /
                                            (32 * 255));
        };
        ASSERT_EQ(words[i], level(0, 5) << 11 | level(1, 6) << 5 | level(2, 5)) << x << " " << y;
      }
  }
}

}  // namespace
}  // namespace tessera::program::scene_mode_test
