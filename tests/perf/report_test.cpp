// What a report says of rows that were measured and of those that were not.
#include "perf/bench/report.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tessera::bench {
namespace {

const Row kTimed{.name = "timed", .threads = 2, .frames = 3, .ms = {.median = 2}, .work = {.pixels = 4000}};
const Row kFaulty{.name = "faulty", .threads = 2, .fault = "found \"black\", expected white"};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Report, NamesCountersOnlyWhereSomethingRan) {
  const std::string kNone = "hardware counters: the system gives none";
  EXPECT_FALSE(has(table_ending({.rows = {kFaulty}}), kNone));
  EXPECT_TRUE(has(table_ending({.rows = {kFaulty, kTimed}}), kNone));
  Row counted = kTimed;
  counted.counts = {.cycles = 3000000, .instructions = 6000000};
  const std::string text = table_ending({.rows = {kTimed, counted}});
  EXPECT_FALSE(has(text, kNone)) << text;
  EXPECT_TRUE(has(text, "3.00 million cycles a frame, 2.00 instructions a cycle")) << text;
}

TEST(Report, TablesForProgramsHaveFaultyRowsToo) {
  const std::string csv = report_csv({.rows = {kFaulty, kTimed}});
  EXPECT_TRUE(csv.starts_with("workload,threads,frames,median_ms,")) << csv;
  const auto columns = std::count(csv.begin(), csv.begin() + static_cast<std::ptrdiff_t>(csv.find('\n')), ',');
  EXPECT_TRUE(has(csv, ",instructions,fault\nfaulty,2,0" + std::string(static_cast<std::size_t>(columns) - 2, ',') + "\"found \"\"black\"\", expected white\"\ntimed,2,3,2,")) << csv;
  EXPECT_EQ(std::count(csv.begin() + static_cast<std::ptrdiff_t>(csv.find("timed")), csv.end(), ','), columns) << csv;
  EXPECT_TRUE(report_csv({}).ends_with(",fault\n"));
}

}  // namespace
}  // namespace tessera::bench
