// Workloads that measure the cost of single fragment operations.
#include "perf/bench/operation_workloads.h"

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "perf/bench/drawn_workload.h"

namespace tessera::bench::operation_workloads_test {
namespace {

TEST(BenchOperations, HasExpectedEffectOnThePicture) {
  const std::vector<WorkloadEntry> entries = operation_workloads();
  EXPECT_EQ(entries.size(), 11u);
  for (const WorkloadEntry& entry : entries) {
    const std::unique_ptr<Workload> workload =
        entry.make({.width = 160, .height = 90, .options = {.threads = 1}});
    EXPECT_EQ(workload->fault(), "") << entry.name;
    EXPECT_GT(workload->work(workload->draw()).fragments, 0u) << entry.name;
  }
}

TEST(BenchOperations, ComparesWithTheTeapotWithoutOperation) {
  for (const WorkloadEntry& entry : operation_workloads()) {
    EXPECT_EQ(entry.baseline, entry.name == "operation-none" ? "" : "operation-none") << entry.name;
    EXPECT_FALSE(entry.is_in_mean) << entry.name;
    EXPECT_EQ(find_workload(entry.name)->description, entry.description);
    EXPECT_FALSE(entry.gl_workload({}).has_value()) << entry.name;
  }
  EXPECT_EQ(find_workload("operation"), nullptr) << "a prefix is not a name";
}

}  // namespace
}  // namespace tessera::bench::operation_workloads_test
