// Compresses selected lanes of a vector and expands them again: lane indices for a table lookup, from tables
// indexed by eight mask bits. Highway 1.0.3 copies its table at every Compress() and has no Expand().
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace tessera::detail {

/// Eight bytes per 8-bit mask.
using LaneTable = std::array<std::uint64_t, 256>;

/// Byte j: position of the j-th set bit, counted from 0.
inline constexpr LaneTable kSetBits = [] {
  LaneTable table{};
  for (std::uint32_t bits = 0; bits < 256; ++bits) {
    int count = 0;
    for (int l = 0; l < 8; ++l)
      if ((bits >> l & 1) != 0) table[bits] |= static_cast<std::uint64_t>(l) << (8 * count++);
  }
  return table;
}();

/// Byte l: number of set bits below bit l.
inline constexpr LaneTable kBitRanks = [] {
  LaneTable table{};
  for (std::uint32_t bits = 0; bits < 256; ++bits)
    for (int l = 0; l < 8; ++l)
      table[bits] |= static_cast<std::uint64_t>(std::popcount(bits & ((1u << l) - 1))) << (8 * l);
  return table;
}();

/// Source lane of each lane, for up to 16 lanes; the remaining bytes are unused.
struct LaneShuffle {
  std::uint8_t byte[24] = {};
};

/// Combines the table entries of the lower and upper eight mask bits. The upper one is stored at byte
/// `second_at`, with `offset` added to its indices.
template <int kLanes>
LaneShuffle lane_shuffle(const LaneTable& table, std::uint32_t bits, int second_at, int offset) {
  static_assert(kLanes <= 16);
  LaneShuffle shuffle;
  std::memcpy(shuffle.byte, &table[bits & 255], 8);
  if constexpr (kLanes > 8) {
    const std::uint64_t second =
        table[bits >> 8 & 255] + 0x0101010101010101u * static_cast<std::uint64_t>(offset);
    std::memcpy(shuffle.byte + second_at, &second, 8);
  }
  return shuffle;
}

/// Moves the lanes whose bit is set to the front, in order; the remaining lanes are arbitrary.
template <int kLanes>
LaneShuffle compress_lanes(std::uint32_t bits) {
  return lane_shuffle<kLanes>(kSetBits, bits, std::popcount(bits & 255), 8);
}
/// Moves compressed lanes back to the lanes whose bit is set; the other lanes are arbitrary.
template <int kLanes>
LaneShuffle expand_lanes(std::uint32_t bits) {
  return lane_shuffle<kLanes>(kBitRanks, bits, 8, std::popcount(bits & 255));
}

}  // namespace tessera::detail
