// The table and the plot of how frames grow.
#include "perf/bench/growth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace tessera::bench {
namespace {

using testing::HasSubstr;

// 1 ms and 100 ns for each.
std::vector<Growth> made_up() {
  Growth growth{.of = "draws", .what = "made up", .points = {}};
  for (const double count : {10.0, 1000.0, 100000.0}) growth.points.push_back({count, 1 + 1e-4 * count, 5});
  return {growth};
}

TEST(BenchGrowth, IsATableWithWhatOneMoreCosts) {
  std::istringstream table(growth_table(made_up()));
  std::string line;
  std::getline(table, line);  // empty
  std::getline(table, line);
  EXPECT_EQ(line, "draws: made up");
  std::getline(table, line);
  double count = 0, ms = 0, megabytes = 0, each = 0;
  ASSERT_TRUE(table >> count >> ms >> megabytes);
  EXPECT_EQ(count, 10);
  EXPECT_NEAR(ms, 1.001, 1e-3);
  for (int more = 0; more < 2; ++more) {
    ASSERT_TRUE(table >> count >> ms >> megabytes >> each);
    EXPECT_NEAR(each, 100, 0.1);
    EXPECT_EQ(megabytes, 5);
  }
  EXPECT_EQ(count, 100000);
}

TEST(BenchGrowth, IsAPlotOfTimeAndMemory) {
  const std::string svg = growth_svg(made_up());
  EXPECT_THAT(svg, testing::StartsWith("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 270 430'"));
  EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
  EXPECT_THAT(svg, HasSubstr("ms a frame, by draws"));
  EXPECT_THAT(svg, HasSubstr("peak MB, by draws"));
  // Across from 10 to 100 k: the second of three points is in the middle of the panel.
  EXPECT_THAT(svg, HasSubstr("<circle cx='50.0' "));
  EXPECT_THAT(svg, HasSubstr("<circle cx='150.0' "));
  EXPECT_THAT(svg, HasSubstr("<circle cx='250.0' "));
  EXPECT_THAT(svg, HasSubstr(">100 k</text>"));
}

}  // namespace
}  // namespace tessera::bench
