// Table and plot of --growth.
#include "perf/bench/growth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace tessera::bench::growth_test {
namespace {

using testing::HasSubstr;

// 1 ms, and 100 ns per draw.
std::vector<Growth> linear_growth() {
  Growth growth{.quantity = "draws", .description = "made up", .points = {}};
  for (const double count : {10.0, 1000.0, 100000.0}) growth.points.push_back({count, 1 + 1e-4 * count, 5});
  return {growth};
}

TEST(BenchGrowth, TabulatesCostPerAddedUnit) {
  std::istringstream table(growth_table(linear_growth()));
  std::string line;
  std::getline(table, line);  // empty
  std::getline(table, line);
  EXPECT_EQ(line, "draws: made up");
  std::getline(table, line);
  double count = 0;
  double ms = 0;
  double megabytes = 0;
  double ns_per_added = 0;
  ASSERT_TRUE(table >> count >> ms >> megabytes);
  EXPECT_EQ(count, 10);
  EXPECT_NEAR(ms, 1.001, 1e-3);
  for (int row = 1; row < 3; ++row) {
    ASSERT_TRUE(table >> count >> ms >> megabytes >> ns_per_added);
    EXPECT_NEAR(ns_per_added, 100, 0.1);
    EXPECT_EQ(megabytes, 5);
  }
  EXPECT_EQ(count, 100000);
}

// From 1000 to 100,000 draws time grows from 1.1 to 11 ms, by the square root, and memory in proportion.
TEST(BenchGrowth, SaysSlopesInWords) {
  std::vector<Growth> growth = linear_growth();
  growth[0].points.back().mebibytes = 500;
  const std::string table = growth_table(growth);
  EXPECT_THAT(table, HasSubstr("From 1000 to 100000 draws, twice the draws take 1.41 times the time and 2.00 "
                               "times the memory"));
  EXPECT_THAT(table, HasSubstr("each draw adds 5191.0 bytes")) << "495 MiB / 99,990";
  EXPECT_THAT(growth_table(linear_growth()), HasSubstr("Memory does not grow with the draws.\n"));
  for (const char* column : {"\nmedian ms ", "\npeak MiB ", "\nns, us per ... "})
    EXPECT_THAT(table, HasSubstr(column));
}

TEST(BenchGrowth, UsesMicrosecondsForLargeSteps) {
  EXPECT_THAT(growth_table(linear_growth()), HasSubstr("      ns per draw\n"));
  std::vector<Growth> growth = linear_growth();
  for (GrowthPoint& point : growth[0].points) point.ms *= 1000;
  const std::string table = growth_table(growth);
  EXPECT_THAT(table, HasSubstr("      us per draw\n"));
  EXPECT_THAT(table, HasSubstr("            100.0\n"));
}

TEST(BenchGrowth, PlotsTimeAndMemory) {
  const std::string svg = growth_svg(linear_growth());
  EXPECT_THAT(svg, testing::StartsWith("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 270 450'"));
  EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
  EXPECT_THAT(svg, HasSubstr("median ms, by draws"));
  EXPECT_THAT(svg, HasSubstr("peak MiB, by draws"));
  // The axis runs from 10 to 100 k: the second of the three points is in the middle of the panel.
  EXPECT_THAT(svg, HasSubstr("<circle cx='50.0' "));
  EXPECT_THAT(svg, HasSubstr("<circle cx='150.0' "));
  EXPECT_THAT(svg, HasSubstr("<circle cx='250.0' "));
  EXPECT_THAT(svg, HasSubstr(">100 k</text>"));
  EXPECT_THAT(svg, HasSubstr("class='linear'"));
  EXPECT_THAT(svg, HasSubstr("All axes are logarithmic."));
}

}  // namespace
}  // namespace tessera::bench::growth_test
