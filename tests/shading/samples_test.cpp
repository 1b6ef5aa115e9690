// Multisampled pixels: their colour is the mean of the samples' levels, on every pixel path.
#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "raster/sample_positions.h"
#include "shading/resolve_reference.h"
#include "tests/raster/random_triangles.h"
#include "tests/raster/tile_harness.h"

namespace tessera::test::samples_test {
using namespace detail;
namespace {

constexpr int kTile = 32;

TEST(SampleResolve, IsTheMeanOfTheLevels) {
  RandomTriangles source(21, kTile);
  for (int bits = 1; bits <= 24; ++bits)
    for (const int alpha : {0, 8})
      for (const int samples : {4, 8}) {
        TileHarness stage(kTile, kTile, kTile);
        stage.frame().layout = rgb_layout(bits);
        stage.frame().layout.alpha_bits = alpha;
        stage.frame().samples = samples;
        std::vector<Triangle> triangles;
        for (int i = 0; i < 60; ++i)
          triangles.push_back(source.next(i % 2 == 0 ? Shape::medium : Shape::tiny));
        for (const Triangle& triangle : triangles) {
          TileDraw& draw = stage.add_draw(triangle.data());
          draw.packed_color = static_cast<std::uint32_t>(source.random()());
          if (reference_of(triangle).area != 0) stage.push(0, stage.draw_count() - 1, 0);
        }
        for (const InstructionSet isa : available_isas()) {
          stage.render(isa, 0, 0x87654321u);
          const ColorLayout& layout = stage.frame().layout;
          const std::uint32_t mask = layout.value_mask() | layout.alpha_mask();
          for (int y = 0; y < kTile; ++y)
            for (int x = 0; x < kTile; ++x) {
              std::uint32_t packed[kMaxSamples];
              for (int s = 0; s < samples; ++s) packed[s] = stage.sample_color(s, x, y);
              ASSERT_EQ(stage.color(x, y) & mask, resolve_reference(layout, packed, samples))
                  << name_of(isa) << ", " << bits << " bits, " << alpha << " of alpha";
            }
        }
      }
}

// The scalar twin against results by hand: halves round up, and components do not carry into each other.
TEST(SampleResolve, MeanRoundsHalvesUp) {
  const std::uint32_t packed[8] = {0xff0000, 0xff0001, 0xff0101, 0xff01ff, 0, 0, 0, 0};
  // Green 2/4 becomes 1, blue is (1 + 1 + 255)/4 = 64.25.
  EXPECT_EQ(resolve_reference(rgb_layout(24), packed, 4), 0xff0140u);
  // Red is 127.5, green 0.25, blue 32.125.
  EXPECT_EQ(resolve_reference(rgb_layout(24), packed, 8), 0x800020u);
  const std::uint32_t greys[4] = {0, 1, 1, 0};
  EXPECT_EQ(resolve_reference(rgb_layout(1), greys, 4), 1u);
}

// Shading modes of draws with interpolated colours. `mixed`: only the second draw is immediate.
enum class ShadingMode { deferred, deferred_by_group, immediate, mixed, with_operations };
constexpr ShadingMode kModes[] = {ShadingMode::deferred, ShadingMode::deferred_by_group,
                                  ShadingMode::immediate, ShadingMode::mixed, ShadingMode::with_operations};
constexpr const char* kModeNames[] = {"deferred", "deferred, group by group", "immediate",
                                      "immediate between deferred draws", "with operations"};

constexpr std::int32_t kFarthest = std::numeric_limits<std::int32_t>::max();
constexpr std::uint32_t kTriangles = 51;
constexpr std::uint32_t kDraws = 3;

std::uint32_t depth_word(DepthFormat format, std::uint32_t random) {
  if (format == DepthFormat::float32)
    return std::bit_cast<std::uint32_t>(static_cast<float>(random >> 8) * 0x1p-24f);
  if (format == DepthFormat::unorm32) return random;
  return (random & 0xffff0000u) | 0x8000u;
}

Shape shape_of(std::uint32_t triangle, bool wide) {
  if (wide) return Shape::edges64;
  if (triangle % 3 == 0) return Shape::large;
  return triangle % 3 == 1 ? Shape::medium : Shape::tiny;
}

/// Three draws of random intersecting triangles under perspective, with front and back colours.
struct InterpolatedDraws {
  std::vector<WindowVertex> vertices;
  std::vector<float> colors;
  std::vector<std::uint32_t> visible;
  bool uses_depth = true;
  Compare depth_test = Compare::less;
  PixelRect rect{0, 0, kTile, kTile};

