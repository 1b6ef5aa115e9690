// Caps of a Quality in scene files and in the option --quality.
#include <gtest/gtest.h>

#include "engine/program/scene/quality_names.h"
#include "engine/program/scene/scene.h"
#include "tests/engine/frame/api_support.h"
#include "tests/engine/program/program.h"

namespace tessera::quality_program_test {
namespace {

using namespace program;

Scene quality_scene(const std::string& members) {
  return parse_scene(R"({"tessera": 1, )" + members + "}", "quality.json");
}
std::string error_of_quality(const std::string& value) {
  return test::error_of([&] { (void)quality_scene(R"("quality": )" + value); }).value_or("");
}

TEST(QualityOfScenes, HasTheFieldsOfTheInterface) {
  EXPECT_EQ(quality_scene(R"("lights": [])").quality, Quality{});
  EXPECT_EQ(quality_scene(R"("quality": {})").quality, Quality{});
  const Quality all{.shading = ShadingCap::phong_2x2,
                    .renormalize = false,
                    .viewer = ViewerCap::infinite,
                    .interpolation = InterpolationCap::affine,
                    .texture = TextureCap::bilinear,
                    .light_threshold = 0.25f};
  EXPECT_EQ(quality_scene(R"("quality": {"shading": "phong_2x2", "renormalize": false, "viewer": "infinite",
                             "interpolation": "affine", "texture": "bilinear", "light_threshold": 0.25})")
                .quality,
            all);
  EXPECT_EQ(parse_quality("shading=phong_2x2,renormalize=off,viewer=infinite,interpolation=affine,"
                          "texture=bilinear,light_threshold=0.25"),
            all);
  EXPECT_EQ(parse_quality("shading=as_asked,renormalize=on,viewer=as_asked,interpolation=perspective,"
                          "texture=as_asked,light_threshold=0"),
            Quality{});
}

TEST(QualityOfScenes, IsACommandForTheDrawsThatFollow) {
  const Scene scene = quality_scene(
      R"("meshes": {"a": {"builtin": "cube"}}, "quality": {"shading": "flat"},
         "frame": [{"draw": "a", "shading": "phong"}, {"quality": {}}, {"draw": "a", "shading": "phong"}])");
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer);
  record(scene, frame);
  EXPECT_NE(frame.explain(0).find("flat, at the vertices"), std::string::npos) << frame.explain(0);
  EXPECT_NE(frame.explain(1).find("once per visible pixel"), std::string::npos) << frame.explain(1);
}

TEST(QualityOfScenes, RefusesUnknownKeysAndValues) {
  EXPECT_EQ(error_of_quality(R"({"shadings": "flat"})"),
            "quality.json: /quality/shadings: unknown key \"shadings\"; did you mean \"shading\"?");
  EXPECT_EQ(error_of_quality(R"({"texture": "linear"})"),
            "quality.json: /quality/texture: found \"linear\", expected one of \"as_asked\", \"bilinear\", "
            "\"nearest\"; did you mean \"bilinear\"?");
  EXPECT_EQ(error_of_quality(R"({"renormalize": "off"})"),
            "quality.json: /quality/renormalize: found \"off\", expected true or false");
  EXPECT_NE(error_of_quality(R"({"light_threshold": 1.5})").find("/quality/light_threshold"),
            std::string::npos);
}

class QualityOption : public Program {};

TEST_F(QualityOption, ReplacesTheQualityOfTheScene) {
  write("scene.json", R"({"tessera": 1, "framebuffer": {"width": 64, "height": 48},
    "meshes": {"a": {"builtin": "teapot"}}, "quality": {"shading": "flat"},
    "frame": [{"clear": {"color": [0, 0, 0, 1], "depth": 1}},
              {"quality": {"shading": "flat"}}, {"draw": "a", "shading": "phong"}]})");
  ASSERT_EQ(run("render scene.json -o flat.png").code, 0);
  ASSERT_EQ(run("render scene.json -o phong.png --quality shading=as_asked").code, 0);
  ASSERT_EQ(run("render scene.json -o gouraud.png --quality shading=gouraud").code, 0);
  ASSERT_EQ(run("render scene.json -o same.png --shading gouraud --quality shading=as_asked").code, 0);
  EXPECT_EQ(content("gouraud.png"), content("same.png"));
  EXPECT_NE(content("gouraud.png"), content("flat.png"));
  EXPECT_NE(content("gouraud.png"), content("phong.png"));
  const Result explained = run("explain scene.json --json --quality shading=phong_4x4");
  EXPECT_EQ(explained.code, 0);
  EXPECT_NE(explained.out.find("\"per_4x4_pixels\""), std::string::npos);
  EXPECT_NE(explained.out.find("\"quality.shading\""), std::string::npos);
}

TEST_F(QualityOption, RefusesUnknownKeysAndValues) {
  const auto error = [&](const std::string& value) {
    const Result result = run("render --quality '" + value + "'");
    EXPECT_EQ(result.code, 2) << value;
    return result.err;
  };
  const auto contains = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(contains(error("shade=flat"), "found key \"shade\", expected one of shading, renormalize"));
  EXPECT_TRUE(contains(error("shading=gourod"), "found shading \"gourod\", expected one of as_asked"));
  EXPECT_TRUE(contains(error("renormalize=true"), "expected one of on, off"));
  EXPECT_TRUE(
      contains(error("light_threshold=2"), "found light_threshold \"2\", expected a number from 0 to 1"));
  EXPECT_TRUE(contains(error("light_threshold=nan"), "expected a number from 0 to 1"));
  EXPECT_TRUE(contains(error("shading"), "found \"shading\", expected KEY=VALUE"));
  EXPECT_TRUE(contains(error(""), "found \"\", expected KEY=VALUE"));
  EXPECT_TRUE(contains(error("shading=flat,"), "found \"\", expected KEY=VALUE"));
  EXPECT_TRUE(contains(error("shading=flat,shading=flat"), "\"shading\" twice"));
}

}  // namespace
}  // namespace tessera::quality_program_test
