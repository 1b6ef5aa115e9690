// Tasks run once each, on the requested number of workers, in the default floating-point mode.
#include "engine/runtime/worker_pool.h"
#include "engine/program/threads/thread_limit.h"
#include "engine/runtime/floating_point_mode.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "tests/engine/runtime/test_executors.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace tessera::worker_pool_test {
using namespace detail;
using namespace program;
namespace {

void spin(std::chrono::microseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < end) {}
}

TEST(WorkerPool, EightThreadsAreEightDistinctWorkers) {
  const ThreadLimit limit(8);
  WorkerPool worker_pool(8);
  ASSERT_EQ(worker_pool.threads(), 8);
  int workers_seen = 0;
  for (int round = 0; round < 50 && workers_seen < 8; ++round) {  // workers need a moment to start
    worker_pool.for_each(400, [](std::size_t, int) { spin(std::chrono::microseconds(200)); });
    workers_seen = worker_pool.distinct_workers_seen();
  }
  EXPECT_EQ(workers_seen, 8);
  EXPECT_EQ(worker_pool.distinct_workers_seen(), 0) << "reading the count resets it";
}

TEST(WorkerPool, EachTaskRunsOnceForAnyNumberOfThreads) {
  const ThreadLimit limit(8);
  for (const int threads : {1, 2, 3, 8}) {
    for (const std::uint32_t order : {0u, 1u, 2u, 1000u, 0xffffffffu}) {
      WorkerPool worker_pool(threads, nullptr, order);
      for (const std::size_t count : {0, 1, 2, 7, 12, 1000}) {
        std::vector<std::atomic<int>> runs(count);
        worker_pool.for_each(count, [&](std::size_t task, int) { ++runs.at(task); });
        for (std::size_t i = 0; i < count; ++i)
          EXPECT_EQ(runs[i], 1) << "task " << i << " of " << count << " on " << threads
                                << " threads in order " << order;
      }
    }
  }
}

TEST(WorkerPool, DifferentTaskOrdersDiffer) {
  const auto order_of = [](std::uint32_t order) {
    std::vector<std::size_t> tasks;
    WorkerPool(1, nullptr, order).for_each(100, [&](std::size_t task, int) { tasks.push_back(task); });
    return tasks;
  };
  EXPECT_TRUE(std::ranges::is_sorted(order_of(0)));
  EXPECT_NE(order_of(1), order_of(0));
  EXPECT_NE(order_of(2), order_of(1));
  EXPECT_EQ(order_of(2), order_of(2));
}

TEST(WorkerPool, SharesAreContiguousAndOfEqualSize) {
  for (const std::size_t tasks : {1, 2, 7, 12, 1000}) {
    for (const std::size_t shares : {1, 2, 3, 7, 64}) {
      EXPECT_EQ(first_of_share(tasks, shares, 0), 0);
      EXPECT_EQ(first_of_share(tasks, shares, shares), tasks);
      for (std::size_t s = 0, last = tasks; s < shares; ++s) {
        const std::size_t size = first_of_share(tasks, shares, s + 1) - first_of_share(tasks, shares, s);
        EXPECT_TRUE(size == tasks / shares || size == tasks / shares + 1)
            << s << " of " << shares << " shares of " << tasks;
        EXPECT_LE(size, last) << "the first shares are the larger ones";
        last = size;
      }
    }
  }
}

TEST(WorkerPool, WorkerBeginsWithItsShare) {
  constexpr std::size_t kTasks = 11;
  constexpr std::size_t kThreads = 3;
  WorkerPool worker_pool(kThreads, std::make_shared<test::ThreadPerCallExecutor>(kThreads));
  for (int round = 0; round < 20; ++round) {
    std::vector<std::size_t> first(kThreads, kTasks);
    std::atomic<std::size_t> began = 0;
    worker_pool.for_each(kTasks, [&](std::size_t task, int worker) {
      std::size_t& mine = first.at(static_cast<std::size_t>(worker));
      if (mine != kTasks) return;
      mine = task;
      ++began;
      const auto late = std::chrono::steady_clock::now() + std::chrono::seconds(10);
      while (began != kThreads && std::chrono::steady_clock::now() < late)
        std::this_thread::yield();  // wait until all workers have begun
    });
    ASSERT_EQ(first, (std::vector<std::size_t>{0, 4, 8}));
  }
}

