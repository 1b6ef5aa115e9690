// The built-in scenes of `tessera accuracy`: the default is as accurate as 8 bits allow, and settings err as
// they should.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/program/compare/picture_errors.h"
#include "perf/accuracy/accuracy_input.h"
#include "perf/accuracy/reference_pictures.h"
#include "perf/accuracy/setting_frames.h"

namespace tessera::accuracy::accuracy_scenes_test {
namespace {

using ::testing::AllOf;
using ::testing::Ge;
using ::testing::Le;

AccuracyInput input_named(const std::string& name) {
  AccuracyOptions options;
  options.scenes = {name};
  return accuracy_inputs(options).front();
}

program::Picture drawn(AccuracyInput& input, const std::string& setting) {
  Renderer renderer({.threads = 1});
  for (const Setting& candidate : settings_for(input.scene, input.settings))
    if (candidate.name == setting) {
      SettingFrames frames(input.scene, candidate.variation, renderer);
      frames.draw();
      return frames.picture();
    }
  throw Error("found no setting " + setting);
}

double unrounded_rms(AccuracyInput& input, const std::string& setting) {
  const ReferencePicture reference = render_point_reference(input.reference);
  return program::unrounded_errors(program::pixels_of(drawn(input, setting)), reference.unrounded).rms;
}

class AccuracySceneTest : public ::testing::TestWithParam<std::string> {};

TEST_P(AccuracySceneTest, DefaultIsAtMostOneLevelFromTheReference) {
  AccuracyInput input = input_named(GetParam());
  const ReferencePicture reference = render_point_reference(input.reference);
  const program::Picture picture = drawn(input, kDefaultSetting);
  EXPECT_LE(
      program::picture_errors(program::pixels_of(picture), program::pixels_of(reference.stored)).largest, 1);
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const SceneText& scene : scene_list()) names.push_back(scene.name);
  return names;
}
std::string test_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(BuiltIn, AccuracySceneTest, ::testing::ValuesIn(scene_names()), test_name);

TEST(AccuracyScenes, DefaultOfAModelIsAtMostOneLevelFromTheReference) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "accuracy pyramid.obj";
  std::ofstream(path) << "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nv 0 1.5 0\n"
                         "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 4 3 2 1\n";
  AccuracyOptions options;
  options.scenes = {"none"};
  options.files = {path.string(), path.string()};
  std::vector<AccuracyInput> inputs = accuracy_inputs(options);
  std::filesystem::remove(path);
  ASSERT_EQ(inputs.size(), 2u);
  EXPECT_EQ(inputs[0].name, "accuracy-pyramid");
  EXPECT_EQ(inputs[1].name, "accuracy-pyramid-2");
  const ReferencePicture reference = render_point_reference(inputs[0].reference);
  const program::Picture picture = drawn(inputs[0], kDefaultSetting);
  EXPECT_LE(
      program::picture_errors(program::pixels_of(picture), program::pixels_of(reference.stored)).largest, 1);
  const auto [low, high] = std::minmax_element(picture.rgba.begin(), picture.rgba.end());
  EXPECT_GT(*high - *low, 100) << "the model must be visible";
}

TEST(AccuracyScenes, DefaultErrsByRoundingAloneWhereColorsVarySmoothly) {
  for (const char* name : {"wall-8", "teapots-near", "lights-1", "lights-8", "matt", "glossy"}) {
    AccuracyInput input = input_named(name);
    EXPECT_THAT(unrounded_rms(input, kDefaultSetting), AllOf(Ge(0.27), Le(0.31))) << name;
  }
}

// The error of linear interpolation is quadratic in the distance of the vertices.
TEST(AccuracyScenes, GouraudErrorOnTheWallFallsWithTheSquareOfTheQuads) {
  std::vector<double> rms;
  for (const int quads : {4, 8, 16}) {
    AccuracyInput input = input_named("wall-" + std::to_string(quads));
    rms.push_back(unrounded_rms(input, "gouraud"));
  }
  EXPECT_THAT(rms[0] / rms[1], AllOf(Ge(3), Le(4.5)));
  EXPECT_THAT(rms[1] / rms[2], AllOf(Ge(3), Le(4.5)));
}

