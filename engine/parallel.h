// The one place where threads are chosen. Everything else asks for "these tasks, in any order" and knows no threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera {

/// Runs tasks on the workers of an executor.
class Parallel {
 public:
  /// @param threads  1 or more, the caller's included
  /// @param executor  null: a oneTBB arena of its own, or for one thread the caller's
  /// @param order  see RendererOptions::task_order
  explicit Parallel(int threads, std::shared_ptr<Executor> executor = nullptr, std::uint32_t order = 0);
  ~Parallel();
  Parallel(Parallel&&) noexcept;
  Parallel& operator=(Parallel&&) noexcept;

  int threads() const noexcept { return threads_; }
  /// Calls task(i, worker) for 0 <= i < count, each once, and returns when all are done. `worker` is below threads() and below count; no two
  /// tasks that run at the same time share one. Each task runs in the default floating-point mode: rounding to nearest,
  /// denormals kept. An exception of a task is thrown here, after the running tasks have ended; the rest do not start.
  template <class Task>
  void for_each(std::size_t count, const Task& task) {
    run(count, {[](const void* self, std::size_t i, int worker) { (*static_cast<const Task*>(self))(i, worker); }, &task});
  }
  /// How many distinct workers have run tasks since the last call: what tests of thread counts assert.
  int distinct_workers_seen();

 private:
  /// A task that lives as long as it is called: unlike a std::function it needs no memory.
  struct AnyTask {
    void (*call)(const void* self, std::size_t i, int worker);
    const void* self;
  };
  struct Queue;
  void run(std::size_t count, const AnyTask& task);

  int threads_;
  std::shared_ptr<Executor> executor_;
  std::uint32_t order_ = 0;
  std::vector<char> seen_;  // one for each worker
};

/// Calls run(): if it waits for oneTBB, its thread takes no task of ours meanwhile.
void isolated(const std::function<void()>& run);

/// Cores that the process may use.
int available_cores();

/// Lets the process run more threads than it has cores, for as long as it lives. Process-wide: for programs and tests, never
/// for the library.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

/// Rounding to nearest, denormals kept, until the end of the scope; then what it was before.
class FloatingPointMode {
 public:
  FloatingPointMode();
  ~FloatingPointMode();
  FloatingPointMode(const FloatingPointMode&) = delete;
  FloatingPointMode& operator=(const FloatingPointMode&) = delete;

 private:
  unsigned long long saved_;
};

}  // namespace tessera
