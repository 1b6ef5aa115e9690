// Executors that pretend to have many workers, so that a frame is cut as for a machine with as many cores.
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

/// Whose workers come one after the other, and how long they run.
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
  /// In which workers ran, since it was asked last; the caller waits for them.
  double take_seconds() { return std::exchange(seconds_, 0); }
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
  int workers_, calls_ = 0;
  double seconds_ = 0;
};

/// On the caller's thread: what the tasks themselves take.
class WorkersOnCallingThread : public SimulatedWorkers {
 public:
  using SimulatedWorkers::SimulatedWorkers;

 private:
  void run_all(const Job& job) override { job(); }
};

/// On a thread of their own: for what the caller does alone. After all of a frame's tasks its core's caches
/// would hold nothing of that; on many cores it takes a small share of them, and what the others leave for it
/// comes from their caches. Meanwhile the caller reads other memory, for that share.
class WorkersOnOtherCore : public SimulatedWorkers {
 public:
  /// @param core  that the thread is kept on, if the system lets it
  /// @param share_bytes  that the caller reads while workers run
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
    while (turn_.load() == Turn::workers) std::this_thread::yield();  // awake, as a worker is
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
  std::jthread thread_;  // last: it uses the others
};

}  // namespace tessera::bench