TEST(WorkerPool, WorkerContinuesWithTheNextShares) {
  WorkerPool worker_pool(3, std::make_shared<test::SingleThreadExecutor>(3, 2));
  EXPECT_EQ(worker_pool.workers_for(11), 3);
  EXPECT_EQ(worker_pool.workers_for(2), 2);
  std::vector<std::size_t> tasks;
  worker_pool.for_each(11, [&](std::size_t task, int worker) {
    EXPECT_EQ(worker, 2);
    tasks.push_back(task);
  });
  EXPECT_EQ(tasks, (std::vector<std::size_t>{8, 9, 10, 0, 1, 2, 3, 4, 5, 6, 7}));
}

// For example a draw in a progress callback that uses the renderer's workers: waiting there for threads that
// may wait for the callback could deadlock.
TEST(WorkerPool, NestedCallRunsOnItsThreadAlone) {
  constexpr int kRounds = 20;
  for (const int threads : {1, 2, 3, 8}) {
    const ThreadLimit limit(threads);
    WorkerPool worker_pool(threads);
    std::vector<std::atomic<int>> runs(10);
    std::vector<std::atomic<int>> inner_runs(20);
    std::atomic<int> elsewhere = 0;
    for (int round = 0; round < kRounds; ++round)
      worker_pool.for_each(runs.size(), [&](std::size_t task, int) {
        ++runs[task];
        spin(std::chrono::microseconds(20));
        if (task % 3 != 0) return;
        const auto caller = std::this_thread::get_id();
        std::size_t next = 0;
        worker_pool.for_each(inner_runs.size(), [&](std::size_t inner, int worker) {
          if (std::this_thread::get_id() != caller || worker != 0 || inner != next++) ++elsewhere;
          ++inner_runs[inner];
          spin(std::chrono::microseconds(20));
        });
      });
    for (const std::atomic<int>& run : runs) EXPECT_EQ(run, kRounds);
    for (const std::atomic<int>& run : inner_runs) EXPECT_EQ(run, kRounds * 4);
    EXPECT_EQ(elsewhere, 0) << threads << " threads";
  }
}

TEST(WorkerPool, ExceptionInANestedCallReachesTheCaller) {
  const ThreadLimit limit(3);
  WorkerPool worker_pool(3);
  const auto run = [&] {
    worker_pool.for_each(6, [&](std::size_t task, int) {
      worker_pool.for_each(6, [&](std::size_t inner, int) {
        if (task == 4 && inner == 5) throw std::out_of_range("four and five");
      });
    });
  };
  EXPECT_THROW(run(), std::out_of_range);
}

TEST(WorkerPool, NoTwoTasksAtTheSameTimeShareAWorker) {
  const ThreadLimit limit(8);
  WorkerPool worker_pool(8);
  std::vector<std::atomic<int>> busy(8);
  std::atomic<bool> shared = false;
  std::atomic<bool> beyond = false;
  worker_pool.for_each(2000, [&](std::size_t, int worker) {
    if (worker < 0 || worker >= 8) {
      beyond = true;
      return;
    }
    if (busy[static_cast<std::size_t>(worker)].fetch_add(1) != 0) shared = true;
    spin(std::chrono::microseconds(20));
    --busy[static_cast<std::size_t>(worker)];
  });
  EXPECT_FALSE(shared);
  EXPECT_FALSE(beyond);
}

TEST(WorkerPool, OneThreadIsTheCallers) {
  WorkerPool worker_pool(1);
  const auto caller = std::this_thread::get_id();
  std::vector<std::size_t> order;
  worker_pool.for_each(5, [&](std::size_t task, int worker) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_EQ(worker, 0);
    order.push_back(task);
  });
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(worker_pool.distinct_workers_seen(), 1);
}

TEST(WorkerPool, ExceptionOfATaskReachesTheCaller) {
  const ThreadLimit limit(8);
  for (const int threads : {1, 8}) {
    WorkerPool worker_pool(threads);
    const auto run = [&] {
      worker_pool.for_each(100, [](std::size_t task, int) {
        if (task == 37) throw std::out_of_range("thirty-seven");
      });
    };
    EXPECT_THROW(run(), std::out_of_range);
    std::atomic<int> after = 0;
    worker_pool.for_each(100, [&](std::size_t, int) { ++after; });
    EXPECT_EQ(after, 100) << "the pool still works";
  }
}

class FailsOnce : public test::SingleThreadExecutor {
 public:
  FailsOnce() : SingleThreadExecutor(2) {}
  void run(int count, void (*work)(void*, int), void* context) override {
    if (!std::exchange(has_failed_, true)) throw std::length_error("no threads yet");
    SingleThreadExecutor::run(count, work, context);
  }

