// Real models: their scenes are written as scene files, which the engine, the reference renderer and Mesa
// read independently and draw.
#include "engine/program/scene/model_scene.h"
#include "engine/program/scene/write_scene.h"
#include "tests/pictures/model_list.h"
#include "tests/pictures/picture_harness.h"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include <unistd.h>

namespace tessera::test::picture_models_test {
using namespace program;
namespace {

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = std::filesystem::path(info.param).filename().string();
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class PictureModel : public testing::TestWithParam<std::string> {};

TEST_P(PictureModel, MatchesReferenceAndMesa) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("tessera_models_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::string path = (folder / (test_name({GetParam(), 0}) + ".json")).string();
  write_scene(model_scene(import_model(GetParam(), ModelUse::display), GetParam(), 160, 120), path);
  const ThreeWayReport report = compare_three_ways(path);
  std::filesystem::remove_all(folder);
  EXPECT_TRUE(report.mesa_cannot.empty()) << report.mesa_cannot;
  if (!report.is_good()) ADD_FAILURE() << report.text() << "\n  pictures in " << write_pictures(report);
}

INSTANTIATE_TEST_SUITE_P(Models, PictureModel, testing::ValuesIn(compared_models()), test_name);

}  // namespace
}  // namespace tessera::test::picture_models_test
