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
  const std::string csv = report_csv({.width = 80, .height = 50, .instruction_set = "avx2", .rows = {kFaulty, kTimed}}), kShared = ",80,50,avx2,0,1,,,\n";
  EXPECT_TRUE(csv.starts_with("workload,threads,frames,median_ms,")) << csv;
  const auto columns = std::count(csv.begin(), csv.begin() + static_cast<std::ptrdiff_t>(csv.find('\n')), ',');
  const std::string kSetting = ",fault,width,height,instruction_set,tile_size,seed,kept_on_cores,noise_low_ratio,noise_high_ratio\n";
  EXPECT_TRUE(has(csv, ",instructions" + kSetting + "faulty,2,0" + std::string(static_cast<std::size_t>(columns) - 2 - 8, ',') + "\"found \"\"black\"\", expected white\"" + kShared + "timed,2,3,2,")) << csv;
  EXPECT_EQ(std::count(csv.begin() + static_cast<std::ptrdiff_t>(csv.find("timed")), csv.end(), ','), columns) << csv;
  EXPECT_TRUE(csv.ends_with("," + kShared)) << csv;
  EXPECT_TRUE(report_csv({}).ends_with(kSetting));
}

TEST(Report, TablesForProgramsTellTheMachineInEachRow) {
  const std::string csv = report_csv({.machine = "CPU        a chip\ncaches     L1 48 KiB, L2 1 MiB\n\n", .width = 80, .height = 50, .instruction_set = "avx2", .tile_size = 64, .seed = 5, .cores = {0, 3}, .rows = {kTimed, kTimed}, .noise = Ratio{.value = 1, .low = 0.5, .high = 2}});
  EXPECT_TRUE(has(csv, ",noise_high_ratio,CPU,caches\ntimed,")) << csv;
  const std::string kMachine = ",80,50,avx2,64,5,0 3,0.5,2,a chip,\"L1 48 KiB, L2 1 MiB\"\n";
  EXPECT_TRUE(has(csv, kMachine + "timed,")) << csv;
  EXPECT_TRUE(csv.ends_with(kMachine)) << csv;
}

}  // namespace
}  // namespace tessera::bench
