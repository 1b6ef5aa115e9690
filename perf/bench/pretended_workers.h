// Executors that pretend to have many workers, so that a frame is cut as for a machine with as many cores.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::bench {

/// Whose workers come one after the other, and how long they run.
class PretendedWorkers : public Executor {
 public:
  explicit PretendedWorkers(int workers) : workers_(workers) {}
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
class WorkersOnCaller : public PretendedWorkers {
 public:
  using PretendedWorkers::PretendedWorkers;

 private:
  void run_all(const Job& job) override { job(); }
};

/// On another thread, and on another core where there is one: for what the caller does alone. After all of a frame's tasks its core's caches would hold nothing
/// of that; on many cores it takes a small share of them, and what the others leave for it comes from their caches. Meanwhile the caller reads as much memory
/// as one of 64 workers does in a pass over 500,000 triangles.
class WorkersElsewhere : public PretendedWorkers {
 public:
  explicit WorkersElsewhere(int workers) : PretendedWorkers(workers) {}
  ~WorkersElsewhere() override { hand_over({}); }

 private:
  enum class Turn : int { callers, workers };
  static constexpr std::size_t kShareBytes = 256 << 10;

  void run_all(const Job& job) override {
    hand_over(job);
    for (const std::uint64_t& word : share_) sum_ = sum_ + word;
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

  const std::vector<std::uint64_t> share_ = std::vector<std::uint64_t>(kShareBytes / sizeof(std::uint64_t));
  volatile std::uint64_t sum_ = 0;
  Job job_;
  std::atomic<Turn> turn_{Turn::callers};
  std::jthread thread_{[this] { serve(); }};  // last: it uses the others
};

}  // namespace tessera::bench
