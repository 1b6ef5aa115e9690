// Each named stage against a scene without one that must give the same picture.
#include <gtest/gtest.h>

#include "engine/program/scene/scene.h"
#include "tests/engine/frame/api_support.h"

namespace tessera::program::named_stages_test {
namespace {

using namespace test;

const std::string kBefore = R"({"tessera": 1, "framebuffer": {"width": 160, "height": 120},
  "lights": [{"position": [1, 2, 2, 1]}],
  "materials": {"shiny": {"specular": [0.5, 0.5, 0.5, 1], "shininess": 20},
                "white": {"diffuse": [1, 1, 1, 1]}, "dull": {"ambient": [0, 0, 0, 1]}},
  "meshes": {"pot": {"builtin": "teapot", "detail": 6}, "ball": {"builtin": "sphere", "detail": 6},
             "quad": {"positions": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]],
                      "indices": [0, 1, 2, 0, 2, 3]},
             "painted": {"positions": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]],
                         "indices": [0, 1, 2, 0, 2, 3],
                         "colors": [[1, 0, 0, 1], [1, 0, 0, 1], [0, 0, 1, 1], [0, 0, 1, 1]]}},
)";
const std::string kCamera =
    R"("camera": {"eye": [0.6, 1.2, 3.4], "projection": {"fovy": 38, "near": 0.5, "far": 20}},
)";
const std::string kFlatCamera =
    R"("camera": {"view": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1],
                  "projection": [1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1]},
)";

struct Picture {
  std::vector<std::uint32_t> colors, depths;
};

Picture picture_of(const std::string& camera, const std::string& clear_depth, const std::string& draws) {
  const Scene scene =
      parse_scene(kBefore + camera + R"("frame": [{"clear": {"color": [0.1, 0.1, 0.2, 1], "depth": )" +
                      clear_depth + "}}, " + draws + "]}",
                  "named stages");
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer);
  record(scene, frame);
  Renderer().finish(frame);
  Picture picture{std::vector<std::uint32_t>(pixel_count(buffer)), stored_depths(buffer)};
  buffer.read_packed_colors(picture.colors);
  return picture;
}

int largest_difference(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int shift = 0; shift < 24; shift += 8)
      largest = std::max(
          largest, std::abs(static_cast<int>(a[i] >> shift & 255) - static_cast<int>(b[i] >> shift & 255)));
  return largest;
}

TEST(NamedStages, UncoverIsAScissor) {
  const std::string draw = R"({"draw": "pot", "material": "shiny", "shading": "phong", )";
  const Picture staged =
      picture_of(kCamera, "1", draw + R"("stages": [{"name": "uncover", "amount": 0.5}]})");
  const Picture expected = picture_of(kCamera, "1", draw + R"("scissor": [0, 0, 80, 120]})");
  EXPECT_EQ(staged.colors, expected.colors);
  EXPECT_EQ(staged.depths, expected.depths);
}

TEST(NamedStages, ZoomIsAMatrix) {
  // The camera's projection, and the same with x and y times 2.
  const std::string camera = R"("camera": {"view": [1,0,0,0, 0,1,0,0, 0,0,1,-4, 0,0,0,1], "projection": )";
  const std::string plain = camera + "[1.5,0,0,0, 0,2,0,0, 0,0,-1.25,-2, 0,0,-1,0]},";
  const std::string doubled = camera + "[3,0,0,0, 0,4,0,0, 0,0,-1.25,-2, 0,0,-1,0]},";
  const std::string draw = R"({"draw": "pot", "material": "shiny", "shading": "phong")";
  const Picture staged = picture_of(plain, "1", draw + R"(, "stages": [{"name": "zoom", "factor": 2}]})");
  const Picture expected = picture_of(doubled, "1", draw + "}");
  EXPECT_EQ(staged.colors, expected.colors);
  EXPECT_EQ(staged.depths, expected.depths);
}

