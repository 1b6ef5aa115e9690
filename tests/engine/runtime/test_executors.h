// Executors that tests can foresee.
#pragma once

#include <algorithm>
#include <thread>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::test {

/// Workers that run one after the other on the caller's thread, so that the first of them finds all the
/// tasks.
class SingleThreadExecutor : public Executor {
 public:
  /// @param first  the one that begins, or the last one where there are fewer; those after it follow
  explicit SingleThreadExecutor(int count, int first = 0) : count_(count), first_(first) {}
  int workers() const noexcept override { return count_; }
  void run(int count, void (*work)(void*, int), void* context) override {
    for (int k = 0; k < count; ++k) work(context, (std::min(first_, count - 1) + k) % count);
  }
  void begin_with(int worker) { first_ = worker; }

 private:
  int count_, first_;
};

/// Threads that are made for each call: the simplest pool there is.
class ThreadPerCallExecutor : public Executor {
 public:
  explicit ThreadPerCallExecutor(int count) : count_(count) {}
  int workers() const noexcept override { return count_; }
  void run(int count, void (*work)(void*, int), void* context) override {
    std::vector<std::thread> threads;
    for (int k = 0; k < count; ++k) threads.emplace_back(work, context, k);
    for (std::thread& thread : threads) thread.join();
    ++runs;
  }
  int runs = 0;

 private:
  int count_;
};

}  // namespace tessera::test
