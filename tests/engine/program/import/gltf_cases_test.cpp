// glTF files that readers often get wrong, and what they must look like.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/engine/program/import/model_picture.h"

namespace tessera::gltf_cases_test {
using namespace program;
using namespace model_picture;
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Model model_of(const std::string& name) {
  return import_model(kModels + "gltf/" + name + ".gltf", ModelUse::display);
}

/// The message of the error that a file causes.
std::string error_of(const std::string& file) {
  try {
    import_model(kModels + "gltf/" + file, ModelUse::display);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

// The twins say the same by plain floats, positions and file names.
TEST(GltfCases, EqualTheirPlainTwins) {
  for (const std::string name : {"quantized", "skin", "morph_weights", "percent_encoded"}) {
    const Picture picture = draw_model("gltf/" + name + ".gltf");
    EXPECT_EQ(picture.rgba, draw_model("gltf/plain/" + name + ".gltf").rgba) << name;
    EXPECT_GT(count_pixels(picture, [](Pixel p) { return p != kBackground; }), 3000) << name;
  }
}

TEST(GltfCases, LinearFactorsBecomeDisplayReferred) {
  const Picture picture = draw_model("gltf/linear_color.gltf");
  const Pixel center = pixel(picture, 120, 90);
  for (const int component : center) EXPECT_NEAR(component, 127.5, 0.5);
}

TEST(GltfCases, UnlitMaterialsMultiplyVertexColours) {
  const Model model = model_of("unlit_vertex_colors");
  ASSERT_EQ(model.parts.size(), 1u);
  EXPECT_TRUE(model.parts[0].is_unlit);
  // Half of linear white is 188 of 255; red, green and blue vertices keep one component.
  const Picture picture = draw_model("gltf/unlit_vertex_colors.gltf");
  EXPECT_GT(count_pixels(picture, [](Pixel p) { return p[0] > 150 && p[1] < 60 && p[2] < 60; }), 50);
  EXPECT_GT(count_pixels(picture, [](Pixel p) { return p[1] > 150 && p[0] < 60 && p[2] < 60; }), 50);
  EXPECT_GT(count_pixels(picture, [](Pixel p) { return p[2] > 150 && p[0] < 60 && p[1] < 60; }), 50);
  EXPECT_EQ(count_pixels(picture, [](Pixel p) { return p[0] > 189 || p[1] > 189 || p[2] > 189; }), 0);
}

TEST(GltfCases, BackFacesOfSingleSidedMaterialsAreCulled) {
  // A black ball around an orange one shows only its far half: a rim.
  const Picture picture = draw_model("gltf/single_sided.gltf");
  const int black = count_pixels(picture, [](Pixel p) { return p == Pixel{0, 0, 0}; });
  const int orange = count_pixels(picture, [](Pixel p) { return p[0] > p[2] + 40; });
  EXPECT_GT(orange, 8000);
  EXPECT_GT(black, 500);
  EXPECT_LT(black, orange / 3);
  const Pixel center = pixel(picture, 120, 90);
  EXPECT_GT(center[0], center[2] + 40);
}

TEST(GltfCases, MasksDiscardTexelsBelowTheCutoff) {
  const int square = count_pixels(draw_model("gltf/textured.gltf"), [](Pixel p) { return p != kBackground; });
  const Picture leaf = draw_model("gltf/masked_leaf.gltf");
  const int round = count_pixels(leaf, [](Pixel p) { return p != kBackground; });
  EXPECT_NEAR(static_cast<double>(round) / square, 0.6, 0.25);
  EXPECT_NE(pixel(leaf, 120, 90), kBackground);
}

TEST(GltfCases, BlendedPanesShowWhatIsBehind) {
  const Model model = model_of("blended_window");
  ASSERT_EQ(model.parts.size(), 2u);
  const Material& pane = model.parts[1].material;
  EXPECT_EQ(model.parts[1].alpha, ModelAlpha::blend);
  EXPECT_FLOAT_EQ(pane.diffuse.a, 0.3f);
  // A corner of the pane: 0.3 of its colour, 0.7 of the background.
  const Picture picture = draw_model("gltf/blended_window.gltf");
  Pixel corner{};
  for (int x = 40; x < 200 && (corner == Pixel{} || corner == kBackground); ++x)
    corner = pixel(picture, x, 60);
  ASSERT_NE(corner, kBackground);
  const double opaque_red = (corner[0] - 0.7 * kBackground[0]) / 0.3;
  EXPECT_LT(opaque_red, 255);
  EXPECT_GT(opaque_red, 120);
  // Blue shines through where the box is.
  EXPECT_GT(count_pixels(picture, [](Pixel p) { return p[2] > p[1] + 40 && p[0] > 60; }), 800);
}

TEST(GltfCases, TexturesHaveTheirColours) {
  const Picture picture = draw_model("gltf/textured.gltf");
  EXPECT_GT(count_pixels(picture, [](Pixel p) { return p[0] > 180 && p[1] < 40; }), 1500);   // red
  EXPECT_GT(count_pixels(picture, [](Pixel p) { return p[0] > 180 && p[1] > 180; }), 1500);  // yellow
}

TEST(GltfCases, LinesAreDrawn) {
  const Model alone = model_of("lines");
  ASSERT_EQ(alone.parts.size(), 1u);
  EXPECT_EQ(alone.parts[0].primitive, Primitive::lines);
  EXPECT_GT(count_pixels(draw_model("gltf/lines.gltf"), [](Pixel p) { return p != kBackground; }), 150);

  const Model beside = model_of("lines_beside_triangles");
  ASSERT_EQ(beside.parts.size(), 2u);
  EXPECT_EQ(beside.parts[0].primitive, Primitive::triangles);
  EXPECT_EQ(beside.parts[1].primitive, Primitive::lines);
  EXPECT_GT(count_pixels(draw_model("gltf/lines_beside_triangles.gltf"),
                         [](Pixel p) {
                           return p == Pixel{255, 255, 255};
                         }),
            200);
}

TEST(GltfCases, LightLiesOverTheShoulderOfTheFilesCamera) {
  // The camera views the ball from behind. Its upper left is lit, its lower right is not.
  const Picture picture = draw_model("gltf/camera_of_file.gltf");
  EXPECT_GT(pixel(picture, 112, 75)[0], 150);
  int darkest = 255;
  for (int x = 120; x < 200; ++x)
    if (const Pixel p = pixel(picture, x, 125); p != kBackground) darkest = std::min(darkest, p[0]);
  EXPECT_LT(darkest, 90);
}

TEST(GltfCases, UnsupportedExtensionsAreNamed) {
  EXPECT_THAT(error_of("unknown_required_extension.gltf"),
              HasSubstr("requires the extension ACME_unknown_thing"));
  EXPECT_THAT(error_of("meshopt_damaged.gltf"), HasSubstr("EXT_meshopt_compression"));
  EXPECT_THAT(model_of("transmission").warnings, ElementsAre(HasSubstr("KHR_materials_transmission")));
  EXPECT_THAT(model_of("textured").warnings, IsEmpty());
}

TEST(GltfCases, EmptyFilesAreCalledEmpty) {
  EXPECT_THAT(error_of("empty.glb"), HasSubstr("the file is empty"));
}

}  // namespace
}  // namespace tessera::gltf_cases_test
