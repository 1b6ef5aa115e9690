// Tables for packing lanes, eight at a time: a word of bytes for each set of bits.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace tessera {

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
    for (int l = 0; l < 8; ++l) table[bits] |= static_cast<std::uint64_t>(std::popcount(bits & ((1u << l) - 1))) << (8 * l);
  return table;
}();

}  // namespace tessera
