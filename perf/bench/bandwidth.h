// Memory bandwidth of this machine: the rooflines of fills, clears and plane stores.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/runtime/worker_pool.h"
#include "perf/bench/workload.h"

namespace tessera::bench {
using namespace detail;

/// Moves bytes at the speed of the C library: each thread repeatedly passes over its share of a memory block.
class BandwidthKernel {
 public:
  /// @param roofline  not Roofline::none
  /// @param threads   1 or more
  /// @param bytes     memory of all threads together, at least a byte each; for copies, source plus
  ///                  destination. Ignored by Roofline::l1_stores, which uses 16 KiB per thread
  /// @param moved     approximate bytes per run(), rounded to 1 to 1,000,000 passes over the memory.
  ///                  Ignored by Roofline::l1_stores, which makes 20,000 passes
  BandwidthKernel(Roofline roofline, int threads, std::uint64_t bytes, std::uint64_t moved);

  void run();
  /// Bytes that one run() moves.
  double bytes() const;

 private:
  /// One cache line, so that no two threads write to the same one.
  struct alignas(64) Line {
    std::uint8_t bytes[64];
  };
  using Lines = std::vector<Line>;
  void move(std::size_t part, int turn);

  Roofline roofline_;
  std::size_t share_bytes_;  // per thread
  std::uint64_t passes_;     // per run()
  WorkerPool worker_pool_;
  std::vector<Lines> memory_;  // per thread
  std::vector<Lines> copies_;  // per thread; copies only
};

/// The kernel for a frame's roofline.
/// @pre work.roofline is not Roofline::none
BandwidthKernel bandwidth_kernel_for(const FrameWork& work, int threads, std::uint64_t moved);

/// Rate of all threads together in 10^9 bytes/s: the median of several runs.
/// @param roofline  not Roofline::none
/// @param bytes     as in BandwidthKernel
/// @param seconds   no run begins later than this, except the first
double measure_bandwidth(Roofline roofline, int threads, std::uint64_t bytes, double seconds);

}  // namespace tessera::bench
