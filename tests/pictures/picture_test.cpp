// Whole pictures: every scene of tests/scenes and the built-in one, drawn by the engine, the reference
// renderer and Mesa. One rule applies to all of them (picture_harness.h). In pictures of few levels or
// palette entries, one different rounding changes a pixel by a whole level. Such pixels lie where two levels
// meet, and only few of them are close enough to the middle.
#include "tests/mesa/mesa_renderer.h"
#include "tests/pictures/picture_harness.h"
#include "tests/reference/scene.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>

#include <gtest/gtest.h>

namespace tessera::test::picture_test {
namespace {

std::vector<std::string> scene_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(TESSERA_TEST_SCENES))
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  std::ranges::sort(files);
  files.push_back(TESSERA_SOURCE_DIR "/engine/program/scenes/shiny_teapot.json");
  return files;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = std::filesystem::path(info.param).stem().string();
  const auto is_permitted = [](char c) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    return is_letter || (c >= '0' && c <= '9');
  };
  std::ranges::replace_if(name, std::not_fn(is_permitted), '_');
  return name;
}

class Picture : public testing::TestWithParam<std::string> {};

TEST_P(Picture, MatchesReferenceAndMesa) {
  const ThreeWayReport report = compare_three_ways(GetParam());
  if (!report.is_good()) ADD_FAILURE() << report.text() << "\n  pictures in " << write_pictures(report);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Picture, testing::ValuesIn(scene_files()), test_name);

TEST(PictureScenes, AreCompleteAndMesaSupportsMost) {
  constexpr std::size_t kAtLeast = 340;
  constexpr std::size_t kByMesaAtLeast = 250;
  EXPECT_GE(scene_files().size(), kAtLeast) << "in " TESSERA_TEST_SCENES;
  std::size_t by_mesa = 0;
  for (const std::string& file : scene_files())
    by_mesa += mesa::unsupported(reference::load_scene(file)) ? 0 : 1;
  EXPECT_GE(by_mesa, kByMesaAtLeast);
}

// Mesa uses one level of detail for several pixels: the pictures of its two drivers differ by more than the
// rule allows.
TEST(PictureTextures, ComeNearMesasLevelOfDetailIfMipmapped) {
  constexpr double kShareOfAll = 0.94;
  constexpr double kShareOfEach = 0.85;  // some scenes consist of level transitions only
  int pictures = 0;
  reference::Counts all{};
  double min_alike = 1;
  for (const std::string& file : scene_files()) {
    const reference::Scene scene = reference::load_scene(file);
    const bool mipmapped = std::ranges::any_of(
        scene.textures, [](const auto& texture) { return texture.min > reference::MinFilter::kLinear; });
    if (!mipmapped || mesa::unsupported(scene)) continue;
    const ThreeWayReport report = compare_three_ways(file);
    const Rgb own = mesa::render(scene, mesa::LevelOfDetail::mesas_own);
    if (own == report.mesa) continue;  // lit by shaders, which also choose the level of detail
    const reference::Counts counts =
        reference::compare(own, report.engine, report.width_px, report.height_px).all;
    const double alike = 1 - static_cast<double>(counts.differing) / static_cast<double>(counts.pixels);
    EXPECT_GE(alike, kShareOfEach) << report.name;
    all.pixels += counts.pixels;
    all.differing += counts.differing;
    min_alike = std::min(min_alike, alike);
    ++pictures;
  }
  EXPECT_GE(pictures, 15);
  const double alike = 1 - static_cast<double>(all.differing) / static_cast<double>(all.pixels);
  EXPECT_GE(alike, kShareOfAll);
  std::printf(
      "[  figure  ] %d pictures with Mesa's own level of detail: %.2f %% of the pixels within %d levels, of "
      "each at least %.2f %%\n",
      pictures, 100 * alike, reference::kTolerance, 100 * min_alike);
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
}  // namespace tessera::test::picture_test
