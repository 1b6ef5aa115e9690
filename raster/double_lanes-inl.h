// Doubles for every lane of an Int, in two vectors, for values of more than 32 bits. Rounded the same on
// every target: no multiply-add is fused.
#if defined(TESSERA_RASTER_DOUBLE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_RASTER_DOUBLE_LANES_INL_H_
#undef TESSERA_RASTER_DOUBLE_LANES_INL_H_
#else
#define TESSERA_RASTER_DOUBLE_LANES_INL_H_
#endif

#include "raster/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

inline constexpr int kDoubleParts = kLanes > 1 ? 2 : 1;
using DoubleTag = hn::CappedTag<double, kLanes / kDoubleParts>;
using Double = hn::Vec<DoubleTag>;
inline constexpr DoubleTag kDouble{};

struct Doubles {
  Double part[kDoubleParts];
};

template <class Function>
HWY_INLINE Doubles each_part(const Function& function) {
  Doubles result;
  for (int p = 0; p < kDoubleParts; ++p) result.part[p] = function(p);
  return result;
}
HWY_INLINE Doubles plus(const Doubles& a, const Doubles& b) {
  return each_part([&](int p) HWY_ATTR { return hn::Add(a.part[p], b.part[p]); });
}
HWY_INLINE Doubles plus(const Doubles& a, double b) {
  return each_part([&](int p) HWY_ATTR { return hn::Add(a.part[p], hn::Set(kDouble, b)); });
}
HWY_INLINE Doubles times(const Doubles& a, double b) {
  return each_part([&](int p) HWY_ATTR { return hn::Mul(a.part[p], hn::Set(kDouble, b)); });
}
HWY_INLINE Doubles times(const Doubles& a, const Doubles& b) {
  return each_part([&](int p) HWY_ATTR { return hn::Mul(a.part[p], b.part[p]); });
}
HWY_INLINE Doubles reciprocals(const Doubles& a) {
  return each_part([&](int p) HWY_ATTR { return hn::Div(hn::Set(kDouble, 1.0), a.part[p]); });
}
HWY_INLINE void store(const Doubles& a, double* to) {
  for (int p = 0; p < kDoubleParts; ++p) hn::Store(a.part[p], kDouble, to + p * kLanes / kDoubleParts);
}
HWY_INLINE Doubles floor(const Doubles& a) {
  return each_part([&](int p) HWY_ATTR { return hn::Floor(a.part[p]); });
}
/// Clamps to low .. high; NaN becomes low.
HWY_INLINE Doubles clamped(const Doubles& a, double low, double high) {
  return each_part([&](int p) HWY_ATTR {
    return hn::Min(hn::Max(a.part[p], hn::Set(kDouble, low)), hn::Set(kDouble, high));
  });
}

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE Doubles to_doubles(Int a) { return {hn::PromoteTo(kDouble, a)}; }
/// Rounds towards zero. @pre the result fits in 32 bits
HWY_INLINE Int truncate(const Doubles& a) { return hn::DemoteTo(kInt, a.part[0]); }
HWY_INLINE Float to_floats(const Doubles& a) { return hn::DemoteTo(kFloat, a.part[0]); }
#else
inline constexpr hn::Half<IntTag> kHalfInt{};
inline constexpr hn::Half<FloatTag> kHalfFloat{};
HWY_INLINE Doubles to_doubles(Int a) {
  return {{hn::PromoteTo(kDouble, hn::LowerHalf(kHalfInt, a)),
           hn::PromoteTo(kDouble, hn::UpperHalf(kHalfInt, a))}};
}
HWY_INLINE Int truncate(const Doubles& a) {
  return hn::Combine(kInt, hn::DemoteTo(kHalfInt, a.part[1]), hn::DemoteTo(kHalfInt, a.part[0]));
}
HWY_INLINE Float to_floats(const Doubles& a) {
  return hn::Combine(kFloat, hn::DemoteTo(kHalfFloat, a.part[1]), hn::DemoteTo(kHalfFloat, a.part[0]));
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
