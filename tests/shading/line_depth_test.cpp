// Depth keys along lines against integer arithmetic, in cases where all products are exact: a key is the
// integer part of its depth. Depth keys of points against those of lines.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

#include "tests/raster/tile_harness.h"
#include "tests/shading/line_depth_lanes.h"

namespace tessera::test::line_depth_test {
namespace {

struct ExactCase {
  int parameter_bits;       // parameters are multiples of 2^-parameter_bits
  std::uint32_t max_depth;  // upper bound of the depth words
};
constexpr ExactCase kCases[] = {{28, 1u << 20}, {28, 4}, {18, 0xffffffffu}};

TEST(LineDepth, IsTheIntegerPart) {
  std::mt19937 random(3);
  for (const DepthFormat kind : {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32})
    for (const auto& [parameter_bits, max_depth] : kCases)
      for (int round = 0; round < 2000; ++round) {
        const std::uint32_t z0 = random() % max_depth, z1 = random() % max_depth;
        std::vector<double> parameters;
        std::vector<std::int32_t> expected;
        const std::int64_t one = std::int64_t{1} << parameter_bits;
        const std::int64_t change = std::int64_t{z1} - z0;
        for (int i = 0; i < 16; ++i) {
          // Half of the parameters are adjacent to a step between 32-bit levels.
          const std::int64_t level_at =
              change == 0 ? 0
                          : (2 * (static_cast<std::int64_t>(random()) % std::abs(change)) + 1) * one /
                                (2 * std::abs(change));
          const std::int64_t n = std::min(
              one, i % 2 == 0 ? level_at + i % 4 / 2 : static_cast<std::int64_t>(random()) % (one + 1));
          parameters.push_back(static_cast<double>(n) / static_cast<double>(one));
          const std::int64_t depth = (std::int64_t{z0} << parameter_bits) + n * change;
          if (kind == DepthFormat::unorm32) {
            const std::int64_t rounded = (depth + one / 2) >> parameter_bits;
            expected.push_back(static_cast<std::int32_t>(rounded - (std::int64_t{1} << 31)));
          } else {
            const int dropped_bits = kind == DepthFormat::unorm24 ? 8 : 16;
            expected.push_back(static_cast<std::int32_t>(depth >> (parameter_bits + dropped_bits)));
          }
        }
        for (const InstructionSet isa : available_isas())
          ASSERT_EQ(line_keys(isa)(kind, z0, z1, parameters), expected)
              << name_of(isa) << ", depth words " << z0 << " to " << z1;
      }
}

// Depths at the ends of their range; offsets within the range, to its ends and far beyond.
TEST(LineDepth, MatchesAPointAtItsFirstVertex) {
  std::mt19937 random(5);
  const auto word = [&] { return static_cast<std::uint32_t>(random()) >> random() % 32; };
  for (const DepthFormat kind :
       {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32, DepthFormat::float32})
    for (int round = 0; round < 20000; ++round) {
      const bool is_float = kind == DepthFormat::float32;
      const std::uint32_t bits = round % 3 == 0 ? word() : ~word();
      const std::uint32_t z =
          is_float ? std::bit_cast<std::uint32_t>(static_cast<float>(bits) * 0x1p-32f) : bits;
      const double sizes[] = {0,      0.5,    1.5,    static_cast<double>(word()),
                              0x1p31, 0x1p32, 0x1p40, std::numeric_limits<double>::infinity()};
      const double offset =
          sizes[random() % std::size(sizes)] * (random() % 2 == 0 ? 1 : -1) * (is_float ? 0x1p-32 : 1);
      for (const InstructionSet isa : available_isas()) {
        const KeyPair keys = point_keys(isa)(kind, z, offset);
        ASSERT_EQ(keys.point, keys.line)
            << name_of(isa) << ", kind " << static_cast<int>(kind) << ", word " << z << ", offset " << offset;
      }
    }
}

}  // namespace
}  // namespace tessera::test::line_depth_test
