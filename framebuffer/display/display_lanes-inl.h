// Vectors of floats of the display kernels. Every operation rounds once on every target.
#if defined(TESSERA_DISPLAY_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_DISPLAY_LANES_INL_H_
#undef TESSERA_DISPLAY_LANES_INL_H_
#else
#define TESSERA_DISPLAY_LANES_INL_H_
#endif

#include <cmath>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::ScalableTag<std::int32_t>;
using FloatVec = hn::Vec<FloatTag>;
using IntVec = hn::Vec<IntTag>;
inline constexpr FloatTag kFloats{};
inline constexpr IntTag kInts{};
inline constexpr int kFloatLanes = static_cast<int>(hn::MaxLanes(FloatTag()));

/// a b + c, rounded once on every target.
HWY_INLINE FloatVec mul_add(FloatVec a, FloatVec b, FloatVec c) {
#if HWY_TARGET == HWY_SCALAR
  return FloatVec(std::fma(a.raw, b.raw, c.raw));
#else
  return hn::MulAdd(a, b, c);
#endif
}

HWY_INLINE FloatVec splat(float value) { return hn::Set(kFloats, value); }
HWY_INLINE FloatVec load(const float* values) { return hn::LoadU(kFloats, values); }
HWY_INLINE void store(FloatVec values, float* target) { hn::StoreU(values, kFloats, target); }

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
