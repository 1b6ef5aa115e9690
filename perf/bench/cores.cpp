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

/// Between two looks at a line: else they keep it from the core that wants to write it.
void pause() {
#if defined(__x86_64__)
  _mm_pause();
#elif defined(__aarch64__)
  __asm__ volatile("isb");
#endif
}

/// Waits for `turn` and gives it to the other, again and again.
void ping_pong(std::atomic<int>& turn, int mine, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    while (turn.load() != mine) pause();
    turn = 1 - mine;
  }
}

/// NaN if the system did not keep both threads apart.
double handoff_ns(int first_core, int second_core) {
  constexpr int kRounds = 5000;
  std::atomic<int> turn{0}, ready{0};
  std::atomic<bool> are_apart{true};
  double ns = std::numeric_limits<double>::quiet_NaN();
  const auto play = [&](int mine, int core) {
    if (!set_thread_affinity({&core, 1})) are_apart = false;
    for (++ready; ready.load() < 2 && are_apart;) std::this_thread::yield();
    if (!are_apart) return;
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
      are_apart = false;
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
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < kRuns; ++run) least = std::fmin(least, handoff_ns(cores[0], cores[1]));
  return std::isfinite(least) ? least : 0;
}

}  // namespace tessera::bench