  InterpolatedDraws(RandomTriangles& source, int round, DepthFormat depth_format) {
    for (std::uint32_t i = 0; i < kTriangles; ++i) {
      const bool wide = round % 3 == 2 && i % 13 == 0;
      const Triangle triangle = source.next(shape_of(i, wide));
      if (reference_of(triangle).area != 0) visible.push_back(i);
      for (WindowVertex v : triangle) {
        v.z = depth_word(depth_format, static_cast<std::uint32_t>(source.random()()));
        v.rw = 0.5f + static_cast<float>(source.unit());
        vertices.push_back(v);
        for (int c = 0; c < 8; ++c) colors.push_back(static_cast<float>(source.unit()));
      }
    }
    colors.resize(colors.size() + 64);
    if (round % 4 == 1) uses_depth = false;
    if (round % 4 == 2) depth_test = Compare::notequal;
    if (round % 5 >= 3)
      rect = {source.between(0, 9), source.between(0, 9), source.between(20, kTile),
              source.between(20, kTile)};
  }

  void add_to(TileHarness& stage, ShadingMode mode, const FragmentOps& operations) const {
    stage.clear_draws();
    for (std::uint32_t d = 0; d < kDraws; ++d) {
      TileDraw& draw = stage.add_draw(vertices.data());
      draw.source = ColorSource::interpolated;
      draw.scaled_colors = false;
      draw.uses_depth = uses_depth;
      draw.depth_test = depth_test;
      draw.rect = rect;
      draw.attributes = colors.data();
      draw.attribute_stride = draw.attribute_count = 8;
      draw.color_attribute[1] = 4;
      draw.deferred = mode == ShadingMode::deferred || mode == ShadingMode::deferred_by_group ||
                      (mode == ShadingMode::mixed && d != 1);
      draw.ops = mode == ShadingMode::with_operations ? &operations : nullptr;
    }
    stage.frame().shade_immediately = mode == ShadingMode::deferred_by_group;
    for (const std::uint32_t id : visible) stage.push(0, id / (kTriangles / kDraws), id);
  }
};

class SampledColors : public testing::TestWithParam<DepthFormat> {};

TEST_P(SampledColors, DoNotDependOnWhenTheyAreShaded) {
  RandomTriangles source(22, kTile);
  const FragmentOps operations{};
  for (const int samples : {4, 8}) {
    TileHarness stage(kTile, kTile, kTile, GetParam());
    stage.frame().samples = samples;
    for (int round = 0; round < 60; ++round) {
      const InterpolatedDraws draws(source, round, GetParam());
      std::vector<std::uint32_t> first;
      for (const InstructionSet isa : available_isas()) {
        std::map<ShadingMode, std::uint64_t> shaded;
        for (const ShadingMode mode : kModes) {
          draws.add_to(stage, mode, operations);
          shaded[mode] = stage.render(isa, 0, 0x102030, kFarthest).shaded_pixels;
          std::vector<std::uint32_t> colors;
          for (int s = 0; s < samples; ++s)
            for (int y = 0; y < kTile; ++y)
              for (int x = 0; x < kTile; ++x) colors.push_back(stage.sample_color(s, x, y));
          if (first.empty()) first = colors;
          ASSERT_EQ(colors, first) << name_of(isa) << ", round " << round << ": "
                                   << kModeNames[static_cast<int>(mode)];
        }
        ASSERT_EQ(shaded[ShadingMode::immediate], shaded[ShadingMode::with_operations])
            << name_of(isa) << ", round " << round;
        ASSERT_LE(shaded[ShadingMode::deferred], shaded[ShadingMode::immediate])
            << name_of(isa) << ", round " << round;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, SampledColors,
                         testing::Values(DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32,
                                         DepthFormat::float32),
                         [](const auto& kind) {
                           return (kind.param == DepthFormat::float32 ? "float" : "unorm") +
                                  std::to_string(depth_bits(kind.param));
                         });

}  // namespace
}  // namespace tessera::test::samples_test
