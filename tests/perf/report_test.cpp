// Reports of rows that were measured and of rows that were not.
#include "perf/bench/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <sstream>

namespace tessera::bench::report_test {
namespace {

const Row kTimed{.name = "timed", .threads = 2, .frames = 3, .ms = {.median = 2}, .work = {.pixels = 4000}};
const Row kFaulty{.name = "faulty", .threads = 2, .fault = "found \"black\", expected white"};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(BenchReport, MentionsMissingCountersOnlyAfterTimedRows) {
  const std::string kNone = "hardware counters: not available";
  EXPECT_FALSE(has(table_summary({.rows = {kFaulty}}), kNone));
  EXPECT_TRUE(has(table_summary({.rows = {kFaulty, kTimed}}), kNone));
  Row counted = kTimed;
  counted.counts = {.cycles = 3000000, .instructions = 6000000};
  const std::string text = table_summary({.rows = {kTimed, counted}});
  EXPECT_FALSE(has(text, kNone)) << text;
  EXPECT_TRUE(has(text, "3.00 million cycles per frame, 2.00 instructions per cycle")) << text;
}

TEST(BenchReport, NamesMeasurementsWithoutMemory) {
  Row limited = kTimed;
  limited.work.roofline = Roofline::memory_copies;
  limited.work.roofline_bytes = 8000000;
  const Report without{.has_machine = true,
                       .bandwidth = {.l1_stores = 90.5, .memory_loads_single_core = 7},
                       .rows = {kTimed, limited}};
  const std::string text = table_summary(without);
  EXPECT_TRUE(has(
      text,
      "bandwidth, GB/s: L1 stores 90.5, stores of 64 KiB per thread (no memory), of one frame (no memory),"))
      << text;
  EXPECT_TRUE(has(text, "loads of 256 MiB (no memory) (one core: 7.0)\n")) << text;
  EXPECT_TRUE(text.ends_with("timed                  no memory to measure memory copies\n")) << text;
  const nlohmann::ordered_json rates = report_json(without)["bandwidth_gigabytes_per_second"];
  EXPECT_EQ(rates, (nlohmann::ordered_json{{"l1_stores", 90.5}, {"memory_loads_single_core", 7.0}}));
  limited.roofline = 16;  // GB/s; 8 MB in 2 ms are 4 GB/s
  const std::string share = table_summary({.has_machine = true, .rows = {limited}});
  EXPECT_TRUE(share.ends_with(
      "timed                  roofline traffic 4.0 GB/s, 25 % of memory copies (16.0 GB/s)\n"))
      << share;
}

TEST(BenchReport, ComparesTilesWithTileStoresAndL1Stores) {
  Row filled = kTimed;
  filled.work.roofline = Roofline::tile_stores;
  filled.work.roofline_bytes = 8000000;
  filled.roofline = 8;
  filled.l1_stores = 40;
  const std::string text = table_summary({.has_machine = true, .rows = {filled}});
  EXPECT_TRUE(text.ends_with(
      "timed                  roofline traffic 4.0 GB/s, 50 % of tile stores (8.0 GB/s), 10 % of L1 stores "
      "(40.0 GB/s)\n"))
      << text;
  const nlohmann::ordered_json row = report_json({.rows = {filled}})["workloads"][0];
  EXPECT_EQ(row["roofline"], "tile stores");
  EXPECT_EQ(row["share_of_roofline"], 0.5);
  EXPECT_EQ(row["l1_stores_gigabytes_per_second"], 40);
  EXPECT_EQ(row["share_of_l1_stores"], 0.1);
  filled.l1_stores = 0;  // no memory to measure it
  EXPECT_TRUE(table_summary({.has_machine = true, .rows = {filled}}).ends_with("tile stores (8.0 GB/s)\n"));
}

TEST(BenchReport, ShowsTheMachineOnlyIfItWasMeasured) {
  Row filled = kTimed;
  filled.work.roofline = Roofline::tile_stores;
  const Report report{.bandwidth = {.l1_stores = 90.5}, .rows = {filled}};
  const std::string text = table_summary(report);
  EXPECT_FALSE(has(text, "bandwidth")) << text;
  EXPECT_FALSE(has(text, "no memory to measure")) << text;
  EXPECT_FALSE(report_json(report).contains("bandwidth_gigabytes_per_second"));
}

TEST(BenchReport, ShowsHowMuchTheMachineVaried) {
  Row slow = kTimed;
  Row fast = kTimed;
  slow.reference_ms = 0.09;
  fast.reference_ms = 0.06;
  const std::string text = table_summary({.rows = {slow, kTimed, fast}});
  EXPECT_TRUE(has(text, "took 60.00 to 90.00 us in turns")) << text;
  EXPECT_TRUE(has(text, "varied by 50 %")) << text;
  EXPECT_FALSE(has(table_summary({.rows = {kTimed}}), "machine drift"));
  const nlohmann::ordered_json rows = report_json({.rows = {slow, kTimed}})["workloads"];
  EXPECT_EQ(rows[0]["reference_ms"], 0.09);
  EXPECT_FALSE(rows[1].contains("reference_ms"));
}

/// Headings of a table: its words are separated by two spaces or more, or are single words with units.
std::vector<std::string> words_of(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

TEST(BenchReport, ExplainsEveryColumn) {
  for (const auto& [heading, columns] : {std::pair(table_heading(), table_columns()),
                                         {comparison_heading(), comparison_columns()},
                                         {scaling_heading(2), scaling_columns()}})
    for (const std::string& word : words_of(heading)) {
      if (word == "workload" || word == "2" || std::isdigit(word.front()) != 0) continue;
      EXPECT_TRUE(has(columns, word)) << word << " in\n" << columns;
    }
  for (const std::string& columns : {table_columns(), comparison_columns(), scaling_columns()}) {
    EXPECT_TRUE(columns.starts_with("\n"));
    EXPECT_TRUE(columns.ends_with("\n"));
  }
}

// The table and --json have the same figures.
TEST(BenchReport, TableAndJsonAgree) {
  Row row = kTimed;
  row.peak_bytes = std::uint64_t{48} << 20;
  row.work.bytes = 6000000;
  EXPECT_TRUE(has(table_heading(), "peak MiB"));
  EXPECT_TRUE(has(table_line(row), " 48.0 ")) << table_line(row);
  EXPECT_TRUE(has(table_line(row), " 3 ")) << "GB/s: 6 MB in 2 ms";
  const nlohmann::ordered_json json = report_json({.rows = {row}})["workloads"][0];
  EXPECT_EQ(json["peak_mebibytes"], 48);
  EXPECT_DOUBLE_EQ(json["gigabytes_per_second"], 3);
}

TEST(BenchReport, ShowsRatiosToBaselines) {
  Row row = kTimed;
  row.to_baseline = {.baseline = "plain", .ratio = {.value = 1.5, .low = 1.25, .high = 2}};
  const std::string text = table_summary({.rows = {kTimed, row}});
  EXPECT_TRUE(has(text, "\ntimed / plain  ")) << text;
  EXPECT_TRUE(has(text, "   1.500  1.250 .. 2.000\n")) << text;
  EXPECT_FALSE(has(table_summary({.rows = {kTimed}}), "ratio"));
  const nlohmann::ordered_json rows = report_json({.rows = {kTimed, row}})["workloads"];
  EXPECT_FALSE(rows[0].contains("baseline"));
  EXPECT_FALSE(rows[0].contains("ratio_to_baseline"));
  EXPECT_EQ(rows[1]["baseline"], "plain");
  EXPECT_EQ(rows[1]["ratio_to_baseline"], 1.5);
  EXPECT_EQ(rows[1]["low_ratio_to_baseline"], 1.25);
  EXPECT_EQ(rows[1]["high_ratio_to_baseline"], 2);
}

TEST(BenchReport, CsvHasFaultyRows) {
  const std::string csv =
      report_csv({.width = 80, .height = 50, .instruction_set = "avx2", .rows = {kFaulty, kTimed}});
  const std::string kShared = ",80,50,avx2,0,1,,,\n";
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

TEST(BenchReport, CsvRepeatsTheMachineInEachRow) {
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
}  // namespace tessera::bench::report_test
