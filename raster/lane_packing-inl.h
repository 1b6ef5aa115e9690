// Lane packing (lane_packing.h) as indices for TableLookupLanes.
#if defined(TESSERA_RASTER_LANE_PACKING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_RASTER_LANE_PACKING_INL_H_
#undef TESSERA_RASTER_LANE_PACKING_INL_H_
#else
#define TESSERA_RASTER_LANE_PACKING_INL_H_
#endif

#include "raster/lane_packing.h"
#include "raster/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Replaces hn::IndicesFromVec(), whose checks in debug builds need Highway's library.
template <class Tag>
HWY_INLINE auto lane_indices(Tag tag, const LaneShuffle& shuffle) {
  const Int lanes = hn::PromoteTo(kInt, hn::LoadU(hn::Rebind<std::uint8_t, IntTag>(), shuffle.byte));
  return decltype(hn::IndicesFromVec(tag, lanes)){lanes.raw};
}

template <class Tag>
HWY_INLINE auto compress_indices(Tag tag, std::uint32_t bits) {
  return lane_indices(tag, compress_lanes<kLanes>(bits));
}
template <class Tag>
HWY_INLINE auto expand_indices(Tag tag, std::uint32_t bits) {
  return lane_indices(tag, expand_lanes<kLanes>(bits));
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
