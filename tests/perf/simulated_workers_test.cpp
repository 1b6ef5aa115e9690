#include "perf/bench/simulated_workers.h"

#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::bench {
namespace {

struct Seen {
  std::vector<int> workers;
  std::vector<std::thread::id> threads;
};

Seen run_twice(SimulatedWorkers& workers) {
  Seen seen;
  const auto note = [](void* context, int worker) {
    auto& s = *static_cast<Seen*>(context);
    s.workers.push_back(worker);
    s.threads.push_back(std::this_thread::get_id());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  workers.run(3, note, &seen);
  workers.run(2, note, &seen);
  return seen;
}

void expect_one_by_one(SimulatedWorkers& workers, bool on_caller) {
  EXPECT_EQ(workers.workers(), 64);
  const Seen seen = run_twice(workers);
  EXPECT_EQ(seen.workers, (std::vector<int>{0, 1, 2, 0, 1}));
  for (const std::thread::id thread : seen.threads) {
    EXPECT_EQ(thread, seen.threads.front());
    EXPECT_EQ(thread == std::this_thread::get_id(), on_caller);
  }
  EXPECT_GE(workers.take_seconds(), 5e-3);
  EXPECT_EQ(workers.take_seconds(), 0);
  EXPECT_EQ(workers.take_calls(), 2);
  EXPECT_EQ(workers.take_calls(), 0);
}

TEST(SimulatedWorkers, RunOneByOneOnTheCaller) {
  WorkersOnCallingThread workers(64);
  expect_one_by_one(workers, true);
}

TEST(SimulatedWorkers, RunOneByOneElsewhere) {
  WorkersOnOtherCore workers(64, allowed_cores().back(), 1 << 16);
  expect_one_by_one(workers, false);
}

TEST(SimulatedWorkers, MayNeverRun) { WorkersOnOtherCore(64, allowed_cores().back(), 0); }

}  // namespace
}  // namespace tessera::bench
