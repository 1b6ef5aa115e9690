// Packs some lanes of a vector side by side, and brings them back. Highway 1.0.3 packs with a table that it copies at each use, and
// has no way back.
#if defined(TESSERA_RASTER_LANE_PACKING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_RASTER_LANE_PACKING_INL_H_
#undef TESSERA_RASTER_LANE_PACKING_INL_H_
#else
#define TESSERA_RASTER_LANE_PACKING_INL_H_
#endif

#include <bit>
#include <cstring>

#include "raster/lane_packing.h"
#include "raster/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// From numbers of lanes, a byte each. What the table says of the second eight lanes goes to byte `second_at`, and counts from `offset`.
template <class Tag>
HWY_INLINE auto lane_indices(Tag tag, const LaneTable& table, std::uint32_t bits, int second_at, int offset) {
  std::uint8_t numbers[24];
  std::memcpy(numbers, &table[bits & 255], 8);
  if constexpr (kLanes > 8) {
    const std::uint64_t second = table[bits >> 8 & 255] + 0x0101010101010101u * static_cast<std::uint64_t>(offset);
    std::memcpy(numbers + second_at, &second, 8);
  }
  return hn::IndicesFromVec(tag, hn::PromoteTo(kInt, hn::LoadU(hn::Rebind<std::uint8_t, IntTag>(), numbers)));
}

/// For TableLookupLanes: the lanes whose bit is set come first, in their order; what follows them is anything.
template <class Tag>
HWY_INLINE auto packing_of(Tag tag, std::uint32_t bits) {
  return lane_indices(tag, kSetBits, bits, std::popcount(bits & 255), 8);
}
/// For TableLookupLanes: takes packed lanes back to those whose bit is set; the others get anything.
template <class Tag>
HWY_INLINE auto unpacking_of(Tag tag, std::uint32_t bits) {
  return lane_indices(tag, kBitRanks, bits, 8, std::popcount(bits & 255));
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
