// The program's parallel loop.
#include "engine/program/threads/parallel_for.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace tessera::program::parallel_for_test {
namespace {

TEST(ParallelFor, CallsEachTaskOnceFromAtMostTheGivenThreads) {
  for (const int threads : {0, 1, 2, 7}) {
    for (const int count : {0, 1, 5, 1000}) {
      std::vector<std::atomic<int>> calls(static_cast<std::size_t>(count));
      std::atomic<int> made{0};
      parallel_for(count, threads, [&] {
        ++made;
        return [&](int i) { ++calls[static_cast<std::size_t>(i)]; };
      });
      for (const std::atomic<int>& number : calls) EXPECT_EQ(number, 1);
      if (threads != 0) {
        EXPECT_LE(made, threads);
      }
    }
  }
}

TEST(ParallelFor, ThrowsTheExceptionOfATask) {
  for (const int threads : {1, 3})
    EXPECT_THROW(parallel_for(100, threads,
                              [] {
                                return [](int i) {
                                  if (i == 50) throw std::runtime_error("task 50");
                                };
                              }),
                 std::runtime_error);
}

}  // namespace
}  // namespace tessera::program::parallel_for_test
