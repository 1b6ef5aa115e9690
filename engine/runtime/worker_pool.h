// The one place where threads are chosen. Everything else asks for "these tasks, in any order" and knows no
// threads; who wants long tasks to begin first knows in what shares they are taken.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::detail {

/// Tasks are cut into shares of equal numbers, the first ones with one more where that does not come out.
///
/// @pre  shares > 0, s <= shares
/// @return  the first task of share s, which ends before that of share s + 1
constexpr std::size_t first_of_share(std::size_t tasks, std::size_t shares, std::size_t s) {
  return s * (tasks / shares) + std::min(s, tasks % shares);
}

/// Runs tasks on the workers of an executor.
class WorkerPool {
 public:
  /// @param threads  1 or more, the caller's included
  /// @param executor  null: a oneTBB arena of its own, or for one thread the caller's
  /// @param order  see DebugOptions::task_order
  explicit WorkerPool(int threads, std::shared_ptr<Executor> executor = nullptr, std::uint32_t order = 0);
  ~WorkerPool();
  WorkerPool(WorkerPool&&) noexcept;
  WorkerPool& operator=(WorkerPool&&) noexcept;

  int threads() const noexcept { return threads_; }
  /// Whether a call runs: it is a task that asks.
  bool is_running() const noexcept { return is_running_; }
  /// How many workers run so many tasks.
  std::size_t workers_for(std::size_t count) const noexcept {
    return std::min(static_cast<std::size_t>(threads_), count);
  }
  /// Calls task(i, worker) for 0 <= i < count, each once, and returns when all are done. `worker` is below
  /// workers_for(count); no two tasks of one call that run at the same time share one. A worker begins with
  /// the share of its number, from the lowest task on (unless they have another order), and goes on to what
  /// is left of the next ones: where a thread is the same worker again it finds what it left in its caches,
  /// and callers can put the long tasks of each share first. Each task runs in the default floating-point
  /// mode: rounding to nearest, denormals kept. An exception of a task is thrown here, after the running
  /// tasks have ended; the rest do not start. For one thread at a time, and for tasks, whose calls their own
  /// thread runs alone, as worker 0.
  template <class Task>
  void for_each(std::size_t count, const Task& task) {
    run(count,
        {[](const void* self, std::size_t i, int worker) { (*static_cast<const Task*>(self))(i, worker); },
         &task});
  }
  /// How many distinct workers have run tasks, but for those of tasks' calls, since it was asked last: what
  /// tests of thread counts assert.
  int distinct_workers_seen();

 private:
  /// A task that lives as long as it is called: unlike a std::function it needs no memory.
  struct TaskRef {
    void (*call)(const void* self, std::size_t i, int worker);
    const void* self;
  };
  struct Dispatch;
  /// One worker's. In a cache line of its own, which mostly that worker alone writes to.
  struct alignas(64) Share {
    std::atomic<std::size_t> next{0};  // nobody has begun the tasks from here on
    std::size_t end = 0;
    bool has_run = false;  // its worker has, since distinct_workers_seen() was asked
  };
  void run(std::size_t count, const TaskRef& task);

  int threads_;
  std::shared_ptr<Executor> executor_;
  std::uint32_t order_ = 0;
  std::vector<Share> shares_;  // one for each worker
  bool is_running_ =
      false;  // a call that is no task's. Tasks' calls read it: the executor's handing over orders that
};

/// Calls run(): if it waits for oneTBB, its thread takes no task meanwhile of the call that it is in.
void run_isolated(const std::function<void()>& run);

/// Number of cores that the process may use, at least 1.
int default_concurrency();

}  // namespace tessera::detail
