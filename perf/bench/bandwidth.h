// How fast this machine moves bytes: what fills, clears and plane stores are held against.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/runtime/worker_pool.h"
#include "perf/bench/workload.h"

namespace tessera::bench {
using namespace detail;

/// Moves bytes as fast as the C library does: each thread its share of a memory, a byte at least, again and
/// again.
class BandwidthKernel {
 public:
  /// @param roofline   not none
  /// @param threads 1 or more
  /// @param bytes   of the memory, of all threads together (of copies, what is read and what is written);
  /// stores in L1 have 16 KiB for each thread, whatever stands here
  /// @param moved   by a run(), about: the memory, once at least and a million times at most; stores in L1
  /// move theirs 20,000 times
  BandwidthKernel(Roofline roofline, int threads, std::uint64_t bytes, std::uint64_t moved);

  void run();
  /// That a run() moves.
  double bytes() const;

 private:
  /// Of a cache whose lines have 64 bytes; no two threads write to one.
  struct alignas(64) Line {
    std::uint8_t bytes[64];
  };
  using Lines = std::vector<Line>;
  void move(std::size_t part, int turn);

  Roofline roofline_;
  std::size_t share_;  // bytes of each thread
  std::uint64_t times_;
  WorkerPool worker_pool_;
  std::vector<Lines> memory_, copies_;  // of each thread
};

/// What a frame's work is held against.
/// @pre there is a roofline
BandwidthKernel bandwidth_kernel_for(const FrameWork& work, int threads, std::uint64_t moved);

/// In 10^9 bytes a second, of all threads together: the median of several runs.
///
/// @param roofline  not none
/// @param bytes  of the memory, as of BandwidthKernel
double measure_bandwidth(Roofline roofline, int threads, std::uint64_t bytes);

}  // namespace tessera::bench
