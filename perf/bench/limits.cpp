#include "perf/bench/limits.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "perf/bench/statistics.h"

namespace tessera::bench {
namespace {

using Clock = std::chrono::steady_clock;

std::size_t share_of(Limit limit, int threads, std::uint64_t bytes) {
  if (limit == Limit::l1_stores) return std::size_t{16} << 10;
  return std::max<std::size_t>(
      bytes / (limit == Limit::memory_copies ? 2 : 1) / static_cast<std::uint64_t>(threads), 1);
}
std::uint64_t times_for(Limit limit, std::uint64_t bytes, std::uint64_t moved) {
  return limit == Limit::l1_stores
             ? 20000
             : std::clamp<std::uint64_t>(moved / std::max<std::uint64_t>(bytes, 1), 1, 1000000);
}

}  // namespace

LimitMoves::LimitMoves(Limit limit, int threads, std::uint64_t bytes, std::uint64_t moved)
    : limit_(limit),
      share_(share_of(limit, threads, bytes)),
      times_(times_for(limit, bytes, moved)),
      parallel_(threads),
      memory_(static_cast<std::size_t>(threads)) {
  if (limit == Limit::memory_copies) copies_.resize(memory_.size());
  for (std::vector<Lines>* list : {&memory_, &copies_})
    for (Lines& part : *list) part.resize((share_ + sizeof(Line) - 1) / sizeof(Line));
}

void LimitMoves::run() {
  parallel_.for_each(memory_.size(), [this](std::size_t part, int) {
    for (std::uint64_t i = 0; i < times_; ++i) move(part, static_cast<int>(i & 1));
  });
}

// What is written counts as read, and what is found as used, so that no compiler leaves anything out.
void LimitMoves::move(std::size_t part, int turn) {
  void* const memory = memory_[part].data();
  const void* touched = memory;
  switch (limit_) {
    case Limit::memory_loads: touched = std::memchr(memory, 2, share_); break;
    case Limit::memory_copies: touched = std::memcpy(copies_[part].data(), memory, share_); break;
    default: std::memset(memory, turn, share_);
  }
  asm volatile("" : : "r"(touched) : "memory");
}

double LimitMoves::bytes() const {
  return static_cast<double>(memory_.size() + copies_.size()) * static_cast<double>(share_) *
         static_cast<double>(times_);
}

LimitMoves limit_for(const FrameWork& work, int threads, std::uint64_t moved) {
  const bool is_in_tiles = work.limit == Limit::tile_stores;
  return LimitMoves(work.limit, threads,
                    is_in_tiles ? work.tile_bytes * static_cast<std::uint64_t>(threads) : work.limited_bytes,
                    moved);
}

double measure_limit(Limit limit, int threads, std::uint64_t bytes) {
  LimitMoves moves(limit, threads, bytes, std::uint64_t{512} << 20);
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
