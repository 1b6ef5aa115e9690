// Workers of simulated screens.
#include "engine/program/threads/loop_workers.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>

#include "framebuffer/tessera/screen.hpp"

namespace tessera::program::loop_workers_test {
namespace {

TEST(LoopWorkers, CallsEachWorkerOnce) {
  for (const int threads : {1, 2, 5}) {
    LoopWorkers workers(threads);
    const ScreenWorkers screen_workers(workers);
    ASSERT_EQ(screen_workers.count, threads);
    std::array<std::atomic<int>, 5> calls{};
    screen_workers.run(
        screen_workers.executor, threads,
        [](void* context, int k) {
          ++(*static_cast<std::array<std::atomic<int>, 5>*>(context))[static_cast<std::size_t>(k)];
        },
        &calls);
    for (int k = 0; k < 5; ++k) EXPECT_EQ(calls[static_cast<std::size_t>(k)], k < threads ? 1 : 0) << k;
  }
  EXPECT_EQ(LoopWorkers(0).workers(), available_cores());
}

}  // namespace
}  // namespace tessera::program::loop_workers_test