 private:
  bool has_failed_ = false;
};

TEST(WorkerPool, WorksAfterItsExecutorHasFailed) {
  WorkerPool worker_pool(2, std::make_shared<FailsOnce>());
  std::vector<std::size_t> tasks;
  const auto run = [&] { worker_pool.for_each(5, [&](std::size_t task, int) { tasks.push_back(task); }); };
  EXPECT_THROW(run(), std::length_error);
  run();
  EXPECT_EQ(tasks, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(worker_pool.distinct_workers_seen(), 1) << "not treated as a nested call";
}

TEST(WorkerPool, ThreadCountIsLimitedByTheProcess) {
  const ThreadLimit limit(3);
  EXPECT_EQ(WorkerPool(8).threads(), 3);
  EXPECT_EQ(WorkerPool(2).threads(), 2);
}

TEST(WorkerPool, SurvivesBeingMoved) {
  const ThreadLimit limit(8);
  WorkerPool first(4);
  WorkerPool second(std::move(first));
  WorkerPool third(1);
  third = std::move(second);
  EXPECT_EQ(third.threads(), 4);
  std::atomic<int> runs = 0;
  third.for_each(50, [&](std::size_t, int) { ++runs; });
  EXPECT_EQ(runs, 50);
}

#if defined(__x86_64__)

constexpr unsigned kDefaultMode = 0x1f80;
constexpr unsigned kFlushToZero = 0x8000;
constexpr unsigned kDenormalsAreZero = 0x40;
constexpr unsigned kRoundUp = 0x4000;
constexpr unsigned kModeBits = 0xffc0;

TEST(WorkerPool, TasksRunInTheDefaultFloatingPointMode) {
  const ThreadLimit limit(8);
  const unsigned before = _mm_getcsr();
  const unsigned odd = (kDefaultMode | kFlushToZero | kDenormalsAreZero | kRoundUp);
  for (const int threads : {1, 8}) {
    WorkerPool worker_pool(threads);
    std::atomic<int> wrong = 0;
    _mm_setcsr(odd);
    worker_pool.for_each(400, [&](std::size_t, int) {
      if ((_mm_getcsr() & kModeBits) != kDefaultMode) ++wrong;
      spin(std::chrono::microseconds(20));
    });
    const unsigned after = _mm_getcsr();
    _mm_setcsr(before);
    EXPECT_EQ(wrong, 0) << threads << " threads";
    EXPECT_EQ(after & kModeBits, odd & kModeBits) << "the caller's mode is unchanged";
  }
}

TEST(WorkerPool, NestedCallsRunInTheDefaultFloatingPointMode) {
  const ThreadLimit limit(3);
  const unsigned odd = kDefaultMode | kFlushToZero | kDenormalsAreZero | kRoundUp;
  for (const int threads : {1, 3}) {
    WorkerPool worker_pool(threads);
    std::atomic<int> wrong = 0;
    std::atomic<int> changed = 0;
    worker_pool.for_each(12, [&](std::size_t, int) {
      const unsigned before = _mm_getcsr();
      _mm_setcsr(odd);  // as a progress callback might set it
      worker_pool.for_each(5, [&](std::size_t, int) {
        if ((_mm_getcsr() & kModeBits) != kDefaultMode) ++wrong;
      });
      if ((_mm_getcsr() & kModeBits) != (odd & kModeBits)) ++changed;
      _mm_setcsr(before);
    });
    EXPECT_EQ(wrong, 0) << threads << " threads";
    EXPECT_EQ(changed, 0) << "the task's mode is unchanged";
  }
}

TEST(WorkerPool, FloatingPointModeEndsWithItsScope) {
  const unsigned before = _mm_getcsr();
  _mm_setcsr(kDefaultMode | kFlushToZero | kRoundUp);
  volatile float smallest = std::numeric_limits<float>::min();
  float inside = 0;
  {
    const FloatingPointMode mode;
    inside = smallest / 2;
  }
  const float outside = smallest / 2;
  const unsigned after = _mm_getcsr();
  _mm_setcsr(before);
  EXPECT_GT(inside, 0) << "denormals are kept";
  EXPECT_EQ(outside, 0) << "and then flushed again";
  EXPECT_EQ(after & kModeBits, kDefaultMode | kFlushToZero | kRoundUp);
}

#endif

}  // namespace
}  // namespace tessera::worker_pool_test
