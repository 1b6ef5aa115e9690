// x^y in lanes for highlights and cones: products if y is a small whole number, as in most materials,
// otherwise polynomials evaluated in a fixed order; bit-identical on every target. Twin: power_reference.h.
// Coefficients: Chebyshev fits of log2(1 + t) / t on [sqrt(1/2) - 1, sqrt(2) - 1] (relative error 7.8e-9) and
// of 2^t on [-1/2, 1/2] (2.0e-9); the remaining error is rounding.
#if defined(TESSERA_SHADING_POWER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_POWER_INL_H_
#undef TESSERA_SHADING_POWER_INL_H_
#else
#define TESSERA_SHADING_POWER_INL_H_
#endif

#include <cstddef>

#include "raster/lanes-inl.h"
#include "shading/power.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
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
  // Adding and subtracting 1.5 * 2^23 rounds to the nearest integer, ties to even, on all targets.
  const Float rounded = hn::Sub(hn::Add(x, splat(kRoundingBias)), splat(kRoundingBias));
  const Int whole = truncate(rounded);
  const Float t = hn::Sub(x, rounded);
  Float p = splat(kExp2Coefficients[0]);
  for (int k = 1; k < kExp2Terms; ++k) p = mul_add(p, t, splat(kExp2Coefficients[k]));
  return hn::BitCast(kFloat, hn::Add(hn::BitCast(kInt, p), hn::ShiftLeft<23>(whole)));
}

/// x^y for y > 0; 0 for x <= 0 or NaN. Results are clamped to 2^-126 .. 2^96.
HWY_INLINE Float power_lanes(Float x, float y) {
  const auto positive = hn::Gt(x, hn::Zero(kFloat));
  const Float safe = greater_of(x, splat(kMinNormal));
  Float product = hn::Mul(log2_lanes(safe), splat(y));
  product = lesser_of(greater_of(product, splat(-126.0f)), splat(kMaxLog2));
  return hn::IfThenElseZero(positive, exp2_lanes(product));
}

/// x^n in place for n = 1 .. kMaxIntegerExponent, by products of squares, with the error of n - 1 roundings.
/// - 0 for x <= 0 or NaN. Positive x below `min_base` counts as min_base. Results are at most 2^96.
/// - Takes several x at a time, because the branches on n are the same for all.
/// @param min_base  2^min_base_log2(n)
template <std::size_t kCount>
HWY_INLINE void integer_power_lanes(Float (&x)[kCount], int n, float min_base) {
  Float square[kCount], product[kCount];
  for (std::size_t i = 0; i < kCount; ++i) {
    square[i] = greater_of(x[i], splat(min_base));
    product[i] = splat(1.0f);
  }
  for (int rest = n;;) {
    if ((rest & 1) != 0)
      for (std::size_t i = 0; i < kCount; ++i) product[i] = hn::Mul(product[i], square[i]);
    rest >>= 1;
    if (rest == 0) break;
    for (std::size_t i = 0; i < kCount; ++i) square[i] = hn::Mul(square[i], square[i]);
  }
  for (std::size_t i = 0; i < kCount; ++i)
    x[i] = hn::IfThenElseZero(hn::Gt(x[i], hn::Zero(kFloat)), lesser_of(product[i], splat(kMaxPower)));
}

/// Calls run(raise), where raise(x) raises the elements of an array to `power` in place: the method is chosen
/// once for many x. x^0 is 1 for any x.
template <class Run>
HWY_INLINE void with_power(const Power& power, const Run& run) {
  if (power.whole != 0) {
    run([power]<std::size_t kCount>(Float(&x)[kCount])
            HWY_ATTR { integer_power_lanes(x, power.whole, power.min_base); });
  } else if (power.exponent == 0) {
    run([]<std::size_t kCount>(Float(&x)[kCount]) HWY_ATTR {
      for (Float& element : x) element = splat(1.0f);
    });
  } else {
    run([power]<std::size_t kCount>(Float(&x)[kCount]) HWY_ATTR {
      for (Float& element : x) element = power_lanes(element, power.exponent);
    });
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
