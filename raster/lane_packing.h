// Packs some lanes of a vector side by side, and brings them back: numbers of lanes for a table lookup, from
// tables of eight bits at a time. Highway 1.0.3 packs with a table that it copies at each use, and has no way
// back.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace tessera::detail {

/// For each set of eight bits a word of eight bytes.
using LaneTable = std::array<std::uint64_t, 256>;

/// Byte j: the place of the set bit that has j others below it.
inline constexpr LaneTable kSetBits = [] {
  LaneTable table{};
  for (std::uint32_t bits = 0; bits < 256; ++bits) {
    int count = 0;
    for (int l = 0; l < 8; ++l)
      if ((bits >> l & 1) != 0) table[bits] |= static_cast<std::uint64_t>(l) << (8 * count++);
  }
  return table;
}();

/// Byte l: how many bits are set below bit l.
inline constexpr LaneTable kBitRanks = [] {
  LaneTable table{};
  for (std::uint32_t bits = 0; bits < 256; ++bits)
    for (int l = 0; l < 8; ++l)
      table[bits] |= static_cast<std::uint64_t>(std::popcount(bits & ((1u << l) - 1))) << (8 * l);
  return table;
}();

/// Which lane each lane takes, for up to 16; the bytes after those are never looked at.
struct LaneShuffle {
  std::uint8_t byte[24] = {};
};

/// What the table says of the second eight lanes goes to byte `second_at`, and counts from `offset`.
template <int kLanes>
LaneShuffle lane_shuffle(const LaneTable& table, std::uint32_t bits, int second_at, int offset) {
  static_assert(kLanes <= 16);
  LaneShuffle numbers;
  std::memcpy(numbers.byte, &table[bits & 255], 8);
  if constexpr (kLanes > 8) {
    const std::uint64_t second =
        table[bits >> 8 & 255] + 0x0101010101010101u * static_cast<std::uint64_t>(offset);
    std::memcpy(numbers.byte + second_at, &second, 8);
  }
  return numbers;
}

/// The lanes whose bit is set come first, in their order; what follows them is any lane.
template <int kLanes>
LaneShuffle compress_lanes(std::uint32_t bits) {
  return lane_shuffle<kLanes>(kSetBits, bits, std::popcount(bits & 255), 8);
}
/// Takes packed lanes back to those whose bit is set; the others get any lane.
template <int kLanes>
LaneShuffle expand_lanes(std::uint32_t bits) {
  return lane_shuffle<kLanes>(kBitRanks, bits, 8, std::popcount(bits & 255));
}

}  // namespace tessera::detail
