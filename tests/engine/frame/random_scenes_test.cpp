// Random scenes: what the generator promises, and the same bits with effects left out and in full.
// TESSERA_LONG=1: 1,000 scenes.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <set>

#include "engine/program/scene/scene.h"
#include "engine/program/threads/thread_limit.h"
#include "tests/engine/frame/api_support.h"
#include "tests/random_scenes/random_scene.h"

namespace tessera::random_scenes_test {
namespace {

using namespace program;
using namespace test;

std::uint64_t scene_count() { return std::getenv("TESSERA_LONG") != nullptr ? 1000 : 40; }

Scene scene_of(std::uint64_t seed) { return parse_scene(random_scene(seed), "random scene"); }

Fingerprint picture(const Scene& scene, const RendererOptions& options) {
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer);
  record(scene, frame);
  Renderer renderer(options);
  renderer.finish(frame);
  return fingerprint(buffer);
}

std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

TEST(RandomScenes, AreTheSameFilesEverywhere) {
  std::string all;
  for (std::uint64_t seed = 0; seed < 100; ++seed) all += random_scene(seed);
  EXPECT_EQ(hash_of(all), 11672132462622073502u);
}

TEST(RandomScenes, HaveTheirTrianglesAndLights) {
  int many_lights = 0;
  for (std::uint64_t seed = 0; seed < scene_count(); ++seed) {
    const Scene scene = scene_of(seed);
    std::size_t triangles = 0;
    for (const MeshData& mesh : scene.meshes) triangles += mesh.triangle_count();
    EXPECT_GE(triangles, 1000u) << seed;
    EXPECT_LE(triangles, 200000u) << seed;
    const std::size_t lights = scene.lights.size();
    EXPECT_TRUE((lights >= 1 && lights <= 8) || (lights >= 32 && lights <= 64)) << seed << ": " << lights;
    many_lights += lights > 8 ? 1 : 0;
  }
  EXPECT_GE(many_lights, 1);
}

TEST(RandomScenes, HaveTheirPixelsPerTriangle) {
  int in_class[3] = {};
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Scene scene = scene_of(seed);
    FrameBuffer buffer(scene.framebuffer);
    Frame frame(buffer);
    record(scene, frame);
    RendererOptions options;
    options.debug.count_fragments = true;
    options.elide = false;
    const FrameStats stats = Renderer(options).finish(frame);
    const double pixels = static_cast<double>(stats.fragments) / static_cast<double>(stats.triangles_in);
    int of_scene = 0;
    if (pixels >= 4) of_scene = 1;
    if (pixels > 64) of_scene = 2;
    ++in_class[of_scene];
  }
  std::printf("scenes with less than 4, 4 to 64, and more pixels per triangle: %d, %d, %d\n", in_class[0],
              in_class[1], in_class[2]);
  for (const int count : in_class) EXPECT_GE(count, 6);
}

TEST(RandomScenes, KeepTheirBitsWhateverIsLeftOut) {
  const ThreadLimit limit(8);
  for (std::uint64_t seed = 0; seed < scene_count(); ++seed) {
    const Scene scene = scene_of(seed);
    const Fingerprint in_full = picture(scene, {.threads = 1, .elide = false});
    const int threads = 1 + static_cast<int>(seed % 8);
    const int tile_size = 32 << seed % 3;
    const std::vector<InstructionSet> sets = available_instruction_sets();
    const InstructionSet set = sets[seed % sets.size()];
    EXPECT_EQ(picture(scene, {.threads = threads, .tile_size = tile_size, .instruction_set = set}), in_full)
        << "scene " << seed << ", " << threads << " threads, tiles of " << tile_size << ", " << name(set);
  }
}

TEST(RandomScenes, KeepTheirBitsWithUserStages) {
  const ThreadLimit limit(8);
  const std::uint64_t count = std::getenv("TESSERA_LONG") != nullptr ? 200 : 60;
  const std::vector<InstructionSet> sets = available_instruction_sets();
  std::set<std::string> names;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const std::string text = random_scene_with_stages(seed);
    const Scene scene = parse_scene(text, "random scene with stages");
    const Fingerprint plain = picture(scene, {.threads = 1,
                                              .tile_size = 64,
                                              .instruction_set = InstructionSet::scalar,
                                              .elide = false,
                                              .debug = {.defer_shading = false}});
    for (int threads = 1; threads <= 8; ++threads) {
      const int tile_size = 32 << (seed + static_cast<std::uint64_t>(threads)) % 3;
      const InstructionSet set = sets[(seed + static_cast<std::uint64_t>(threads)) % sets.size()];
      EXPECT_EQ(picture(scene, {.threads = threads,
                                .tile_size = tile_size,
                                .instruction_set = set,
                                .debug = {.defer_shading = threads % 4 != 0}}),
                plain)
          << "scene " << seed << ", " << threads << " threads, tiles of " << tile_size << ", " << name(set);
    }
    for (const char* stage :
         {"gradient_object_y", "gradient_screen_y", "uncover", "clip", "window", "zoom", "falloff"})
      if (text.find(stage) != std::string::npos) names.insert(stage);
  }
  EXPECT_EQ(names.size(), 7u);
}

/// Different caps for each seed; one of 8 caps nothing but the lights.
Quality random_quality(std::uint64_t seed) {
  Quality quality;
  quality.shading = static_cast<ShadingCap>(seed % 5);
  quality.renormalize = seed / 2 % 2 == 0;
  quality.viewer = static_cast<ViewerCap>(seed / 4 % 2);
  quality.interpolation = static_cast<InterpolationCap>(seed / 3 % 2);
  quality.texture = static_cast<TextureCap>(seed / 5 % 3);
  quality.light_threshold = static_cast<float>(seed % 7) / 20;
  return quality;
}

TEST(RandomScenes, KeepTheirBitsUnderCaps) {
  const ThreadLimit limit(8);
  int changed = 0;
  for (std::uint64_t seed = 0; seed < scene_count(); ++seed) {
    Scene scene = scene_of(seed);
    const std::vector<InstructionSet> sets = available_instruction_sets();
    const InstructionSet set = sets[seed % sets.size()];
    const Fingerprint uncapped = picture(scene, {.threads = 1});
    scene.quality = random_quality(seed);
    const Fingerprint in_full =
        picture(scene, {.threads = 1, .elide = false, .debug = {.defer_shading = seed % 2 == 0}});
    const int threads = 1 + static_cast<int>(seed % 8);
    const int tile_size = 32 << seed % 3;
    EXPECT_EQ(picture(scene, {.threads = threads, .tile_size = tile_size, .instruction_set = set}), in_full)
        << "scene " << seed << ", " << threads << " threads, tiles of " << tile_size << ", " << name(set);
    changed += in_full == uncapped ? 0 : 1;
  }
  EXPECT_GT(changed, static_cast<int>(scene_count() / 2));
}

}  // namespace
}  // namespace tessera::random_scenes_test
