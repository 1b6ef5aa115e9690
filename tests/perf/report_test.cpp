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
  EXPECT_FALSE(has(table_summary({.rows = {kFaulty}}), kNone));
  EXPECT_TRUE(has(table_summary({.rows = {kFaulty, kTimed}}), kNone));
  Row counted = kTimed;
  counted.counts = {.cycles = 3000000, .instructions = 6000000};
  const std::string text = table_summary({.rows = {kTimed, counted}});
  EXPECT_FALSE(has(text, kNone)) << text;
  EXPECT_TRUE(has(text, "3.00 million cycles a frame, 2.00 instructions a cycle")) << text;
}

TEST(Report, SaysWhatThereWasNoMemoryFor) {
  Row limited = kTimed;
  limited.work.roofline = Roofline::memory_copies;
  limited.work.roofline_bytes = 8000000;
  const Report without{.bandwidth = {.l1_stores = 90.5, .memory_loads_single_core = 7},
                       .rows = {kTimed, limited}};
  const std::string text = table_summary(without);
  EXPECT_TRUE(has(text, "stores in L1 90.5, of 64 KiB a thread (no memory), of a frame (no memory),"))
      << text;
  EXPECT_TRUE(has(text, "loads of 256 MiB (no memory) (by one core 7.0)\n")) << text;
  EXPECT_TRUE(text.ends_with("timed                  no memory for copies of as much\n")) << text;
  const nlohmann::ordered_json rates = report_json(without)["bandwidth_gigabytes_per_second"];
  EXPECT_EQ(rates, (nlohmann::ordered_json{{"l1_stores", 90.5}, {"memory_loads_single_core", 7.0}}));
  limited.roofline = 16;  // of which two milliseconds for 8 MB are a quarter
  const std::string share = table_summary({.rows = {limited}});
  EXPECT_TRUE(
      share.ends_with("timed                  moves 4.0 GB/s, 25 % of copies of as much (16.0 GB/s)\n"))
      << share;
}

TEST(Report, HoldsTilesAgainstTheirOwnStoresAndTheFirstCaches) {
  Row filled = kTimed;
  filled.work.roofline = Roofline::tile_stores;
  filled.work.roofline_bytes = 8000000;
  filled.roofline = 8;
  filled.l1_stores = 40;
  const std::string text = table_summary({.rows = {filled}});
  EXPECT_TRUE(
      text.ends_with("timed                  moves 4.0 GB/s, 50 % of stores of a tile's words (8.0 GB/s), 10 "
                     "% of stores in L1 (40.0 GB/s)\n"))
      << text;
  const nlohmann::ordered_json row = report_json({.rows = {filled}})["workloads"][0];
  EXPECT_EQ(row["roofline"], "stores of a tile's words");
  EXPECT_EQ(row["share_of_roofline"], 0.5);
  EXPECT_EQ(row["l1_stores_gigabytes_per_second"], 40);
  EXPECT_EQ(row["share_of_l1_stores"], 0.1);
  filled.l1_stores = 0;  // there was no memory for it
  EXPECT_TRUE(table_summary({.rows = {filled}}).ends_with("stores of a tile's words (8.0 GB/s)\n"));
}

TEST(Report, TablesForProgramsHaveFaultyRowsToo) {
  const std::string csv = report_csv(
                        {.width = 80, .height = 50, .instruction_set = "avx2", .rows = {kFaulty, kTimed}}),
                    kShared = ",80,50,avx2,0,1,,,\n";
  EXPECT_TRUE(csv.starts_with("workload,threads,frames,median_ms,")) << csv;
  const auto columns =
      std::count(csv.begin(), csv.begin() + static_cast<std::ptrdiff_t>(csv.find('\n')), ',');
  const std::string kSetting =
      ",fault,width,height,instruction_set,tile_size,seed,kept_on_cores,noise_low_ratio,noise_high_ratio\n";
  EXPECT_TRUE(has(csv, ",instructions" + kSetting + "faulty,2,0" +
                           std::string(static_cast<std::size_t>(columns) - 2 - 8, ',') +
                           "\"found \"\"black\"\", expected white\"" + kShared + "timed,2,3,2,"))
      << csv;
  EXPECT_EQ(std::count(csv.begin() + static_cast<std::ptrdiff_t>(csv.find("timed")), csv.end(), ','), columns)
      << csv;
  EXPECT_TRUE(csv.ends_with("," + kShared)) << csv;
  EXPECT_TRUE(report_csv({}).ends_with(kSetting));
}

TEST(Report, TablesForProgramsTellTheMachineInEachRow) {
  const std::string csv = report_csv({.machine = "CPU        a chip\ncaches     L1 48 KiB, L2 1 MiB\n\n",
                                      .width = 80,
                                      .height = 50,
                                      .instruction_set = "avx2",
                                      .tile_size = 64,
                                      .seed = 5,
                                      .cores = {0, 3},
                                      .rows = {kTimed, kTimed},
                                      .noise = Ratio{.value = 1, .low = 0.5, .high = 2}});
  EXPECT_TRUE(has(csv, ",noise_high_ratio,CPU,caches\ntimed,")) << csv;
  const std::string kMachine = ",80,50,avx2,64,5,0 3,0.5,2,a chip,\"L1 48 KiB, L2 1 MiB\"\n";
  EXPECT_TRUE(has(csv, kMachine + "timed,")) << csv;
  EXPECT_TRUE(csv.ends_with(kMachine)) << csv;
}

}  // namespace
}  // namespace tessera::bench
