// Reads the visibility buffer of a block.
#if defined(TESSERA_SHADING_VISIBILITY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_VISIBILITY_INL_H_
#undef TESSERA_SHADING_VISIBILITY_INL_H_
#else
#define TESSERA_SHADING_VISIBILITY_INL_H_
#endif

#include "raster/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Pixels of a block whose triangle numbers satisfy `predicate`, 16 bits.
template <class Predicate>
HWY_INLINE std::uint32_t pixels_where(const std::int32_t* visibility, Predicate predicate) {
  std::uint32_t bits = 0;
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
    bits |= mask_bits(kInt, predicate(hn::Load(kInt, visibility + chunk * kLanes))) << (chunk * kLanes);
  return bits;
}
HWY_INLINE std::uint32_t pixels_of(const std::int32_t* visibility, std::int32_t id) {
  const Int wanted = splat(id);
  return pixels_where(visibility, [wanted](Int at) HWY_ATTR { return hn::Eq(at, wanted); });
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
