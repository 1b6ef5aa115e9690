// Workloads that measure what leaving out an unnecessary effect saves.
#include <gtest/gtest.h>

#include "perf/bench/elision_workloads.h"

namespace tessera::bench::elision_workloads_test {
namespace {

TEST(ElisionWorkloads, HaveThePictureOfTheirBaseline) {
  const WorkloadSetup setup{.width = 96, .height = 64, .options = {.threads = 1}};
  int compared = 0;
  for (const WorkloadEntry& entry : elision_workloads()) {
    const std::unique_ptr<Workload> workload = entry.make(setup);
    EXPECT_EQ(workload->fault(), "") << entry.name;
    if (entry.baseline.empty()) continue;
    const WorkloadEntry* const baseline = find_workload(entry.baseline);
    ASSERT_NE(baseline, nullptr) << entry.name;
    const std::unique_ptr<Workload> elided = baseline->make(setup);
    EXPECT_EQ(elided->fault(), "") << baseline->name;
    EXPECT_EQ(workload->picture().rgba, elided->picture().rgba) << entry.name;
    ++compared;
  }
  EXPECT_GE(compared, 9);
}

}  // namespace
}  // namespace tessera::bench::elision_workloads_test
