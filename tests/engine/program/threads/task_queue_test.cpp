// Tasks in the background whose last steps run in order.
#include "engine/program/threads/task_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace tessera::program::task_queue_test {
namespace {

using namespace std::chrono_literals;

TEST(TaskQueue, LastStepsRunInOrderInTheCallingThread) {
  for (const int threads : {1, 2, 7}) {
    std::vector<int> results(100);
    std::vector<int> order;
    const auto caller = std::this_thread::get_id();
    TaskQueue queue(threads, 5);
    for (int i = 0; i < 100; ++i)
      queue.add(
          [&results, i] {
            if (i % 10 == 0) std::this_thread::sleep_for(1ms);
            results[static_cast<std::size_t>(i)] = i + 1;
          },
          [&, i] {
            EXPECT_EQ(std::this_thread::get_id(), caller);
            EXPECT_EQ(results[static_cast<std::size_t>(i)], i + 1);
            order.push_back(i);
          });
    queue.finish();
    ASSERT_EQ(order.size(), 100u);
    EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
  }
}

TEST(TaskQueue, OneThreadRunsTasksAtOnce) {
  TaskQueue queue(1, 3);
  std::vector<int> steps;
  queue.add([&] { steps.push_back(1); }, [&] { steps.push_back(2); });
  EXPECT_EQ(steps, (std::vector<int>{1, 2}));
}

TEST(TaskQueue, KeepsNoMoreTasksThanAllowed) {
  for (const int max_tasks : {1, 3}) {
    std::atomic<int> unfinished{0}, largest{0};
    TaskQueue queue(4, max_tasks);
    for (int i = 0; i < 50; ++i) {
      queue.add([&] { std::this_thread::sleep_for(1ms); }, [&] { --unfinished; });
      largest = std::max<int>(largest, ++unfinished);
    }
    queue.finish();
    EXPECT_EQ(largest, max_tasks);
    EXPECT_EQ(unfinished, 0);
  }
}

TEST(TaskQueue, RunsTasksOnSeveralThreads) {
  std::mutex mutex;
  std::set<std::thread::id> ids;
  TaskQueue queue(2, 8);
  for (int i = 0; i < 8; ++i)
    queue.add(
        [&] {
          std::this_thread::sleep_for(20ms);
          const std::lock_guard lock(mutex);
          ids.insert(std::this_thread::get_id());
        },
        {});
  queue.finish();
  EXPECT_EQ(ids.size(), 2u);
  EXPECT_FALSE(ids.contains(std::this_thread::get_id()));
}

TEST(TaskQueue, ThrowsTheFirstExceptionInOrder) {
  for (const int threads : {1, 4}) {
    int last_steps = 0;
    std::string message;
    try {
      TaskQueue queue(threads, 4);
      for (int i = 0; i < 20; ++i)
        queue.add(
            [i] {
              if (i == 3) std::this_thread::sleep_for(20ms);  // fails after the next one
              if (i >= 3) throw std::runtime_error("task " + std::to_string(i));
            },
            [&] { ++last_steps; });
      queue.finish();
    } catch (const std::runtime_error& error) {
      message = error.what();
    }
    EXPECT_EQ(message, "task 3");
    EXPECT_EQ(last_steps, 3);
  }
}

TEST(TaskQueue, LeavesOutWaitingTasksAtItsEnd) {
  std::atomic<int> begun{0};
  {
    TaskQueue queue(2, 20);
    for (int i = 0; i < 20; ++i)
      queue.add(
          [&] {
            ++begun;
            std::this_thread::sleep_for(50ms);
          },
          [] { ADD_FAILURE() << "a last step after the end"; });
  }
  EXPECT_LE(begun, 4);
}

}  // namespace
}  // namespace tessera::program::task_queue_test
