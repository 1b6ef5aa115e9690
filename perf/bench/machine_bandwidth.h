// Memory bandwidth of this machine for several amounts of memory.
#pragma once

#include <cstdint>
#include <optional>

namespace tessera::bench {

/// 10^9 bytes/s; std::nullopt if there was no memory for the measurement.
struct MachineBandwidth {
  std::optional<double> l1_stores;
  std::optional<double> frame_stores;   ///< memset of one image
  std::optional<double> frame_copies;   ///< memcpy of one image
  std::optional<double> tile_stores;    ///< 64 KiB per thread: 4 bytes per pixel of a 128x128 tile
  std::optional<double> memory_stores;  ///< 256 MiB
  std::optional<double> memory_loads;   ///< 256 MiB
  std::optional<double> memory_loads_single_core;
};

/// @param frame_bytes  size of an image
/// @param seconds      per figure, at most
MachineBandwidth measure_machine_bandwidth(int threads, std::uint64_t frame_bytes, double seconds);

}  // namespace tessera::bench
