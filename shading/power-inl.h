// x^y in lanes for highlights and cones: own polynomials in a fixed order, the same bits on every target. Twin:
// power_reference.h. Coefficients: Chebyshev fits of log2(1 + t) / t on [sqrt(1/2) - 1, sqrt(2) - 1] (relative error 7.8e-9)
// and of 2^t on [-1/2, 1/2] (2.0e-9); what is lost beyond them is rounding.
#if defined(TESSERA_SHADING_POWER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_POWER_INL_H_
#undef TESSERA_SHADING_POWER_INL_H_
#else
#define TESSERA_SHADING_POWER_INL_H_
#endif

#include "raster/lanes-inl.h"
#include "shading/power.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// log2 of positive normal numbers. Exact at powers of two.
HWY_INLINE Float log2_lanes(Float x) {
  const Int bits = hn::BitCast(kInt, x);
  // x = m 2^e with m in [sqrt(1/2), sqrt(2)).
  const Int exponent = hn::ShiftRight<23>(hn::Sub(bits, splat(kSqrtHalfBits)));
  const Float t = hn::Sub(hn::BitCast(kFloat, hn::Sub(bits, hn::ShiftLeft<23>(exponent))), splat(1.0f));
  Float p = splat(kLog2Coefficients[0]);
  for (int k = 1; k < kLog2Terms; ++k) p = mul_add(p, t, splat(kLog2Coefficients[k]));
  return mul_add(p, t, hn::ConvertTo(kFloat, exponent));
}

/// 2^x for x in [-126, 127].
HWY_INLINE Float exp2_lanes(Float x) {
  // Adding and taking away 1.5 * 2^23 rounds to the nearest integer, ties to even, by the same exact steps everywhere.
  const Float rounded = hn::Sub(hn::Add(x, splat(kRoundingBias)), splat(kRoundingBias));
  const Int whole = truncate(rounded);
  const Float t = hn::Sub(x, rounded);
  Float p = splat(kExp2Coefficients[0]);
  for (int k = 1; k < kExp2Terms; ++k) p = mul_add(p, t, splat(kExp2Coefficients[k]));
  return hn::BitCast(kFloat, hn::Add(hn::BitCast(kInt, p), hn::ShiftLeft<23>(whole)));
}

/// x^y for y > 0; 0 for x <= 0 or NaN. Results below 2^-126 come out as 2^-126, above 2^96 as that.
HWY_INLINE Float power_lanes(Float x, float y) {
  const auto positive = hn::Gt(x, hn::Zero(kFloat));
  const Float safe = greater_of(x, splat(kSmallestNormal));
  Float product = hn::Mul(log2_lanes(safe), splat(y));
  product = lesser_of(greater_of(product, splat(-126.0f)), splat(kLargestLog2));
  return hn::IfThenElseZero(positive, exp2_lanes(product));
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
