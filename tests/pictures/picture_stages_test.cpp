// Random scenes whose draws carry user stages, drawn by the engine and by the reference renderer with the
// same functions. TESSERA_LONG=1: 200 scenes.
#include "tests/pictures/picture_harness.h"
#include "tests/random_scenes/random_scene.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace tessera::test::picture_stages_test {
namespace {

TEST(PictureStages, RandomScenesEqualTheReference) {
  const std::uint64_t count = std::getenv("TESSERA_LONG") != nullptr ? 200 : 25;
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("stages_" + std::to_string(std::rand()) + ".json");
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    std::ofstream(file) << random_scene_with_stages(seed);
    const ThreeWayReport report = compare_three_ways(file.string());
    if (report.is_good()) continue;
    ADD_FAILURE() << "scene " << seed << "\n" << report.text() << write_pictures(report);
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace tessera::test::picture_stages_test