TEST(AccuracyScenes, JitteredPassesConvergeToTheReferenceOf16x16Samples) {
  AccuracyInput input = input_named("floor");
  input.scene.framebuffer.width = input.reference.framebuffer.width_px = 64;
  input.scene.framebuffer.height = input.reference.framebuffer.height_px = 48;
  const ReferencePicture area = render_area_reference(input.reference, 2, [](double) { return true; });
  const auto rms = [&](const char* setting) {
    return program::unrounded_errors(program::pixels_of(drawn(input, setting)), area.unrounded).rms;
  };
  const double once = rms(kDefaultSetting), four = rms("jitter_4"), eight = rms("jitter_8");
  EXPECT_LT(four, once / 2);
  EXPECT_LT(eight, four);
  EXPECT_LT(rms("jitter_16"), eight);
}

TEST(AccuracyScenes, SettingsThatChangeNothingDrawTheDefaultPicture) {
  AccuracyInput input = input_named("matt");
  EXPECT_EQ(drawn(input, "depth_32").rgba, drawn(input, kDefaultSetting).rgba);
  EXPECT_NE(drawn(input, "half").rgba, drawn(input, kDefaultSetting).rgba);
  EXPECT_EQ(input.scene.framebuffer.width, kSceneWidth) << "the scene must be as before";
}

TEST(AccuracyScenes, NamesOfSettingsAreUnique) {
  for (const SceneText& text : scene_list()) {
    const program::Scene scene = program::parse_scene(text.json, text.name);
    std::vector<std::string> names;
    for (const Setting& setting : settings_for(scene, text.settings)) names.push_back(setting.name);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end()) << text.name;
  }
}

/// A white triangle before black with corners at multiples of 1/16 pixel; 8x8 pixels, unlit.
constexpr const char* kTriangle = R"({
  "tessera": 1,
  "framebuffer": {"width": SIZE, "height": SIZE, "stencil": 0},
  "camera": {
    "projection": {
      "type": "orthographic", "left": 0, "right": 8, "bottom": 0, "top": 8, "near": -1, "far": 1
    },
    "eye": [0, 0, 0],
    "target": [0, 0, -1]
  },
  "meshes": {
    "t": {
      "positions": [[0.25, 0.125, 0], [7.5, 2.0625, 0], [3.1875, 7.75, 0]],
      "colors": [[1, 1, 1, 1], [1, 1, 1, 1], [1, 1, 1, 1]]
    }
  },
  "frame": [{"clear": {"color": [0, 0, 0, 1], "depth": 1}}, {"draw": "t", "lighting": false}]
})";

std::string triangle_scene(int size) {
  std::string text = kTriangle;
  while (text.find("SIZE") != std::string::npos) text.replace(text.find("SIZE"), 4, std::to_string(size));
  return text;
}

TEST(AccuracyReferences, AreaReferenceIsTheMeanOfAPictureSixteenTimesAsLarge) {
  const ReferencePicture area =
      render_area_reference(reference::parse_scene(triangle_scene(8), ""), 2, [](double) { return true; });
  const ReferencePicture large = render_point_reference(reference::parse_scene(triangle_scene(128), ""));
  for (std::size_t y = 0; y < 8; ++y)
    for (std::size_t x = 0; x < 8; ++x) {
      int covered = 0;
      for (std::size_t j = 0; j < 16; ++j)
        for (std::size_t i = 0; i < 16; ++i)
          covered += large.unrounded[3 * ((16 * y + j) * 128 + 16 * x + i)] > 0.5f ? 1 : 0;
      EXPECT_FLOAT_EQ(area.unrounded[3 * (8 * y + x)], static_cast<float>(covered) / 256) << x << ", " << y;
    }
}

TEST(AccuracyReferences, AreaReferenceIsTheSameForAnyNumberOfThreads) {
  const reference::Scene scene = reference::parse_scene(triangle_scene(8), "");
  const auto rendered = [&](int threads) {
    return render_area_reference(scene, threads, [](double) { return true; }).unrounded;
  };
  EXPECT_EQ(rendered(1), rendered(3));
}

TEST(AccuracyReferences, FalseFromProgressCancels) {
  const reference::Scene scene = reference::parse_scene(triangle_scene(8), "");
  EXPECT_THROW(render_area_reference(scene, 2, [](double) { return false; }), Cancelled);
}

TEST(AccuracyReferences, StoredPictureIsTheRoundedUnroundedOne) {
  AccuracyInput input = input_named("wall-1");
  const ReferencePicture point = render_point_reference(input.reference);
  for (std::size_t i = 0; i < point.unrounded.size(); ++i)
    ASSERT_LE(std::abs(255.0 * point.unrounded[i] - point.stored.rgba[i / 3 * 4 + i % 3]), 0.50002);
}

}  // namespace
}  // namespace tessera::accuracy::accuracy_scenes_test