TEST(NamedStages, ReversedClipZIsAReversedDepthRange) {
  const std::string draw = R"({"draw": "ball", "material": "shiny", )";
  const Picture staged =
      picture_of(kCamera, "1", draw + R"("stages": [{"name": "reverse_z", "space": "clip"}]})");
  const Picture expected = picture_of(kCamera, "1", draw + R"("depth_range": [1, 0]})");
  // The order of the arithmetic differs, so that depths may round to neighbouring levels.
  EXPECT_EQ(staged.colors, expected.colors);
  for (std::size_t i = 0; i < staged.depths.size(); ++i)
    ASSERT_LE(std::abs(static_cast<int>(staged.depths[i]) - static_cast<int>(expected.depths[i])), 1) << i;
}

TEST(NamedStages, ReversedWindowZIsGreater) {
  const std::string draw = R"({"draw": "ball", "material": "shiny", )";
  const Picture staged = picture_of(
      kCamera, "0",
      draw + R"("depth": {"test": "greater"}, "stages": [{"name": "reverse_z", "space": "window"}]})");
  const Picture expected = picture_of(kCamera, "1", draw + R"("depth": {"test": "less"}})");
  EXPECT_LE(largest_difference(staged.colors, expected.colors),
            1);  // Gouraud colours of 0 to 1, or of levels
  constexpr std::uint32_t kFarthest = (1u << 24) - 1;
  for (std::size_t i = 0; i < staged.depths.size(); ++i)
    ASSERT_EQ(staged.depths[i], kFarthest - expected.depths[i]) << i;
}

TEST(NamedStages, GradientOfTheObjectIsVertexColors) {
  const std::string stages =
      R"("stages": [{"name": "gradient_object_y", "colors": [[1, 0, 0, 1], [0, 0, 1, 1]]}])";
  for (const std::string state :
       {R"("lighting": false)", R"("shading": "phong", "color_material": "ambient_and_diffuse")"}) {
    const Picture staged = picture_of(kCamera, "1", R"({"draw": "quad", )" + state + ", " + stages + "}");
    EXPECT_EQ(staged.colors, picture_of(kCamera, "1", R"({"draw": "painted", )" + state + "}").colors)
        << state;
  }
  // Lit draws without color_material show the gradient, too.
  EXPECT_EQ(
      picture_of(kCamera, "1", R"({"draw": "quad", )" + stages + "}").colors,
      picture_of(kCamera, "1", R"({"draw": "painted", "color_material": "ambient_and_diffuse"})").colors);
}

TEST(NamedStages, GradientOfTheWindowIsVertexColors) {
  const std::string stages =
      R"("stages": [{"name": "gradient_screen_y", "colors": [[1, 0, 0, 1], [0, 0, 1, 1]]}])";
  const Picture staged = picture_of(
      kFlatCamera, "1", R"({"draw": "quad", "lighting": false, "material": "white", )" + stages + "}");
  const Picture expected = picture_of(kFlatCamera, "1", R"({"draw": "painted", "lighting": false})");
  EXPECT_LE(largest_difference(staged.colors, expected.colors), 1);
}

TEST(NamedStages, FalloffIsTheAttenuationOfALight) {
  // Light and falloff share their place; the light shines without attenuation, or with 1/d^2.
  const std::string draw = R"({"draw": "ball", "material": "dull", "shading": "phong")";
  const std::string stages = R"(, "stages": [{"name": "falloff", "from": [1, 2, 2], "exponent": 2}])";
  const auto lights = [](const std::string& attenuation) {
    return R"({"lights": [{"position": [1, 2, 2, 1], "ambient": [0, 0, 0, 1])" + attenuation + "}]}, ";
  };
  const Picture staged = picture_of(kCamera, "1", lights("") + draw + stages + "}");
  const Picture expected = picture_of(kCamera, "1", lights(R"(, "attenuation": [0, 0, 1])") + draw + "}");
  EXPECT_LE(largest_difference(staged.colors, expected.colors), 1);
  EXPECT_NE(staged.colors, picture_of(kCamera, "1", lights("") + draw + "}").colors);
}

}  // namespace
}  // namespace tessera::program::named_stages_test
