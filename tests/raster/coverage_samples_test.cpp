// Coverage of samples is exact: the coverage of a sample equals that of the pixel centre for the triangle
// moved by the negative offset. The sample positions are repeated here, in 1/16 pixel as in the Direct3D 11
// specification.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "raster/sample_positions.h"
#include "tests/raster/random_triangles.h"
#include "tests/raster/tile_harness.h"

namespace tessera::test::coverage_samples_test {
using namespace detail;
namespace {

struct Sixteenths {
  int x, y;
};
constexpr Sixteenths kFour[] = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
constexpr Sixteenths kEight[] = {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};

Triangle moved(Triangle triangle, Sixteenths by) {
  for (WindowVertex& v : triangle) v.x -= 16 * by.x, v.y -= 16 * by.y;
  return triangle;
}

constexpr int kBits = 24;

// Triangles in one tile. Each is a separate draw that writes its own colour bit, so none hides another.
void compare_by_bits(std::uint32_t seed, int samples, int tile_size, int rounds, bool with_operations) {
  RandomTriangles source(seed, tile_size);
  TileHarness stage(tile_size, tile_size, tile_size);
  stage.frame().samples = samples;
  const FragmentOps operations{};
  std::vector<WindowVertex> vertices(3 * kBits);
  std::vector<Triangle> triangles(kBits);
  for (int round = 0; round < rounds; ++round) {
    stage.clear_draws();
    std::vector<std::uint32_t> expected[kMaxSamples];
    for (auto& sample : expected) sample.assign(static_cast<std::size_t>(tile_size * tile_size), 0);
    const PixelRect rect = round % 3 == 2
                               ? PixelRect{source.between(0, 9), source.between(0, 9),
                                           source.between(20, tile_size), source.between(20, tile_size)}
                               : PixelRect{0, 0, tile_size, tile_size};
    for (std::uint32_t bit = 0; bit < kBits; ++bit) {
      triangles[bit] = source.next();
      std::copy(triangles[bit].begin(), triangles[bit].end(), vertices.begin() + 3 * bit);
      TileDraw& draw = stage.add_draw(vertices.data() + 3 * bit);
      draw.rect = rect;
      draw.packed_color = 0xffffffu;
      draw.write_mask = 1u << bit;
      if (with_operations) {
        draw.ops = &operations;
        draw.id_output = TileDraw::IdOutput::draw;
      }
      if (reference_of(triangles[bit]).area == 0) continue;  // dropped by binning
      stage.push(0, bit, 0);
      for (int s = 0; s < samples; ++s)
        reference_of(moved(triangles[bit], (samples == 4 ? kFour : kEight)[s]))
            .for_each_covered(rect.x0, rect.y0, rect.x1, rect.y1, [&](int x, int y) {
              expected[s][static_cast<std::size_t>(y * tile_size + x)] |= 1u << bit;
            });
    }
    for (const InstructionSet isa : available_isas()) {
      stage.render(isa, 0);
      for (int s = 0; s < samples; ++s)
        for (int y = 0; y < tile_size; ++y)
          for (int x = 0; x < tile_size; ++x) {
            const std::uint32_t wrong =
                stage.sample_color(s, x, y) ^ expected[s][static_cast<std::size_t>(y * tile_size + x)];
            ASSERT_EQ(wrong, 0u) << name_of(isa) << ", tile of " << tile_size << ", round " << round
                                 << ", sample " << s << " of pixel " << x << " " << y << ", triangle "
                                 << Describe{triangles[static_cast<std::size_t>(std::countr_zero(wrong))]};
          }
    }
  }
}

int rounds_of_24(int normal) { return long_tests() ? normal * 33 : normal; }

TEST(CoverageOfSamples, FourSamplesMatchExactIntegers) {
  compare_by_bits(11, 4, 64, rounds_of_24(60), false);
}
TEST(CoverageOfSamples, EightSamplesMatchExactIntegers) {
  compare_by_bits(12, 8, 64, rounds_of_24(40), false);
}
TEST(CoverageOfSamples, MatchesExactIntegersInTilesOf32) {
  compare_by_bits(13, 8, 32, rounds_of_24(60), false);
}
TEST(CoverageOfSamples, MatchesExactIntegersInTilesOf128) {
  compare_by_bits(14, 4, 128, rounds_of_24(15), false);
}
TEST(CoverageOfSamples, MatchesExactIntegersInDrawsWithFragmentOps) {
  compare_by_bits(15, 4, 64, rounds_of_24(50), true);
  compare_by_bits(16, 8, 32, rounds_of_24(50), true);
}

}  // namespace
}  // namespace tessera::test::coverage_samples_test
