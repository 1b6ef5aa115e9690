// OBJ files that readers often get wrong, and what they must look like.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include "tests/engine/program/import/model_picture.h"

namespace tessera::obj_cases_test {
using namespace program;
using namespace model_picture;
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Model model_of(const std::string& name) {
  return import_model(kModels + "obj/" + name + ".obj", ModelUse::display);
}

/// The colours of a picture other than the background's.
std::set<Pixel> colors_of(const Picture& picture) {
  std::set<Pixel> colors;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) colors.insert(pixel(picture, x, y));
  colors.erase(kBackground);
  return colors;
}

// The twins have no normals, or positions near the origin.
TEST(ObjCases, EqualTheirPlainTwins) {
  for (const std::string name : {"empty_normal_index", "index_0", "zero_normals", "far_from_origin"}) {
    const Picture picture = draw_model("obj/" + name + ".obj");
    EXPECT_EQ(picture.rgba, draw_model("obj/plain/" + name + ".obj").rgba) << name;
    EXPECT_GT(count_pixels(picture, [](Pixel p) { return p != kBackground; }), 2000) << name;
  }
}

TEST(ObjCases, ShininessZeroIsBrown) {
  for (const Pixel& color : colors_of(draw_model("obj/shininess_0.obj"))) {
    EXPECT_LE(color[0], 128) << "Kd is 0.5 0.4 0.3";
    EXPECT_GE(color[0], color[1]);
    EXPECT_GE(color[1], color[2]);
  }
}

// An octagonal prism without smoothing: of its flat faces, three sides and the top are in view.
TEST(ObjCases, SmoothingOffShowsFlatFaces) {
  const Model model = model_of("smoothing_off");
  std::set<std::array<float, 3>> normals;
  for (std::size_t i = 0; i < model.mesh.normals.size(); i += 3)
    normals.insert({model.mesh.normals[i], model.mesh.normals[i + 1], model.mesh.normals[i + 2]});
  EXPECT_EQ(normals.size(), 10u);
}

TEST(ObjCases, VertexColorsShowWithAWhiteMaterial) {
  const std::set<Pixel> colors = colors_of(draw_model("obj/vertex_colors.obj"));
  const auto has = [&](auto predicate) { return std::ranges::any_of(colors, predicate); };
  EXPECT_TRUE(has([](Pixel p) { return p[0] > 100 && p[1] < 30 && p[2] > 100; })) << "magenta corner";
  EXPECT_TRUE(has([](Pixel p) { return p[0] < 30 && p[1] > 100 && p[2] > 100; })) << "cyan corner";
  EXPECT_TRUE(has([](Pixel p) { return p[0] > 100 && p[1] > 100 && p[2] < 30; })) << "yellow corner";
}

TEST(ObjCases, TexturesAreRead) {
  const Model textured = model_of("textured");
  EXPECT_THAT(textured.warnings, IsEmpty());
  ASSERT_TRUE(textured.parts.at(0).texture);
  EXPECT_GT(textured.images.at(0).width, 1);
  const Picture checks = draw_model("obj/textured.obj");
  EXPECT_GT(count_pixels(checks, [](Pixel p) { return p[0] > 100 && p[1] < 30 && p[2] < 30; }), 2000)
      << "red";
  EXPECT_GT(count_pixels(checks, [](Pixel p) { return p[0] > 100 && p[1] > 100 && p[2] < 30; }), 2000)
      << "yellow";
  const Model black = model_of("black_textured");
  ASSERT_TRUE(black.parts.at(0).texture);
  EXPECT_EQ(black.parts[0].material.diffuse.r, 1);
  EXPECT_THAT(black.warnings, ElementsAre(HasSubstr("have no texture coordinates")));
  EXPECT_GT(count_pixels(draw_model("obj/black_textured.obj"), [](Pixel p) { return p[0] > 100; }), 2000);
}

TEST(ObjCases, LinesAreRead) {
  const Model model = model_of("lines");
  ASSERT_EQ(model.parts.size(), 1u);
  EXPECT_EQ(model.parts[0].primitive, Primitive::lines);
  EXPECT_EQ(model.parts[0].index_count, 10u);
  const int drawn = count_pixels(draw_model("obj/lines.obj"), [](Pixel p) { return p != kBackground; });
  EXPECT_GT(drawn, 200);
  EXPECT_LT(drawn, 1000);
}

}  // namespace
}  // namespace tessera::obj_cases_test
