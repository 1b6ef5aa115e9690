// Parallel loops over tasks, with work stealing. All threading of the library is here.
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

/// Tasks are split into shares of equal size; the first tasks % shares shares have one more.
/// @pre shares > 0, s <= shares
/// @return the first task of share s; share s ends before the first task of share s + 1
constexpr std::size_t first_of_share(std::size_t tasks, std::size_t shares, std::size_t s) {
  return s * (tasks / shares) + std::min(s, tasks % shares);
}

/// Runs tasks on the workers of an executor.
class WorkerPool {
 public:
  /// @param threads   1 or more, including the calling thread
  /// @param executor  null: a oneTBB arena, or the calling thread if threads is 1
  /// @param order     see DebugOptions::task_order
  explicit WorkerPool(int threads, std::shared_ptr<Executor> executor = nullptr, std::uint32_t order = 0);
  ~WorkerPool();
  WorkerPool(WorkerPool&&) noexcept;
  WorkerPool& operator=(WorkerPool&&) noexcept;

  int threads() const noexcept { return threads_; }
  /// True while for_each() runs: the caller is one of its tasks.
  bool is_running() const noexcept { return is_running_; }
  /// Number of workers that run `count` tasks.
  std::size_t workers_for(std::size_t count) const noexcept {
    return std::min(static_cast<std::size_t>(threads_), count);
  }
  /// Calls task(i, worker) once for each i in 0 .. count-1 and returns when all are done.
  /// - `worker` is below workers_for(count); concurrent tasks of one call have distinct workers.
  /// - Worker k starts with share k, lowest task first, then steals from the following shares. Caches stay
  ///   warm if the same thread is worker k each time; callers may put long tasks first in each share.
  /// - Tasks run in FloatingPointMode.
  /// - An exception of a task is rethrown here after the running tasks have ended; the rest do not start.
  /// - One thread at a time. Calls from tasks run serially on their thread, as worker 0.
  template <class Task>
  void for_each(std::size_t count, const Task& task) {
    run(count,
        {[](const void* self, std::size_t i, int worker) { (*static_cast<const Task*>(self))(i, worker); },
         &task});
  }
  /// Number of distinct workers that ran tasks since the last call; nested calls do not count.
  /// Serves only the test of this class.
  int distinct_workers_seen();

 private:
  /// Reference to the task of a call; unlike std::function it allocates nothing.
  struct TaskRef {
    void (*call)(const void* self, std::size_t i, int worker);
    const void* self;
  };
  struct Dispatch;
  /// The share of one worker, in a separate cache line, written mostly by that worker.
  struct alignas(64) Share {
    std::atomic<std::size_t> next{0};  // first task that has not started
    std::size_t end = 0;
    bool has_run = false;  // the worker ran a task since distinct_workers_seen() was called
  };
  void run(std::size_t count, const TaskRef& task);

  int threads_;
  std::shared_ptr<Executor> executor_;
  std::uint32_t order_ = 0;
  std::vector<Share> shares_;  // per worker
  bool is_running_ = false;    // an outermost call runs; ordered before its tasks by the executor's hand-over
};

/// Calls run(). If it waits for oneTBB, this thread takes no task of the enclosing call meanwhile.
void run_isolated(const std::function<void()>& run);

/// Number of cores that the process may use, at least 1.
int default_concurrency();

}  // namespace tessera::detail
