#include "perf/bench/bandwidth.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "perf/bench/statistics.h"

namespace tessera::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kL1ShareBytes = std::size_t{16} << 10;
constexpr std::uint64_t kL1Passes = 20000;

std::size_t share_of(Roofline roofline, int threads, std::uint64_t bytes) {
  if (roofline == Roofline::l1_stores) return kL1ShareBytes;
  const std::uint64_t blocks = roofline == Roofline::memory_copies ? 2 : 1;  // source and destination
  return std::max<std::size_t>(bytes / blocks / static_cast<std::uint64_t>(threads), 1);
}
std::uint64_t passes_for(Roofline roofline, std::uint64_t bytes, std::uint64_t moved) {
  if (roofline == Roofline::l1_stores) return kL1Passes;
  return std::clamp<std::uint64_t>(moved / std::max<std::uint64_t>(bytes, 1), 1, 1000000);
}

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

BandwidthKernel::BandwidthKernel(Roofline roofline, int threads, std::uint64_t bytes, std::uint64_t moved)
    : roofline_(roofline),
      share_bytes_(share_of(roofline, threads, bytes)),
      passes_(passes_for(roofline, bytes, moved)),
      worker_pool_(threads),
      memory_(static_cast<std::size_t>(threads)) {
  if (roofline == Roofline::memory_copies) copies_.resize(memory_.size());
  for (std::vector<Lines>* list : {&memory_, &copies_})
    for (Lines& part : *list) part.resize((share_bytes_ + sizeof(Line) - 1) / sizeof(Line));
}

void BandwidthKernel::run() {
  worker_pool_.for_each(memory_.size(), [this](std::size_t part, int) {
    for (std::uint64_t i = 0; i < passes_; ++i) move(part, static_cast<int>(i & 1));
  });
}

// The asm statement counts as a use of all written memory and of the search result, so the compiler removes
// neither stores nor loads.
void BandwidthKernel::move(std::size_t part, int turn) {
  void* const memory = memory_[part].data();
  const void* touched = memory;
  switch (roofline_) {
    case Roofline::memory_loads: touched = std::memchr(memory, 2, share_bytes_); break;
    case Roofline::memory_copies: touched = std::memcpy(copies_[part].data(), memory, share_bytes_); break;
    default: std::memset(memory, turn, share_bytes_);
  }
  asm volatile("" : : "r"(touched) : "memory");
}

double BandwidthKernel::bytes() const {
  return static_cast<double>(memory_.size() + copies_.size()) * static_cast<double>(share_bytes_) *
         static_cast<double>(passes_);
}

BandwidthKernel bandwidth_kernel_for(const FrameWork& work, int threads, std::uint64_t moved) {
  const std::uint64_t bytes = work.roofline == Roofline::tile_stores
                                  ? work.tile_bytes * static_cast<std::uint64_t>(threads)
                                  : work.roofline_bytes;
  return BandwidthKernel(work.roofline, threads, bytes, moved);
}

double measure_bandwidth(Roofline roofline, int threads, std::uint64_t bytes, double seconds) {
  constexpr int kRuns = 10;
  constexpr double kMaxMoved = 512 << 20;         // bytes per run
  constexpr double kMovedPerSecond = 8ull << 30;  // fewer bytes per run if `seconds` is short
  const auto moved = static_cast<std::uint64_t>(std::min(kMaxMoved, seconds * kMovedPerSecond));
  BandwidthKernel kernel(roofline, threads, bytes, moved);
  kernel.run();  // starts the threads
  std::vector<double> rates;
  const Clock::time_point first = Clock::now();
  for (int run = 0; run < kRuns; ++run) {
    const Clock::time_point start = Clock::now();
    if (run > 0 && seconds_between(first, start) >= seconds) break;
    kernel.run();
    rates.push_back(kernel.bytes() / seconds_between(start, Clock::now()) * 1e-9);
  }
  return statistics_of(rates).median;
}

}  // namespace tessera::bench
