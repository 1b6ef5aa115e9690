#include "perf/bench/cores.h"

#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::bench {
namespace {

TEST(Cores, KeepAThreadWhereItIsPut) {
  const std::vector<int> before = allowed_cores();
  ASSERT_FALSE(before.empty());
  if (!set_thread_affinity(before)) GTEST_SKIP() << "the system lets no thread choose its cores";
  std::thread([&] {
    EXPECT_TRUE(set_thread_affinity({&before.back(), 1}));
    EXPECT_EQ(allowed_cores(), std::vector<int>{before.back()});
    EXPECT_EQ(core_to_core_ns(), 0) << "there is no other core";
    EXPECT_FALSE(set_thread_affinity({}));
  }).join();
  EXPECT_EQ(allowed_cores(), before) << "of other threads";
}

// No cache answers another core within a nanosecond, and the slowest machines stay below a tenth of a
// millisecond.
TEST(Cores, TellHowFarApartTheyAre) {
  if (!set_thread_affinity(allowed_cores())) GTEST_SKIP() << "the system lets no thread choose its cores";
  const double ns = core_to_core_ns();
  if (allowed_cores().size() < 2) {
    EXPECT_EQ(ns, 0);
    return;
  }
  EXPECT_GT(ns, 1);
  EXPECT_LT(ns, 1e5);
}

}  // namespace
}  // namespace tessera::bench
