#include "perf/bench/simulated_workers.h"

#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::bench::simulated_workers_test {
namespace {

struct Calls {
  std::vector<int> workers;
  std::vector<std::thread::id> threads;
};

Calls run_twice(SimulatedWorkers& workers) {
  Calls calls;
  const auto log = [](void* context, int worker) {
    auto& c = *static_cast<Calls*>(context);
    c.workers.push_back(worker);
    c.threads.push_back(std::this_thread::get_id());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  workers.run(3, log, &calls);
  workers.run(2, log, &calls);
  return calls;
}

void expect_serial(SimulatedWorkers& workers, bool on_caller) {
  EXPECT_EQ(workers.workers(), 64);
  const Calls calls = run_twice(workers);
  EXPECT_EQ(calls.workers, (std::vector<int>{0, 1, 2, 0, 1}));
  for (const std::thread::id thread : calls.threads) {
    EXPECT_EQ(thread, calls.threads.front());
    EXPECT_EQ(thread == std::this_thread::get_id(), on_caller);
  }
  EXPECT_GE(workers.take_seconds(), 5e-3);
  EXPECT_EQ(workers.take_seconds(), 0);
  EXPECT_EQ(workers.take_calls(), 2);
  EXPECT_EQ(workers.take_calls(), 0);
}

TEST(BenchSimulatedWorkers, RunsSeriallyOnTheCallingThread) {
  WorkersOnCallingThread workers(64);
  expect_serial(workers, true);
}

TEST(BenchSimulatedWorkers, RunsSeriallyOnAnotherThread) {
  WorkersOnOtherCore workers(64, allowed_cores().back(), 1 << 16);
  expect_serial(workers, false);
}

TEST(BenchSimulatedWorkers, EndsWithoutHavingRun) { WorkersOnOtherCore(64, allowed_cores().back(), 0); }

}  // namespace
}  // namespace tessera::bench::simulated_workers_test
