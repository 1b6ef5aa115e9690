// greater_of() and lesser_of() against the scalar comparisons, bit for bit, including NaN and signed zeros.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "tests/raster/selection_lanes.h"

namespace tessera::test::selection_test {
namespace {

TEST(MinMaxLanes, MatchScalarForNanAndSignedZero) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const float values[] = {
      0.0f,      -0.0f,      1.0f, -1.0f, 0x1p-149f, -0x1p-149f, 0x1p-126f, 0x1.fffffep127f, -0x1.fffffep127f,
      kInfinity, -kInfinity, kNan, -kNan, 2.5f,      0.5f,       1e30f};
  std::vector<float> a, b;
  for (const float x : values)
    for (const float y : values) a.push_back(x), b.push_back(y);
  std::vector<float> greater(a.size()), lesser(a.size());
  for (const InstructionSet isa : available_isas()) {
    select(isa)(a.data(), b.data(), greater.data(), lesser.data(), a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(std::bit_cast<std::uint32_t>(greater[i]),
                std::bit_cast<std::uint32_t>(a[i] > b[i] ? a[i] : b[i]))
          << static_cast<int>(isa) << ": " << a[i] << ", " << b[i];
      EXPECT_EQ(std::bit_cast<std::uint32_t>(lesser[i]),
                std::bit_cast<std::uint32_t>(a[i] < b[i] ? a[i] : b[i]))
          << static_cast<int>(isa) << ": " << a[i] << ", " << b[i];
    }
  }
}

}  // namespace
}  // namespace tessera::test::selection_test
