#include "perf/bench/cores.h"

#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::bench::cores_test {
namespace {

TEST(BenchCores, BindsThreadToOneCore) {
  const std::vector<int> before = allowed_cores();
  ASSERT_FALSE(before.empty());
  if (!set_thread_affinity(before)) GTEST_SKIP() << "the system does not permit thread affinity";
  std::thread([&] {
    EXPECT_TRUE(set_thread_affinity({&before.back(), 1}));
    EXPECT_EQ(allowed_cores(), std::vector<int>{before.back()});
    EXPECT_EQ(core_to_core_ns(), 0) << "only one core is allowed";
    EXPECT_FALSE(set_thread_affinity({}));
  }).join();
  EXPECT_EQ(allowed_cores(), before) << "other threads are not affected";
}

// No cache answers another core within 1 ns; even the slowest machines stay below 0.1 ms.
TEST(BenchCores, MeasuresPlausibleLatency) {
  if (!set_thread_affinity(allowed_cores())) GTEST_SKIP() << "the system does not permit thread affinity";
  const double ns = core_to_core_ns();
  if (allowed_cores().size() < 2) {
    EXPECT_EQ(ns, 0);
    return;
  }
  EXPECT_GT(ns, 1);
  EXPECT_LT(ns, 1e5);
}

}  // namespace
}  // namespace tessera::bench::cores_test
