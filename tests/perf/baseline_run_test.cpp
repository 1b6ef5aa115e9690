// Comparison with the file of an earlier run, new and old.
#include "perf/bench/baseline_run.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace tessera::bench::baseline_run_test {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Row timed(const std::string& name, double ms) {
  return {.name = name,
          .threads = 1,
          .frames = 100,
          .ms = {.median = ms,
                 .low_quartile = 0.99 * ms,
                 .high_quartile = 1.01 * ms,
                 .percentile_5 = 0.98 * ms,
                 .percentile_95 = 1.2 * ms,
                 .percentile_99 = 1.3 * ms,
                 .min = 0.95 * ms},
          .work = {.pixels = 1000},
          .reference_ms = 0.06};
}

Report report_of(std::vector<Row> rows) {
  return {.width = 80, .height = 50, .threads = 1, .instruction_set = "avx2", .rows = std::move(rows)};
}

class BenchBaselineRun : public testing::Test {
 protected:
  ~BenchBaselineRun() override { std::filesystem::remove(file_); }
  BaselineRun earlier(const nlohmann::ordered_json& report) {
    std::ofstream(file_) << report.dump();
    return BaselineRun(file_);
  }
  BaselineComparison compared(const BaselineRun& run, Row now) {
    now.earlier_over_now = run.ratio_to(now);
    return run.compare(report_of({now}), 0.1);
  }
  std::string file_ = (std::filesystem::temp_directory_path() /
                       ("tessera_baseline_run_test_" + std::to_string(::getpid()) + ".json"))
                          .string();
};

TEST_F(BenchBaselineRun, ReadsWhatTheIntervalNeeds) {
  const BaselineRun run = earlier(report_json(report_of({timed("row", 10)})));
  const std::optional<Ratio> ratio = run.ratio_to(timed("row", 5));
  ASSERT_TRUE(ratio.has_value());
  EXPECT_NEAR(ratio->value, 2, 1e-9);
  EXPECT_NEAR(ratio->low, 2 * 0.98 / 1.01, 1e-9);
  EXPECT_NEAR(ratio->high, 2 * 1.01 / 0.98, 1e-9);
  EXPECT_FALSE(run.ratio_to(timed("another", 5)).has_value());
  Row untimed = timed("row", 5);
  untimed.frames = 0;
  EXPECT_FALSE(run.ratio_to(untimed).has_value());
}

TEST_F(BenchBaselineRun, CallsARowSlowerBeyondItsInterval) {
  const BaselineRun run = earlier(report_json(report_of({timed("row", 10)})));
  const BaselineComparison slower = compared(run, timed("row", 13));
  EXPECT_TRUE(slower.has_regressed);
  EXPECT_TRUE(has(slower.table, "  slower\n")) << slower.table;
  EXPECT_TRUE(slower.table.ends_with("\n1 row is slower: exit code 3\n")) << slower.table;
  EXPECT_TRUE(has(slower.table, "  0.746 .. 0.793")) << slower.table;
  EXPECT_FALSE(has(slower.table, "no reference times")) << slower.table;
  // 12 % longer is beyond the limit, but the interval is not.
  const BaselineComparison unsure = compared(run, timed("row", 11.2));
  EXPECT_FALSE(unsure.has_regressed) << unsure.table;
  EXPECT_TRUE(has(unsure.table, "  unsure\n")) << unsure.table;
  EXPECT_TRUE(unsure.table.ends_with("\nno row is slower: exit code 0\n")) << unsure.table;
  EXPECT_TRUE(has(compared(run, timed("row", 10)).table, "  same\n"));
  EXPECT_TRUE(has(compared(run, timed("row", 8)).table, "  faster\n"));
  Row drifted = timed("row", 13);
  drifted.reference_ms *= 1.25;
  EXPECT_FALSE(compared(run, drifted).has_regressed) << "the machine is slower now";
  for (const char* line :
       {"earlier, ms; now, ms ", "earlier/now ", "interval ", "slower ", "faster ", "same ", "unsure "})
    EXPECT_TRUE(has(slower.table, std::string("\n") + line)) << line << "\n" << slower.table;
}

TEST_F(BenchBaselineRun, ComparesFilesOfOlderVersionsByAWiderRule) {
  nlohmann::ordered_json old = report_json(report_of({timed("row", 10)}));
  old["workloads"][0].erase("percentile_5_ms");
  old["workloads"][0].erase("reference_ms");
  const BaselineRun run = earlier(old);
  const std::optional<Ratio> ratio = run.ratio_to(timed("row", 10));
  ASSERT_TRUE(ratio.has_value());
  EXPECT_NEAR(ratio->low, 0.95 / 1.01 / kUnknownDrift, 1e-9) << "minimum";
  EXPECT_NEAR(ratio->high, 1.2 / 0.98 * kUnknownDrift, 1e-9) << "95th percentile";
  const BaselineComparison comparison = compared(run, timed("row", 15));
  EXPECT_FALSE(comparison.has_regressed) << comparison.table;
  EXPECT_TRUE(has(comparison.table, "has no reference times")) << comparison.table;
  EXPECT_TRUE(compared(run, timed("row", 20)).has_regressed);
}

TEST_F(BenchBaselineRun, SaysHowOftenARowWasMeasured) {
  const BaselineRun run = earlier(report_json(report_of({timed("row", 10)})));
  Row now = timed("row", 13);
  now.confirmations = 2;
  EXPECT_TRUE(has(compared(run, now).table, "  slower (measured 3 times)\n"));
}

}  // namespace
}  // namespace tessera::bench::baseline_run_test
