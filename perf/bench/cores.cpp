#include "perf/bench/cores.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include <sched.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace tessera::bench {
namespace {

/// Spin-wait hint: without it, reads delay the core that tries to write the line.
void pause() {
#if defined(__x86_64__)
  _mm_pause();
#elif defined(__aarch64__)
  __asm__ volatile("isb");
#endif
}

/// Repeatedly waits until `turn` is `mine` and hands it to the other thread.
void ping_pong(std::atomic<int>& turn, int mine, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    while (turn.load() != mine) pause();
    turn = 1 - mine;
  }
}

/// Returns NaN if the threads could not be bound to the two cores.
double handoff_ns(int first_core, int second_core) {
  constexpr int kRounds = 5000;
  std::atomic<int> turn{0};
  std::atomic<int> ready{0};
  std::atomic<bool> are_bound{true};
  double ns = std::numeric_limits<double>::quiet_NaN();
  const auto play = [&](int mine, int core) {
    if (!set_thread_affinity({&core, 1})) are_bound = false;
    for (++ready; ready.load() < 2 && are_bound;) std::this_thread::yield();
    if (!are_bound) return;
    const auto start = std::chrono::steady_clock::now();
    ping_pong(turn, mine, kRounds);
    if (mine == 0)
      ns = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() /
           (2 * kRounds);
  };
  {
    const std::jthread first([&] { play(0, first_core); });
    try {
      const std::jthread second([&] { play(1, second_core); });
    } catch (...) {
      are_bound = false;  // releases the first thread
      throw;
    }
  }
  return ns;
}

}  // namespace

std::vector<int> allowed_cores() {
  std::vector<int> cores;
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return cores;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(static_cast<std::size_t>(core), &set)) cores.push_back(core);
  return cores;
}

bool set_thread_affinity(std::span<const int> cores) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int core : cores) CPU_SET(static_cast<std::size_t>(core), &set);
  return ::sched_setaffinity(0, sizeof set, &set) == 0;
}

double core_to_core_ns() {
  constexpr int kRuns = 9;
  const std::vector<int> cores = allowed_cores();
  if (cores.size() < 2) return 0;
  double min_ns = std::numeric_limits<double>::infinity();
  for (int run = 0; run < kRuns; ++run) min_ns = std::fmin(min_ns, handoff_ns(cores[0], cores[1]));
  return std::isfinite(min_ns) ? min_ns : 0;
}

}  // namespace tessera::bench
