// Workers for the library tessera::display.
#pragma once

#include "engine/program/threads/parallel_for.h"
#include "engine/program/threads/thread_limit.h"

namespace tessera::program {

/// Threads that last for one call, with the members of tessera::Executor that ScreenWorkers needs.
class LoopWorkers {
 public:
  /// @param threads  1 or more; 0: available_cores()
  explicit LoopWorkers(int threads) : threads_(threads == 0 ? available_cores() : threads) {}

  int workers() const noexcept { return threads_; }
  /// Calls work(context, k) once for each k in 0 .. count - 1.
  void run(int count, void (*work)(void* context, int worker), void* context) {
    parallel_for(count, threads_, [=] { return [=](int k) { work(context, k); }; });
  }

 private:
  int threads_;
};

}  // namespace tessera::program
