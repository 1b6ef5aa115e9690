// Whole pictures: every scene of tests/scenes and the built-in one, drawn by the engine, by the reference renderer and by
// Mesa. The rule (picture_harness.h) is the same for all of them. In pictures of few levels or palette entries a rounding
// that goes the other way is a whole level off: such pixels lie where two levels meet, and few enough of them are near
// enough to the middle between the two.
#include "tests/mesa/mesa_renderer.h"
#include "tests/picture_harness.h"
#include "tests/reference/scene.h"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

namespace tessera::test {
namespace {

std::vector<std::string> scene_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(TESSERA_TEST_SCENES))
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  std::ranges::sort(files);
  files.push_back(TESSERA_SOURCE_DIR "/engine/scenes/shiny_teapot.json");
  return files;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = std::filesystem::path(info.param).stem().string();
  std::ranges::replace_if(name, [](char c) { return !(c >= 'a' && c <= 'z') && !(c >= 'A' && c <= 'Z') && !(c >= '0' && c <= '9'); }, '_');
  return name;
}

class Picture : public testing::TestWithParam<std::string> {};

TEST_P(Picture, IsTheSameByEngineReferenceAndMesa) {
  const ThreeWayReport report = compare_three_ways(GetParam());
  if (!report.is_good()) ADD_FAILURE() << report.text() << "\n  pictures in " << write_pictures(report);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Picture, testing::ValuesIn(scene_files()), test_name);

TEST(PictureScenes, AreAllThereAndMesaFollowsMost) {
  constexpr std::size_t kAtLeast = 340, kByMesaAtLeast = 250;
  EXPECT_GE(scene_files().size(), kAtLeast) << "in " TESSERA_TEST_SCENES;
  std::size_t by_mesa = 0;
  for (const std::string& file : scene_files()) by_mesa += mesa::unsupported(reference::load_scene(file)) ? 0 : 1;
  EXPECT_GE(by_mesa, kByMesaAtLeast);
}

TEST(PictureRule, AllowsNoFractionOfAPixel) {
  reference::Comparison comparison;
  comparison.all = {199, 1, 255};
  EXPECT_FALSE(obeys_rule(comparison));
  comparison.all = {200, 1, 255};
  EXPECT_TRUE(obeys_rule(comparison));
  comparison.interior = {999, 1, 3};
  EXPECT_FALSE(obeys_rule(comparison));
  comparison.interior = {1000, 1, 3};
  EXPECT_TRUE(obeys_rule(comparison));
}

}  // namespace
}  // namespace tessera::test
