// Frames whose bins exceed the memory limit are rendered in several passes: the same bits and the same
// statistics.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "engine/program/threads/thread_limit.h"
#include "raster/bins.h"
#include "tests/engine/frame/api_random_operations.h"
#include "tests/engine/runtime/failing_allocations.h"
#include "tests/engine/runtime/test_executors.h"
#include "tests/engine/stages/bin_overflow_scene.h"

namespace tessera::bin_memory_test {
using namespace detail;
using namespace program;
namespace {

using namespace test;

RendererOptions in_parts(RendererOptions options = {.threads = 1}) {
  options.bin_memory = kMinBinMemory;
  return options;
}

std::vector<std::uint64_t> triangle_counts(const FrameStats& s) {
  return {s.vertices,
          s.triangles_in,
          s.dropped_non_finite,
          s.trivially_rejected,
          s.culled,
          s.zero_area,
          s.clipped,
          s.binned,
          s.bin_entries,
          s.tiles,
          s.fragments};
}

/// Everything that a frame stores, shows, captures and reports.
struct Outcome {
  Fingerprint stored;
  std::vector<std::uint8_t> shown;
  std::vector<std::uint32_t> draw_ids;
  std::vector<std::uint32_t> primitive_ids;
  std::vector<float> normals;
  FrameStats stats;
};
template <class Scene>
Outcome render(const Scene& scene, RendererOptions options) {
  options.debug.count_fragments = true;
  FrameBuffer buffer(scene.format);
  Frame frame(buffer);
  scene.record(frame);
  const std::size_t pixels = pixel_count(buffer);
  Outcome outcome{.draw_ids = std::vector<std::uint32_t>(pixels),
                  .primitive_ids = std::vector<std::uint32_t>(pixels),
                  .normals = std::vector<float>(3 * pixels)};
  frame.capture(
      {.draw_ids = outcome.draw_ids, .primitive_ids = outcome.primitive_ids, .normals = outcome.normals});
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
  EXPECT_TRUE(found.draw_ids == expected.draw_ids);
  EXPECT_TRUE(found.primitive_ids == expected.primitive_ids);
  EXPECT_TRUE(found.normals == expected.normals);
  EXPECT_EQ(triangle_counts(found.stats), triangle_counts(expected.stats));
  EXPECT_EQ(expected.stats.bin_passes, 1u);
}

TEST(BinMemory, FramesInPartsEqualWholeFrames) {
  ThreadLimit limit(4);
  for (const int samples : {1, 4}) {
    FrameBufferFormat format{
        .width = 330, .height = 210, .alpha_bits = 8, .accumulation_bits = 16, .samples = samples};
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

TEST(BinMemory, SingleTileProcessesOneBatchAtATime) {
  for (const int samples : {1, 8}) {
    const BinOverflowScene scene({.width = 60, .height = 50, .samples = samples});
    const Outcome whole = render(scene, {.threads = 1, .tile_size = 64});
    ASSERT_EQ(whole.stats.tiles, 1u);
    for (const bool defer : {true, false}) {
      SCOPED_TRACE(std::to_string(samples) + (defer ? " samples" : " samples, shaded at once"));
      expect_same(render(scene, in_parts({.threads = 1, .tile_size = 64, .debug = {.defer_shading = defer}})),
                  whole);
    }
  }
}

#if TESSERA_CAN_FAIL_ALLOCATIONS

/// Maximum of allocated bytes while a new renderer finishes a frame of `count` layers twice, minus the bytes
/// before. The layers share their vertices, and half of them are cut by the near plane: additional layers
/// only take bin entries and derived primitives. `count` 0 draws one triangle without area.
long peak_bytes(int count, RendererOptions options, int tile_size) {
  MeshData layers;
  layers.positions = {-1, -1, 0, 2, -1, 0, -1, 2, 0, -1, -1, 0.5f, 2, -1, -3, -1, 2, 0.5f};
  for (int i = 0; i < count; ++i) layers.indices.insert(layers.indices.end(), {0, 1, 2, 3, 4, 5});
  if (count == 0) layers.indices = {0, 0, 0};
  FrameBuffer buffer({.width = 160, .height = 120});
  Frame frame(buffer);
  options.tile_size = tile_size;
  Renderer renderer(options);
  const long before = live_bytes;
  peak_live_bytes = before;
  for (int i = 0; i < 2; ++i) {
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    frame.draw(layers.view(), {.lighting = false});
    renderer.finish(frame);
  }
  return peak_live_bytes - before;
}

/// Bytes of each batch outside the budget (raster/bins.cpp): its first block; after an overflow the end and
/// the count of a list, and one derived primitive with its attributes.
constexpr long kUnbudgetedBytes = sizeof(Bins::Block) + 16 + sizeof(DerivedPrimitive) + 64 * sizeof(float);

TEST(BinMemory, LimitsTheBytesOfTheBins) {
  ThreadLimit limit(4);
  constexpr int kLayers = 2500;
  constexpr long kBatches = 2 * kLayers / 1024;
  for (const int threads : {1, 4})
    for (const int tile_size : {32, 128}) {
      SCOPED_TRACE(std::to_string(threads) + " threads, tiles of " + std::to_string(tile_size));
      const RendererOptions whole{.threads = threads};
      const long empty = peak_bytes(0, whole, tile_size);
      EXPECT_GT(peak_bytes(kLayers, whole, tile_size) - empty, 8 * static_cast<long>(kMinBinMemory))
          << "the frame needs several passes";
      EXPECT_LE(peak_bytes(kLayers, in_parts(whole), tile_size) - empty,
                static_cast<long>(kMinBinMemory) + kBatches * kUnbudgetedBytes);
    }
}

// 16 batches over 4,096 tiles take 16 bytes for the list of each tile, and 16 KB for the first blocks.
TEST(BinMemory, LimitsTheBytesOfManyTiles) {
  constexpr int kBatches = 16;
  MeshData triangles;
  triangles.positions = {0, 0, 0, 0.001f, 0, 0, 0, 0.001f, 0};
  for (int i = 0; i < 1024 * kBatches; ++i) triangles.indices.insert(triangles.indices.end(), {0, 1, 2});
  FrameBuffer buffer({.width = 2048, .height = 2048});
  Frame frame(buffer);
  const auto peak_bytes_with = [&](std::size_t bin_memory) {
    Renderer renderer({.tile_size = 32,
                       .elide = false,  // nothing reads the picture
                       .bin_memory = bin_memory,
                       .executor = std::make_shared<SingleThreadExecutor>(4)});
    frame.keep({});
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    frame.draw(triangles.view(), {.lighting = false});
    const long before = live_bytes;
    peak_live_bytes = before;
    renderer.finish(frame);
    return peak_live_bytes - before;
  };
  const long whole = peak_bytes_with(std::size_t{8} << 20);
  const long parts = peak_bytes_with(kMinBinMemory);
  EXPECT_GT(whole - parts,
            kBatches * (16 * 4096 + 16384 - kUnbudgetedBytes) - static_cast<long>(kMinBinMemory));
}

#endif

TEST(BinMemory, LimitMayBeTheWholeAddressSpace) {
  const RandomOperations scene({.width = 120, .height = 90});
  EXPECT_EQ(
      render(scene, {.threads = 1, .bin_memory = std::numeric_limits<std::size_t>::max()}).stats.bin_passes,
      1u);
}

TEST(BinMemory, DefaultsToAQuarterOfAGigabyte) {
  EXPECT_EQ(RendererOptions{}.bin_memory, std::size_t{256} << 20);
  EXPECT_EQ(Renderer({.threads = 1}).options().bin_memory, std::size_t{256} << 20);
}

// A bin size estimate that exceeded the limit is dropped after the frame.
TEST(BinMemory, FrameThatFitsIsRenderedInOnePassAfterOneInParts) {
  const BinOverflowScene large({.width = 60, .height = 50});
  const MeshData small = rectangle(-1, -1, 1, 1);
  Renderer renderer(in_parts({.threads = 1, .tile_size = 32}));
  FrameBuffer buffer(large.format);
  Frame frame(buffer);
  for (int round = 0; round < 3; ++round) {
    large.record(frame);
    EXPECT_GT(renderer.finish(frame).bin_passes, 1u);
    frame.draw(small.view(), unlit({1, 0, 0, 1}));
    EXPECT_EQ(renderer.finish(frame).bin_passes, 1u);
  }
}

TEST(BinMemory, LimitBelowTheMinimumIsAnError) {
  EXPECT_THAT(error_of([] { Renderer renderer({.bin_memory = 1000}); }).value_or(""),
              testing::AllOf(testing::HasSubstr("bin_memory is 1000"), testing::HasSubstr("65536")));
}

TEST(BinMemory, ProgressRisesToOneOverAllPasses) {
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
}  // namespace tessera::bin_memory_test
