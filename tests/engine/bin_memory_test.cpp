// Frames whose bins would take more memory than is allowed are rendered in parts: the same bits, the same figures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "engine/parallel.h"
#include "tests/engine/api_random_operations.h"
#include "tests/engine/full_tile.h"

namespace tessera {
namespace {

using namespace test;

RendererOptions in_parts(RendererOptions options = {.threads = 1}) {
  options.bin_memory = kLeastBinMemory;
  return options;
}

std::vector<std::uint64_t> triangle_counts(const FrameStats& s) {
  return {s.vertices, s.triangles_in, s.dropped_non_finite, s.outside, s.culled, s.zero_area, s.clipped, s.binned, s.bin_entries, s.tiles, s.fragments};
}

/// What a frame leaves behind, and all that it tells of its pixels.
struct Outcome {
  Fingerprint stored;
  std::vector<std::uint8_t> shown;
  std::vector<std::uint32_t> objects, primitives;
  std::vector<float> normals;
  FrameStats stats;
};
template <class Scene>
Outcome render(const Scene& scene, RendererOptions options) {
  options.count_fragments = true;
  FrameBuffer buffer(scene.format);
  Frame frame(buffer);
  scene.record(frame);
  const std::size_t pixels = pixel_count(buffer);
  Outcome outcome{.objects = std::vector<std::uint32_t>(pixels), .primitives = std::vector<std::uint32_t>(pixels), .normals = std::vector<float>(3 * pixels)};
  frame.capture({.objects = outcome.objects, .primitives = outcome.primitives, .normals = outcome.normals});
  frame.keep({Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation});
  Image image(buffer);
  Renderer renderer(options);
  outcome.stats = renderer.finish(frame, image.target());
  outcome.stored = fingerprint(buffer);
  outcome.shown = image.bytes;
  return outcome;
}

void expect_same(const Outcome& found, const Outcome& expected) {
  EXPECT_EQ(found.stored, expected.stored);
  EXPECT_TRUE(found.shown == expected.shown);
  EXPECT_TRUE(found.objects == expected.objects);
  EXPECT_TRUE(found.primitives == expected.primitives);
  EXPECT_TRUE(found.normals == expected.normals);
  EXPECT_EQ(triangle_counts(found.stats), triangle_counts(expected.stats));
  EXPECT_EQ(expected.stats.bin_passes, 1u);
}

TEST(BinMemory, FramesInPartsAreTheSameFrames) {
  ThreadLimit limit(4);
  for (const int samples : {1, 4}) {
    FrameBufferFormat format{.width = 330, .height = 210, .alpha_bits = 8, .accumulation_bits = 16, .samples = samples};
    const RandomOperations scene(format);
    const Outcome whole = render(scene, {.threads = 1, .tile_size = 32});
    for (const int threads : {1, 4}) {
      SCOPED_TRACE(std::to_string(samples) + " samples, " + std::to_string(threads) + " threads");
      const Outcome parts = render(scene, in_parts({.threads = threads, .tile_size = 32}));
      EXPECT_GT(parts.stats.bin_passes, 4u);
      expect_same(parts, whole);
    }
  }
}

TEST(BinMemory, ASingleTileTakesABatchAtATime) {
  for (const int samples : {1, 8}) {
    const FullTile scene({.width = 60, .height = 50, .samples = samples});
    const Outcome whole = render(scene, {.threads = 1, .tile_size = 64});
    ASSERT_EQ(whole.stats.tiles, 1u);
    for (const bool defer : {true, false}) {
      SCOPED_TRACE(std::to_string(samples) + (defer ? " samples" : " samples, shaded at once"));
      expect_same(render(scene, in_parts({.threads = 1, .tile_size = 64, .defer_shading = defer})), whole);
    }
  }
}

TEST(BinMemory, MayBeAsMuchAsThereIs) {
  const RandomOperations scene({.width = 120, .height = 90});
  EXPECT_EQ(render(scene, {.threads = 1, .bin_memory = std::numeric_limits<std::size_t>::max()}).stats.bin_passes, 1u);
}

TEST(BinMemory, ALimitThatIsTooSmallIsAnError) {
  EXPECT_THAT(error_of([] { Renderer renderer({.bin_memory = 1000}); }).value_or(""), testing::AllOf(testing::HasSubstr("bin_memory is 1000"), testing::HasSubstr("65536")));
}

TEST(BinMemory, ProgressRisesToOneThroughTheParts) {
  const RandomOperations scene({.width = 330, .height = 210});
  double last = 0;
  int calls = 0;
  RendererOptions options = in_parts({.threads = 1, .tile_size = 32});
  options.progress = [&](double done) {
    EXPECT_GE(done, last);
    last = done;
    ++calls;
    return true;
  };
  EXPECT_GT(render(scene, options).stats.bin_passes, 2u);
  EXPECT_EQ(last, 1);
  EXPECT_GT(calls, 6);
}

}  // namespace
}  // namespace tessera
