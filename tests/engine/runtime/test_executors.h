// Executors with a deterministic order of workers.
#pragma once

#include <algorithm>
#include <thread>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::test {

/// Runs the workers in order on the caller's thread, so that the first of them finds all tasks.
class SingleThreadExecutor : public Executor {
 public:
  /// @param first  index of the first worker, clamped to the last one; the others follow cyclically
  explicit SingleThreadExecutor(int count, int first = 0) : count_(count), first_(first) {}
  int workers() const noexcept override { return count_; }
  void run(int count, void (*work)(void*, int), void* context) override {
    for (int k = 0; k < count; ++k) work(context, (std::min(first_, count - 1) + k) % count);
  }
  void begin_with(int worker) { first_ = worker; }

 private:
  int count_;
  int first_;
};

/// Starts new threads for each call: the simplest thread pool.
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
