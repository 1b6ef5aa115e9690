#include "perf/bench/machine_bandwidth.h"

#include <new>

#include "perf/bench/bandwidth.h"

namespace tessera::bench {

MachineBandwidth measure_machine_bandwidth(int threads, std::uint64_t frame_bytes, double seconds) {
  constexpr std::uint64_t kMemoryBytes = std::uint64_t{256} << 20;
  constexpr std::uint64_t kTileBytes = std::uint64_t{64} << 10;
  const auto rate_of = [seconds](Roofline roofline, int on_threads,
                                 std::uint64_t bytes) -> std::optional<double> {
    try {
      return measure_bandwidth(roofline, on_threads, bytes, seconds);
    } catch (const std::bad_alloc&) {
      return {};  // keep the other results
    }
  };
  const auto rate = [&](Roofline roofline, std::uint64_t bytes) { return rate_of(roofline, threads, bytes); };
  return {.l1_stores = rate(Roofline::l1_stores, 0),
          .frame_stores = rate(Roofline::memory_stores, frame_bytes),
          .frame_copies = rate(Roofline::memory_copies, 2 * frame_bytes),
          .tile_stores = rate(Roofline::memory_stores, kTileBytes * static_cast<std::uint64_t>(threads)),
          .memory_stores = rate(Roofline::memory_stores, kMemoryBytes),
          .memory_loads = rate(Roofline::memory_loads, kMemoryBytes),
          .memory_loads_single_core = rate_of(Roofline::memory_loads, 1, kMemoryBytes)};
}

}  // namespace tessera::bench
