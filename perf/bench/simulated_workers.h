// Executors that simulate many workers, so that a frame is split as on a machine with that many cores.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <thread>
#include <utility>
#include <vector>

#include "engine/tessera/tessera.hpp"
#include "perf/bench/cores.h"

namespace tessera::bench {

/// Executor that runs its workers serially and times them.
class SimulatedWorkers : public Executor {
 public:
  explicit SimulatedWorkers(int workers) : workers_(workers) {}
  int workers() const noexcept override { return workers_; }
  void run(int count, void (*work)(void*, int), void* context) override {
    const Clock::time_point start = Clock::now();
    run_all({count, work, context});
    seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
    ++calls_;
  }
  /// Seconds in run() since the last call of this function.
  double take_seconds() { return std::exchange(seconds_, 0); }
  /// Calls of run() since the last call of this function.
  int take_calls() { return std::exchange(calls_, 0); }

 protected:
  struct Job {
    int count = 0;
    void (*work)(void*, int) = nullptr;
    void* context = nullptr;
    void operator()() const {
      for (int k = 0; k < count; ++k) work(context, k);
    }
  };
  virtual void run_all(const Job& job) = 0;

 private:
  using Clock = std::chrono::steady_clock;
  int workers_;
  int calls_ = 0;
  double seconds_ = 0;
};

/// Runs workers on the calling thread: measures the tasks themselves.
class WorkersOnCallingThread : public SimulatedWorkers {
 public:
  using SimulatedWorkers::SimulatedWorkers;

 private:
  void run_all(const Job& job) override { job(); }
};

/// Runs workers on another thread: measures the serial work of the caller.
///
/// If the caller's core ran all tasks of a frame, they would evict the data of its serial work. With many
/// cores it runs a small share of them and fetches the results of the others from the other cores' caches. In
/// place of its share, the caller reads as much unrelated memory while the workers run.
class WorkersOnOtherCore : public SimulatedWorkers {
 public:
  /// @param core         logical CPU that the thread is bound to, if the system permits it
  /// @param share_bytes  bytes that the caller reads while workers run
  WorkersOnOtherCore(int workers, int core, std::size_t share_bytes)
      : SimulatedWorkers(workers), share_(share_bytes / sizeof(std::uint64_t)), thread_([this, core] {
          set_thread_affinity({&core, 1});
          serve();
        }) {}
  ~WorkersOnOtherCore() override { hand_over({}); }

 private:
  enum class Turn : int { callers, workers };

  void run_all(const Job& job) override {
    hand_over(job);
    sum_ = std::accumulate(share_.begin(), share_.end(), std::uint64_t{0});
    while (turn_.load() == Turn::workers) std::this_thread::yield();  // spin, as a worker does
  }
  void hand_over(const Job& job) {
    job_ = job;
    turn_ = Turn::workers;
    turn_.notify_one();
  }
  void serve() {
    for (;;) {
      turn_.wait(Turn::callers);
      if (job_.work == nullptr) return;
      job_();
      turn_ = Turn::callers;
    }
  }

  const std::vector<std::uint64_t> share_;
  volatile std::uint64_t sum_ = 0;
  Job job_;
  std::atomic<Turn> turn_{Turn::callers};
  std::jthread thread_;  // last member: uses the others
};

}  // namespace tessera::bench
