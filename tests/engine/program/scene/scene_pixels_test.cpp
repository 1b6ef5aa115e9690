// Bitmaps, images and shadows of scene files: defaults and keys.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "engine/program/imageio/picture.h"
#include "engine/program/scene/scene.h"
#include "tests/engine/frame/api_support.h"

namespace tessera::scene_pixels_test {
using namespace program;
namespace {

using namespace test;
using testing::ElementsAre;

Scene scene_of(const std::string& frame, const std::string& rest = "") {
  return parse_scene(R"({"tessera": 1, )" + rest + R"("frame": [)" + frame + "]}", "test.json");
}
template <class Command>
const Command& first(const Scene& scene) {
  return std::get<Command>(scene.frame.at(0).value);
}

TEST(ScenePixels, BitmapDefaults) {
  const Scene scene =
      scene_of(R"({"bitmap": {"at": [1.5, -2], "width": 9, "height": 2, "rows": ["ff80", "0aB5"]}})");
  const auto& command = first<BitmapCommand>(scene);
  const Bitmap bitmap = command.view();
  EXPECT_EQ(bitmap.x, 1.5);
  EXPECT_EQ(bitmap.y, -2);
  EXPECT_EQ(bitmap.depth, 0);
  EXPECT_EQ(bitmap.color.r, 1);
  EXPECT_EQ(bitmap.color.a, 1);
  EXPECT_EQ(bitmap.bits, command.bits.data());
  EXPECT_THAT(command.bits, ElementsAre(0xff, 0x80, 0x0a, 0xb5));
  EXPECT_TRUE(command.state.depth.enabled && command.state.depth.write);
  EXPECT_EQ(command.state.depth.test, Compare::less);
  EXPECT_FALSE(command.state.blend || command.state.stencil || command.state.alpha_test ||
               command.state.scissor);
}

TEST(ScenePixels, DepthIsNumberOrTest) {
  const auto of = [](const std::string& depth, const std::string& rest = "") {
    return first<BitmapCommand>(scene_of(
        R"({"bitmap": {"at": [0, 0], "width": 1, "height": 1, "rows": ["80"], "depth": )" + depth + "}}",
        rest));
  };
  EXPECT_EQ(of("0.25").bitmap.depth, 0.25);
  EXPECT_EQ(of("0.25").state.depth.test, Compare::less);
  EXPECT_EQ(of(R"({"test": "gequal", "write": false})").bitmap.depth, 0);
  EXPECT_EQ(of(R"({"test": "gequal", "write": false})").state.depth.test, Compare::gequal);
  EXPECT_FALSE(of(R"({"test": "gequal", "write": false})").state.depth.write);
  EXPECT_FALSE(of("false").state.depth.enabled);
  EXPECT_FALSE(of("0.5", R"("framebuffer": {"depth": "none"}, )").state.depth.enabled);
}

TEST(ScenePixels, ReadsImageOnceWithTopRowFirst) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("tessera_scene_pixels_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "two.ppm", std::ios::binary)
      << "P6 2 2 255\n"
      << std::string("\x0a\x14\x1e\x28\x32\x3c\x46\x50\x5a\x64\x6e\x78", 12);
  std::ofstream(folder / "scene.json") << R"({"tessera": 1, "framebuffer": {"width": 4, "height": 4},
    "frame": [{"clear": {"color": [0, 0, 0, 1], "depth": 1}},
    {"image": {"at": [{"keys": [[0, 1], [1, 2]]}, 1], "file": "two.ppm"}}]})";
  SceneFile file((folder / "scene.json").string());
  for (const int shift : {0, 1}) {
    const Scene scene = file.at(shift);
    std::filesystem::remove(folder / "two.ppm");
    const auto& command = std::get<ImageCommand>(scene.frame.at(1).value);
    EXPECT_EQ(command.image.zoom_x, 1);
    EXPECT_EQ(command.image.zoom_y, 1);
    FrameBuffer buffer(scene.framebuffer);
    Frame frame(buffer);
    record(scene, frame);
    Renderer({.threads = 1}).finish(frame);
    std::vector<std::uint32_t> expected(16, 0);
    const auto at = static_cast<std::size_t>(1 + shift);
    expected[4 + at] = 0x0a141e, expected[5 + at] = 0x28323c, expected[8 + at] = 0x46505a,
                 expected[9 + at] = 0x646e78;
    EXPECT_EQ(packed_colors(buffer), expected);
  }
  std::filesystem::remove_all(folder);
}

// Colours are not multiplied by alpha.
TEST(ScenePixels, ImagesKeepStraightAlpha) {
  const Picture gray = read_picture(TESSERA_TEST_SCENES "/textures/letter_grey_alpha.png");
  const Picture color = read_picture(TESSERA_TEST_SCENES "/textures/letter_rgba.png");
  bool clear = false;
  bool between = false;
  bool bright = false;
  for (const Picture* picture : {&gray, &color})
    for (std::size_t i = 0; i < picture->rgba.size(); i += 4) {
      const std::uint8_t alpha = picture->rgba[i + 3];
      clear |= alpha == 0;
      between |= alpha > 0 && alpha < 255;
      bright |= alpha < 255 && picture->rgba[i] > alpha;
      if (picture == &gray) {
        EXPECT_EQ(picture->rgba[i], picture->rgba[i + 2]);
      }
    }
  EXPECT_TRUE(clear || between);
  EXPECT_TRUE(bright) << "a colour above its alpha";
}

TEST(ScenePixels, ShadowDefaultsAndCurrentLights) {
  const std::string pot = R"("meshes": {"pot": {"builtin": "cube"}}, )";
  const Scene scene = scene_of(R"({"draw": "pot", "shadow_on": {"plane": [0, 0, 1, 2]}})", pot);
  const auto& shadow = first<DrawCommand>(scene).state.shadow_on;
  ASSERT_TRUE(shadow);
  EXPECT_THAT(shadow->plane, ElementsAre(0, 0, 1, 2));
  EXPECT_EQ(shadow->light, 0u);
  EXPECT_EQ(shadow->color.r, 0);
  EXPECT_EQ(shadow->color.a, 1);
  const Scene later = scene_of(
      R"({"lights": [{}, {"position": [0, 5, 0, 1]}]}, {"draw": "pot", "shadow_on": {"plane": [0, 1, 0, 2],
    "light": 1}})",
      pot);
  EXPECT_EQ(std::get<DrawCommand>(later.frame.at(1).value).state.shadow_on->light, 1u);
}

}  // namespace
}  // namespace tessera::scene_pixels_test
