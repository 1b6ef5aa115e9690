// Bounds of vertices on every instruction set, against the scalar twin.
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "raster/vertex_bounds.h"

namespace tessera::detail::vertex_bounds_test {
namespace {

TEST(VertexBounds, EqualThoseOfTheScalarTwin) {
  std::mt19937 random(1);
  for (const InstructionSet isa : available_isas())
    for (const std::size_t stride : {3, 4, 8})
      for (std::size_t count = 1; count < 40; ++count) {
        // Exactly as long as the records: a sanitizer would find a read beyond the last one.
        std::vector<float> values((count - 1) * stride + 3);
        for (float& value : values)
          value = static_cast<float>(static_cast<std::int32_t>(random())) * 0x1p-20f;
        FloatBox found, expected;
        const StridedFloats records{values.data(), stride};
        EXPECT_TRUE(find_bounds(isa)(records, count, found));
        EXPECT_TRUE(find_bounds_reference(records, count, expected));
        EXPECT_EQ(found.low, expected.low) << count;
        EXPECT_EQ(found.high, expected.high) << count;
      }
}

TEST(VertexBounds, FindValuesThatAreNotFinite) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const InstructionSet isa : available_isas())
    for (const float bad : {kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()})
      for (std::size_t at = 0; at < 20; ++at) {
        std::vector<float> values(5 * 4, 1.0f);
        values[at] = bad;
        FloatBox box;
        const StridedFloats records{values.data(), 4};
        const bool is_fourth = at % 4 == 3;  // not a part of the vectors
        EXPECT_EQ(find_bounds(isa)(records, 5, box), is_fourth) << at;
        EXPECT_EQ(find_bounds_reference(records, 5, box), is_fourth) << at;
      }
}

}  // namespace
}  // namespace tessera::detail::vertex_bounds_test
