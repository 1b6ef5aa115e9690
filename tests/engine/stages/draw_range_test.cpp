#include "engine/stages/draw_range.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::draw_range_test {
using namespace detail;
namespace {

TEST(DrawRanges, CoverEachDrawInOrder) {
  const std::vector<std::size_t> counts{0, 5, 4, 0, 0, 9, 1, 8, 0};
  DrawRanges ranges;
  for (const std::size_t each : {std::size_t{1}, std::size_t{3}, std::size_t{4}, std::size_t{100}}) {
    SCOPED_TRACE(each);
    ranges.split(
        counts.size(), [&](std::size_t draw) { return counts[draw]; }, each);
    std::size_t i = 0;
    for (std::size_t draw = 0; draw < counts.size(); ++draw)
      for (std::size_t first = 0; first < counts[draw]; first += each, ++i) {
        ASSERT_LT(i, ranges.size());
        const DrawRange range = ranges[i];
        EXPECT_EQ(range.draw, draw);
        EXPECT_EQ(range.first, first);
        EXPECT_EQ(range.last, std::min(counts[draw], first + each));
      }
    EXPECT_EQ(i, ranges.size());
  }
  ranges.split(
      3, [](std::size_t) { return std::size_t{0}; }, 4);
  EXPECT_EQ(ranges.size(), 0u);
}

}  // namespace
}  // namespace tessera::draw_range_test
