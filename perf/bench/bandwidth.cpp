#include "perf/bench/bandwidth.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "perf/bench/statistics.h"

namespace tessera::bench {
namespace {

using Clock = std::chrono::steady_clock;

std::size_t share_of(Roofline roofline, int threads, std::uint64_t bytes) {
  if (roofline == Roofline::l1_stores) return std::size_t{16} << 10;
  return std::max<std::size_t>(
      bytes / (roofline == Roofline::memory_copies ? 2 : 1) / static_cast<std::uint64_t>(threads), 1);
}
std::uint64_t times_for(Roofline roofline, std::uint64_t bytes, std::uint64_t moved) {
  return roofline == Roofline::l1_stores
             ? 20000
             : std::clamp<std::uint64_t>(moved / std::max<std::uint64_t>(bytes, 1), 1, 1000000);
}

}  // namespace

BandwidthKernel::BandwidthKernel(Roofline roofline, int threads, std::uint64_t bytes, std::uint64_t moved)
    : roofline_(roofline),
      share_(share_of(roofline, threads, bytes)),
      times_(times_for(roofline, bytes, moved)),
      worker_pool_(threads),
      memory_(static_cast<std::size_t>(threads)) {
  if (roofline == Roofline::memory_copies) copies_.resize(memory_.size());
  for (std::vector<Lines>* list : {&memory_, &copies_})
    for (Lines& part : *list) part.resize((share_ + sizeof(Line) - 1) / sizeof(Line));
}

void BandwidthKernel::run() {
  worker_pool_.for_each(memory_.size(), [this](std::size_t part, int) {
    for (std::uint64_t i = 0; i < times_; ++i) move(part, static_cast<int>(i & 1));
  });
}

// What is written counts as read, and what is found as used, so that no compiler leaves anything out.
void BandwidthKernel::move(std::size_t part, int turn) {
  void* const memory = memory_[part].data();
  const void* touched = memory;
  switch (roofline_) {
    case Roofline::memory_loads: touched = std::memchr(memory, 2, share_); break;
    case Roofline::memory_copies: touched = std::memcpy(copies_[part].data(), memory, share_); break;
    default: std::memset(memory, turn, share_);
  }
  asm volatile("" : : "r"(touched) : "memory");
}

double BandwidthKernel::bytes() const {
  return static_cast<double>(memory_.size() + copies_.size()) * static_cast<double>(share_) *
         static_cast<double>(times_);
}

BandwidthKernel bandwidth_kernel_for(const FrameWork& work, int threads, std::uint64_t moved) {
  const bool is_in_tiles = work.roofline == Roofline::tile_stores;
  return BandwidthKernel(
      work.roofline, threads,
      is_in_tiles ? work.tile_bytes * static_cast<std::uint64_t>(threads) : work.roofline_bytes, moved);
}

double measure_bandwidth(Roofline roofline, int threads, std::uint64_t bytes) {
  BandwidthKernel moves(roofline, threads, bytes, std::uint64_t{512} << 20);
  std::vector<double> rates;
  for (int run = 0; run < 12; ++run) {
    const Clock::time_point start = Clock::now();
    moves.run();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (run >= 3) rates.push_back(moves.bytes() / seconds * 1e-9);  // the first ones bring the pages
  }
  return statistics_of(rates).median;
}

}  // namespace tessera::bench
