#include "perf/bench/cores.h"

#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::bench {
namespace {

TEST(Cores, KeepAThreadWhereItIsPut) {
  const std::vector<int> before = allowed_cores();
  ASSERT_FALSE(before.empty());
  if (!keep_on(before)) GTEST_SKIP() << "the system lets no thread choose its cores";
  std::thread([&] {
    EXPECT_TRUE(keep_on({&before.back(), 1}));
    EXPECT_EQ(allowed_cores(), std::vector<int>{before.back()});
    EXPECT_EQ(core_to_core_ns(), 0) << "there is no other core";
    EXPECT_FALSE(keep_on({}));
  }).join();
  EXPECT_EQ(allowed_cores(), before) << "of other threads";
}

// No cache answers another core within a nanosecond, and the slowest machines stay below a tenth of a
// millisecond.
TEST(Cores, TellHowFarApartTheyAre) {
  if (!keep_on(allowed_cores())) GTEST_SKIP() << "the system lets no thread choose its cores";
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
