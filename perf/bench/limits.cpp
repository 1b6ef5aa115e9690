#include "perf/bench/limits.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "perf/bench/statistics.h"

namespace tessera::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kInL1 = std::uint64_t{16} << 10;  // for each thread

std::uint64_t memory_of(Limit limit, int threads, std::uint64_t bytes) { return limit == Limit::l1_stores ? kInL1 * static_cast<std::uint64_t>(threads) : bytes; }

// So many times that `moved` bytes are moved, or many more where that is soon done: the threads' start is nothing beside it.
std::uint64_t times_for(Limit limit, std::uint64_t bytes, std::uint64_t moved) {
  return limit == Limit::l1_stores ? 20000 : std::clamp<std::uint64_t>(moved / std::max<std::uint64_t>(bytes, 1), 1, 20000);
}
constexpr std::uint64_t kAlone = std::uint64_t{512} << 20, kInTurns = std::uint64_t{64} << 20;

std::size_t share_of(Limit limit, std::uint64_t bytes, int threads) {
  return std::max<std::size_t>(bytes / (limit == Limit::memory_copies ? 2 : 1) / static_cast<std::uint64_t>(threads), 1);
}

}  // namespace

LimitMoves::LimitMoves(Limit limit, int threads, std::uint64_t bytes, std::uint64_t times)
    : limit_(limit), times_(times), parallel_(threads), memory_(static_cast<std::size_t>(threads), Bytes(share_of(limit, bytes, threads), 1)) {
  if (limit == Limit::memory_copies) copies_ = memory_;
}

LimitMoves::LimitMoves(const FrameWork& work, int threads)
    : LimitMoves(work.limit, threads, memory_of(work.limit, threads, work.limited_bytes), times_for(work.limit, work.limited_bytes, kInTurns)) {}

void LimitMoves::run() {
  parallel_.for_each(memory_.size(), [this](std::size_t part, int) {
    for (std::uint64_t i = 0; i < times_; ++i) move(part, static_cast<int>(i & 1));
  });
}

// What is written counts as read, and what is found as used, so that no compiler leaves anything out.
void LimitMoves::move(std::size_t part, int turn) {
  Bytes& memory = memory_[part];
  const void* touched = memory.data();
  switch (limit_) {
    case Limit::memory_loads: touched = std::memchr(memory.data(), 2, memory.size()); break;
    case Limit::memory_copies: touched = std::memcpy(copies_[part].data(), memory.data(), memory.size()); break;
    default: std::memset(memory.data(), turn, memory.size());
  }
  asm volatile("" : : "r"(touched) : "memory");
}

double LimitMoves::bytes() const {
  double bytes = 0;
  for (const std::vector<Bytes>* list : {&memory_, &copies_})
    for (const Bytes& part : *list) bytes += static_cast<double>(part.size());
  return bytes * static_cast<double>(times_);
}

double measure_limit(Limit limit, int threads, std::uint64_t bytes) {
  LimitMoves moves(limit, threads, memory_of(limit, threads, bytes), times_for(limit, bytes, kAlone));
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
