#include "perf/bench/limits.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <vector>

#include "engine/parallel.h"
#include "perf/bench/statistics.h"

namespace tessera::bench {
namespace {

using Clock = std::chrono::steady_clock;

// What is written counts as read, so that no compiler leaves a memset out.
void keep(const void* memory) { asm volatile("" : : "r"(memory) : "memory"); }

/// @param move  (part, of how many): moves one part's bytes
/// @return 10^9 bytes a second
template <class Move>
double rate(Parallel& parallel, double bytes, const Move& move) {
  std::vector<double> rates;
  const auto threads = static_cast<std::size_t>(parallel.threads());
  for (int run = 0; run < 12; ++run) {
    const Clock::time_point start = Clock::now();
    parallel.for_each(threads, [&](std::size_t part, int) { move(part); });
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (run >= 3) rates.push_back(bytes / seconds * 1e-9);  // the first ones bring the pages
  }
  return statistics_of(rates).median;
}

// So many times that the threads' start is nothing beside it.
int times_for(std::uint64_t bytes) { return static_cast<int>(std::clamp<std::uint64_t>((std::uint64_t{512} << 20) / std::max<std::uint64_t>(bytes, 1), 1, 20000)); }

using Bytes = std::vector<std::uint8_t>;

double store_rate(Parallel& parallel, std::uint64_t bytes, int times) {
  const auto threads = static_cast<std::uint64_t>(parallel.threads());
  std::vector<Bytes> memory(threads, Bytes(bytes / threads));
  return rate(parallel, static_cast<double>(bytes / threads * threads) * times, [&](std::size_t part) {
    for (int i = 0; i < times; ++i) {
      std::memset(memory[part].data(), i, memory[part].size());
      keep(memory[part].data());
    }
  });
}

double copy_rate(Parallel& parallel, std::uint64_t bytes, int times) {
  const auto threads = static_cast<std::uint64_t>(parallel.threads());
  const std::vector<Bytes> from(threads, Bytes(bytes / 2 / threads, 1));
  std::vector<Bytes> to(from);
  return rate(parallel, 2 * static_cast<double>(bytes / 2 / threads * threads) * times, [&](std::size_t part) {
    for (int i = 0; i < times; ++i) {
      std::memcpy(to[part].data(), from[part].data(), to[part].size());
      keep(to[part].data());
    }
  });
}

double load_rate(Parallel& parallel, std::uint64_t bytes, int times) {
  const auto threads = static_cast<std::uint64_t>(parallel.threads());
  const std::vector<Bytes> memory(threads, Bytes(bytes / threads, 1));
  return rate(parallel, static_cast<double>(bytes / threads * threads) * times, [&](std::size_t part) {
    for (int i = 0; i < times; ++i) {
      const void* const found = std::memchr(memory[part].data(), 2, memory[part].size());
      asm volatile("" : : "r"(found) : "memory");  // it was looked for
    }
  });
}

}  // namespace

double measure_limit(Limit limit, int threads, std::uint64_t bytes) {
  constexpr std::uint64_t kInL1 = std::uint64_t{16} << 10;
  Parallel parallel(threads);
  switch (limit) {
    case Limit::l1_stores: return store_rate(parallel, kInL1 * static_cast<std::uint64_t>(threads), 20000);
    case Limit::memory_stores: return store_rate(parallel, bytes, times_for(bytes));
    case Limit::memory_loads: return load_rate(parallel, bytes, times_for(bytes));
    default: return copy_rate(parallel, bytes, times_for(bytes));
  }
}

}  // namespace tessera::bench
