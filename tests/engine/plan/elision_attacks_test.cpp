// Hundreds of scenes, each written to attack the condition of one elision, give the same bits with effects
// left out and in full.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "engine/program/threads/thread_limit.h"
#include "tests/engine/plan/attack_scene.h"

namespace tessera::elision_attacks_test {
namespace {

using namespace test;

Fingerprint picture_of(const AttackScene& scene, Renderer& renderer) {
  FrameBuffer buffer(scene.format);
  Frame frame(buffer);
  scene.record(frame);
  renderer.finish(frame);
  return fingerprint(buffer);
}

/// A renderer that leaves out effects, and its description.
struct ElidingRenderer {
  std::string name;
  Renderer renderer;
};

constexpr int kTileSizes[] = {32, 64, 128};

/// Per instruction set and 1, 3 and 8 threads: a renderer for each tile size.
std::vector<std::vector<ElidingRenderer>> eliding_renderers() {
  std::vector<std::vector<ElidingRenderer>> all;
  for (const InstructionSet set : available_instruction_sets())
    for (const int threads : {1, 3, 8}) {
      all.emplace_back();
      for (const int tile_size : kTileSizes)
        all.back().push_back(
            {std::string(name(set)) + ", " + std::to_string(threads) + " threads, tiles of " +
                 std::to_string(tile_size),
             Renderer({.threads = threads, .tile_size = tile_size, .instruction_set = set})});
    }
  return all;
}

struct Family {
  const char* name;
  AttackScenes (*scenes)();
};
std::ostream& operator<<(std::ostream& out, const Family& family) { return out << family.name; }

constexpr Family kFamilies[] = {{"LightBehind", light_behind_attacks},
                                {"LightCone", light_cone_attacks},
                                {"LightStrength", light_strength_attacks},
                                {"Normals", normal_attacks},
                                {"Alpha", alpha_attacks},
                                {"Blending", blend_attacks},
                                {"Colors", color_attacks},
                                {"Vertices", vertex_attacks},
                                {"Depth", depth_attacks},
                                {"Buffers", buffer_attacks}};

class ElisionAttacks : public testing::TestWithParam<Family> {};

TEST_P(ElisionAttacks, KeepEveryBit) {
  const program::ThreadLimit limit(8);
  Renderer in_full({.threads = 1, .elide = false});
  std::vector<std::vector<ElidingRenderer>> renderers = eliding_renderers();
  const AttackScenes scenes = GetParam().scenes();
  std::size_t turn = 0;  // selects the tile size
  for (const AttackScene& scene : scenes) {
    SCOPED_TRACE(scene.name);
    if (scene.claimed) {
      EXPECT_TRUE(scene.claims(*scene.claimed)) << code(*scene.claimed);
    }
    if (scene.not_claimed) {
      EXPECT_FALSE(scene.claims(*scene.not_claimed)) << code(*scene.not_claimed);
    }
    const Fingerprint expected = picture_of(scene, in_full);
    for (std::vector<ElidingRenderer>& of_threads : renderers) {
      ElidingRenderer& eliding = of_threads[turn++ % of_threads.size()];
      EXPECT_EQ(picture_of(scene, eliding.renderer), expected) << eliding.name;
    }
    ++turn;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryFamily, ElisionAttacks, testing::ValuesIn(kFamilies),
                         [](const testing::TestParamInfo<Family>& family) { return family.param.name; });

TEST(ElisionAttackScenes, AreAtLeast200Scenes) {
  std::size_t scenes = 0;
  for (const Family& family : kFamilies) scenes += family.scenes().size();
  EXPECT_GE(scenes, 200u);
}

}  // namespace
}  // namespace tessera::elision_attacks_test
