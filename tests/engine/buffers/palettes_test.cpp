// Chosen palettes at the public interface: errors, modes, materials, and an animation.
#include "engine/tessera/palettes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "engine/program/imageio/picture.h"
#include "engine/program/scene/scene.h"
#include "engine/tessera/tessera.hpp"
#include "framebuffer/oklab.h"

namespace tessera::palettes_test {
namespace {

using program::Picture;
using testing::HasSubstr;

std::string error_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

detail::Oklab oklab(const Color& c) { return detail::oklab_from_rgb8(detail::quantize_rgb8(c.r, c.g, c.b)); }
double distance(const Color& a, const Color& b) {
  return std::sqrt(detail::squared_distance(oklab(a), oklab(b)));
}
double nearest_distance(const std::vector<Color>& palette, const Color& color) {
  double least = 9;
  for (const Color& entry : palette) least = std::min(least, distance(entry, color));
  return least;
}

/// The built-in teapot, turned.
Picture turned_teapot(double degrees, const RendererOptions& options = {}) {
  program::Scene scene = program::builtin_scene();
  scene.framebuffer.width = 160;
  scene.framebuffer.height = 120;
  for (program::SceneCommand& command : scene.frame)
    if (auto* draw = std::get_if<program::DrawCommand>(&command.value))
      draw->state.transform = rotate(degrees, 0, 1, 0);
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer);
  program::record(scene, frame);
  Picture picture(160, 120);
  Renderer(options).finish(frame, picture.target());
  return picture;
}

std::vector<Color> adaptive(const Picture& picture, const PaletteRequest& request) {
  return adaptive_palette(std::span<const std::uint8_t>(picture.rgba), request);
}

TEST(ChosenPalettes, RefuseWrongArguments) {
  const std::vector<std::uint8_t> pixel{1, 2, 3, 4};
  const std::span<const std::uint8_t> rgba(pixel);
  const std::span<const std::uint32_t> no_words;
  EXPECT_THAT(error_of([&] {
                adaptive_palette(rgba, {0, 8});
              }),
              HasSubstr("adaptive_palette: count is 0, must be 1 to 4096"));
  EXPECT_THAT(error_of([&] { adaptive_palette(rgba, {4097, 8}); }), HasSubstr("count is 4097"));
  EXPECT_THAT(error_of([&] {
                adaptive_palette(rgba, {1, 0});
              }),
              HasSubstr("component_bits is 0, must be 1 to 8"));
  EXPECT_THAT(error_of([&] { adaptive_palette(rgba, {1, 9}); }), HasSubstr("component_bits is 9"));
  EXPECT_THAT(error_of([&] { adaptive_palette(rgba.first(3), {1, 8}); }), HasSubstr("3 bytes"));
  EXPECT_THAT(error_of([&] { adaptive_palette(rgba.first(0), {1, 8}); }), HasSubstr("0 pixels"));
  EXPECT_THAT(error_of([&] { adaptive_palette(no_words, {1, 8}); }), HasSubstr("0 pixels"));
  EXPECT_THAT(error_of([&] { adaptive_palette(PictureColors(), {1, 8}); }), HasSubstr("0 pixels"));
  EXPECT_THAT(error_of([&] { ramp_palette({}, {}); }), HasSubstr("no materials and no colours"));
  EXPECT_THAT(error_of([&] { ramp_palette({}, std::vector<Color>{{NAN, 0, 0}}); }), HasSubstr("a colour"));
  EXPECT_THAT(error_of([&] { SmoothPalette({0, 8}); }), HasSubstr("SmoothPalette: count is 0"));
  EXPECT_THAT(error_of([&] { SmoothPalette({1, 8}).follow(PictureColors()); }), HasSubstr("0 pixels"));
  SmoothPalette moved({1, 8});
  const SmoothPalette taken = std::move(moved);
  PictureColors picture;
  picture.add(rgba);
  EXPECT_THAT(error_of([&] { moved.follow(picture); }), HasSubstr("moved from"));
}

TEST(ChosenPalettes, ModesSayWhatTheyHave) {
  const PaletteRequest ega = palette_request(display_mode("ega"));
  EXPECT_EQ(ega.count, 16);
  EXPECT_EQ(ega.component_bits, 2);
  EXPECT_EQ(palette_request(display_mode("amiga")).count, 32);
  EXPECT_EQ(palette_request(display_mode("vga13h")).component_bits, 6);
  EXPECT_EQ(palette_request(display_mode("64x48x16:color=index")).count, 4096);
  EXPECT_THAT(error_of([] { palette_request(display_mode("cga")); }),
              HasSubstr("mode \"cga\" has 4 fixed colours"));
  EXPECT_THAT(error_of([] { palette_request(display_mode("vga16")); }),
              HasSubstr("mode \"vga16\" has no palette: its pixels hold colour components of 16 bits"));
}

TEST(ChosenPalettes, FitEveryModeThatTakesOne) {
  const Picture picture = turned_teapot(20);
  PictureColors colors;
  colors.add(std::span<const std::uint8_t>(picture.rgba));
  const std::vector<LitMaterials> lit{{{*named_material("gold"), *named_material("jade")}, {Light{}}, {}}};
  int modes = 0;
  for (const DisplayMode& mode : display_modes()) {
    if (mode.color_mode != ColorMode::index || mode.palette_component_bits == 0) continue;
    ++modes;
    const PaletteRequest request = palette_request(mode);
    SmoothPalette smooth(request);
    for (const std::vector<Color>& palette :
         {adaptive_palette(colors, request), ramp_palette(lit, {}, request), smooth.follow(colors)}) {
      check_palette(mode, palette);
      FrameBufferFormat format = frame_buffer_format(mode);
      format.palette = palette;
      FrameBuffer buffer(format);  // the frame buffer takes it too
    }
  }
  EXPECT_GE(modes, 8);
}

TEST(ChosenPalettes, BytesAndWordsGiveTheSame) {
  const Picture picture = turned_teapot(0);
  std::vector<std::uint32_t> words;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    words.push_back(0xab000000u | std::uint32_t{picture.rgba[i]} << 16 |
                    std::uint32_t{picture.rgba[i + 1]} << 8 | picture.rgba[i + 2]);
  const std::vector<Color> bytes = adaptive(picture, {32, 6});
  const std::vector<Color> packed = adaptive_palette(std::span<const std::uint32_t>(words), {32, 6});
  ASSERT_EQ(bytes.size(), 32u);
  ASSERT_EQ(packed.size(), 32u);
  for (std::size_t i = 0; i < 32; ++i) EXPECT_EQ(distance(bytes[i], packed[i]), 0);
}

TEST(ChosenPalettes, APictureDrawnWithItsPaletteHasNoOtherColors) {
  const Picture picture = turned_teapot(40);
  const std::vector<Color> palette = adaptive(picture, {16, 2});
  FrameBuffer buffer(
      {.width = 160, .height = 120, .color_mode = ColorMode::index, .color_bits = 4, .palette = palette});
  Frame frame(buffer);
  frame.draw_image({.pixels = picture.rgba.data(), .width = 160, .height = 120},
                   {.depth = {.enabled = false}});
  Picture shown(160, 120);
  Renderer().finish(frame, shown.target());
  for (const std::uint8_t byte : shown.rgba) ASSERT_EQ(byte % 85, 0);
}

TEST(ChosenPalettes, OnePaletteForSeveralPicturesHasTheColorsOfAll) {
  const std::vector<std::uint32_t> red(100, 0xff0000), blue(100, 0x0000ff);
  PictureColors both;
  both.add(std::span<const std::uint32_t>(red));
  both.add(std::span<const std::uint32_t>(blue));
  const std::vector<Color> palette = adaptive_palette(both, {2, 8});
  EXPECT_EQ(nearest_distance(palette, {1, 0, 0}), 0);
  EXPECT_EQ(nearest_distance(palette, {0, 0, 1}), 0);
}

TEST(SmoothPalette, FollowsATurningTeapot) {
  for (const int bits : {6, 8}) {
    SmoothPalette smooth({64, bits});
    std::vector<Color> before;
    double followed = 0, chosen = 0;
    for (int f = 0; f < 50; ++f) {
      const Picture picture = turned_teapot(f * 7.2);
      PictureColors colors;
      colors.add(std::span<const std::uint8_t>(picture.rgba));
      const std::vector<Color> palette = smooth.follow(colors);
      ASSERT_EQ(palette.size(), 64u);
      for (std::size_t i = 0; i < before.size(); ++i)
        ASSERT_LE(distance(palette[i], before[i]), 0.02) << "frame " << f << ", entry " << i;
      before = palette;
      const std::vector<Color> own = adaptive_palette(colors, {64, bits});
      for (std::size_t i = 0; i < picture.rgba.size(); i += 4 * 37) {
        const Color color{picture.rgba[i] / 255.0f, picture.rgba[i + 1] / 255.0f,
                          picture.rgba[i + 2] / 255.0f};
        followed += std::pow(nearest_distance(palette, color), 2);
        chosen += std::pow(nearest_distance(own, color), 2);
      }
    }
    EXPECT_LE(followed, 1.3 * chosen) << bits;
  }
}

// Colours of a lit teapot are near the ramp of its material, wherever the light falls.
TEST(RampPalettes, HoldTheColorsOfLitMaterials) {
  const program::Scene scene = program::builtin_scene();
  LitMaterials group{{}, scene.lights, scene.light_model};
  std::vector<Color> colors;
  for (const program::SceneCommand& command : scene.frame) {
    if (const auto* draw = std::get_if<program::DrawCommand>(&command.value))
      group.materials.push_back(draw->state.material);
    if (const auto* clear = std::get_if<Clear>(&command.value)) colors.push_back(*clear->color);
  }
  const std::vector<Color> palette = ramp_palette(std::span(&group, 1), colors, {64, 8});
  EXPECT_GE(palette.size(), 60u);
  const Picture picture = turned_teapot(0);
  std::size_t far = 0;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    const Color color{picture.rgba[i] / 255.0f, picture.rgba[i + 1] / 255.0f, picture.rgba[i + 2] / 255.0f};
    far += nearest_distance(palette, color) > 0.05;
  }
  EXPECT_LE(static_cast<double>(far) / (160 * 120), 0.02);
}

TEST(RampPalettes, BeginWithAmbientLightAndEndWithTheHighlight) {
  Material material;
  material.ambient = {0.5f, 0, 0, 1};
  material.diffuse = {0.5f, 0.25f, 0, 1};
  material.specular = {1, 1, 1, 1};
  const LitMaterials group{{material}, {Light{}}, {.ambient = {0.4f, 0.4f, 0.4f, 1}}};
  const std::vector<Color> palette = ramp_palette(std::span(&group, 1), {}, {16, 8});
  EXPECT_EQ(palette.size(), 16u);
  EXPECT_EQ(nearest_distance(palette, {0.2f, 0, 0}), 0);
  EXPECT_EQ(nearest_distance(palette, {1, 1, 1}), 0);
  EXPECT_LE(nearest_distance(palette, {0.7f, 0.25f, 0}), 0.05);
}

}  // namespace
}  // namespace tessera::palettes_test
