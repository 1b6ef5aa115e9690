// How fast this machine moves bytes: what fills, clears and plane stores are held against.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/parallel.h"
#include "perf/bench/workload.h"

namespace tessera::bench {

/// Moves bytes as fast as the C library does: each thread its share of a memory, a byte at least, again and again.
class LimitMoves {
 public:
  /// @param limit   not none
  /// @param threads 1 or more
  /// @param bytes   of the memory; of copies, what is read and what is written together
  /// @param times   that run() moves them
  LimitMoves(Limit limit, int threads, std::uint64_t bytes, std::uint64_t times);
  /// What a frame is held against: a memory of as many bytes as it moves, or of the first caches, so often that the start of a run is nothing beside it:
  /// 64 MiB, and 20,000 times those of the first caches.
  LimitMoves(const FrameWork& work, int threads);

  void run();
  /// That a run() moves.
  double bytes() const;

 private:
  using Bytes = std::vector<std::uint8_t>;
  void move(std::size_t part, int turn);

  Limit limit_;
  std::uint64_t times_;
  Parallel parallel_;
  std::vector<Bytes> memory_, copies_;  // of each thread
};

/// In 10^9 bytes a second, of all threads together: the median of several runs.
///
/// @param limit  not none
/// @param bytes  that a frame moves
double measure_limit(Limit limit, int threads, std::uint64_t bytes);

}  // namespace tessera::bench
