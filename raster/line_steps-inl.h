// Lines of one sample, vectorized along the major axis: the pixels of line_walk.h (the twin), in any order.
//
// The minor coordinate of a step is floor(n / d) with integers n and d, d = 256 length < 2^33. Computed as
// floor((n + 1/2) (1 / d)), it is exact:
// - (n + 1/2) / d is at least 1 / (2 d) > 2^-34 away from integers.
// - It is below 2^17 (coordinates up to 2^16 pixels, half a width up to 2^15, a vector of steps beyond the
//   end), so the errors of reciprocal and product are at most 2^-35.
// - n + 1/2 is below 2^51, so all sums are exact.
#if defined(TESSERA_RASTER_LINE_STEPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_RASTER_LINE_STEPS_INL_H_
#undef TESSERA_RASTER_LINE_STEPS_INL_H_
#else
#define TESSERA_RASTER_LINE_STEPS_INL_H_
#endif

#include <algorithm>

#include "framebuffer/tile_grid.h"
#include "raster/double_lanes-inl.h"
#include "raster/fixed_point.h"
#include "raster/triangle_setup.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// One point in raster space per lane.
struct LinePoints {
  Int x, y;
};

/// Vector form of in_diamond().
HWY_INLINE auto are_in_diamonds(const LinePoints& p) {
  const Int within_pixel = splat(kSubpixelScale - 1);
  const Int half = splat(kHalfPixel);
  const Int one = splat(1);
  const Int dx = hn::Sub(hn::And(hn::Sub(p.x, one), within_pixel), hn::Sub(half, one));
  const Int dy = hn::Sub(hn::And(p.y, within_pixel), half);
  const Int distance = hn::Add(hn::Abs(dx), hn::Abs(dy));
  return hn::Or(hn::Gt(half, distance), hn::And(hn::Eq(distance, half), hn::Gt(dx, hn::Zero(kInt))));
}

class LineSteps {
 public:
  /// Sets up all lines of a group, `width` pixels wide. @pre coordinates below 2^24
  HWY_NOINLINE void set_up(const TriangleGroup& g, int width) {
    width_ = width;
    for (int i = 0; i < g.count; i += kLanes) set_up_lanes(g, i);
  }
  /// Calls pixels(x, y, inside) with vectors of pixels of line i. Each pixel of the line in `window` is in
  /// exactly one lane with `inside` set.
  template <class Pixels>
  HWY_INLINE void for_each(int i, const PixelRect& window, const Pixels& pixels) const {
    const bool x_major = x_major_[i] != 0;
    const int from = std::max(first_[i], x_major ? window.x0 : window.y0);
    const int to = std::min(last_[i] + 1, x_major ? window.x1 : window.y1);
    // Range of the minor coordinate.
    const int low = x_major ? window.y0 : window.x0;
    const int high = x_major ? window.y1 : window.x1;
    for (int step = from; step < to; step += kLanes) {
      const Int major = hn::Iota(kInt, step);
      const Int base =
          truncate(floor(times(plus(times(to_doubles(major), rise_[i]), start_[i]), reciprocal_[i])));
      // Pixels k across the line, upwards (x-major) or to the right, that may be inside.
      int k0 = 0, k1 = 0;
      if (width_ > 1) {
        alignas(64) std::int32_t bases[kLanes];
        hn::Store(base, kInt, bases);
        const auto [lowest, highest] = std::minmax(bases[0], bases[std::min(kLanes, to - step) - 1]);
        k0 = std::max(x_major ? lowest - (high - 1) : low - highest, 0);
        k1 = std::min(x_major ? highest - low : high - 1 - lowest, width_ - 1);
      }
      for (int k = k0; k <= k1; ++k) {
        const Int minor = hn::Add(base, splat(x_major ? -k : k));
        const auto inside = hn::And(hn::Gt(splat(to), major),
                                    hn::And(hn::Gt(minor, splat(low - 1)), hn::Gt(splat(high), minor)));
        pixels(x_major ? major : minor, x_major ? minor : major, inside);
      }
    }
  }

 private:
  HWY_INLINE void set_up_lanes(const TriangleGroup& g, int i) {
    const Int zero = hn::Zero(kInt), one = splat(1);
    const Int aside = splat(kHalfPixel * (width_ - 1));  // shift of wide lines along the minor axis
    LinePoints a{hn::Load(kInt, g.x[0] + i), hn::Load(kInt, g.y[0] + i)};
    LinePoints b{hn::Load(kInt, g.x[1] + i), hn::Load(kInt, g.y[1] + i)};
    const Int dx = hn::Sub(b.x, a.x), dy = hn::Sub(b.y, a.y);
    const auto steep = hn::Gt(hn::Abs(dy), hn::Abs(dx));
    for (LinePoints* p : {&a, &b})
      *p = {hn::Sub(p->x, hn::IfThenElseZero(steep, aside)), hn::Add(p->y, hn::IfThenZeroElse(steep, aside))};
    const Int along = hn::IfThenElse(steep, dy, dx);
    const Int across = hn::IfThenElse(steep, dx, dy);
    const auto forward = hn::Gt(along, zero);
    // The rule moves the ends by -e along x and by +e^2 along y.
    const Int moved = hn::IfThenZeroElse(steep, one);
    const Int from = hn::IfThenElse(steep, a.y, a.x);
    const Int to = hn::IfThenElse(steep, b.y, b.x);
    const Int from_moved = hn::Sub(from, moved);
    const Int to_moved = hn::Sub(to, moved);
    const Int step = hn::IfThenElse(forward, one, splat(-1));
    const auto is_before_center = [&](Int major) HWY_ATTR {
      return hn::Gt(splat(kHalfPixel), hn::And(major, splat(kSubpixelScale - 1)));
    };
    const auto skips_first = hn::AndNot(are_in_diamonds(a), hn::Xor(forward, is_before_center(from_moved)));
    const auto skips_last = hn::Or(are_in_diamonds(b), hn::Not(hn::Xor(forward, is_before_center(to_moved))));
    const Int begin =
        hn::Add(hn::ShiftRight<kSubpixelBits>(from_moved), hn::IfThenElseZero(skips_first, step));
    const Int end = hn::Sub(hn::ShiftRight<kSubpixelBits>(to_moved), hn::IfThenElseZero(skips_last, step));
    const auto is_point = hn::Eq(along, zero);
    hn::Store(hn::VecFromMask(kInt, hn::Not(steep)), kInt, x_major_ + i);
    hn::Store(hn::IfThenElse(is_point, one, hn::IfThenElse(forward, begin, end)), kInt, first_ + i);
    hn::Store(hn::IfThenZeroElse(is_point, hn::IfThenElse(forward, end, begin)), kInt, last_ + i);

    const Int slope = hn::IfThenElse(forward, across, hn::Neg(across));
    const Int minor = hn::IfThenElse(steep, a.x, a.y);
    const auto tie_goes_down = hn::Or(steep, hn::Gt(zero, slope));
    const Doubles length = to_doubles(hn::Max(hn::Abs(along), one));
    const Doubles scaled = times(length, kSubpixelScale);
    const Doubles at_first = times(to_doubles(minor), length);
    const Doubles to_center = times(to_doubles(slope), to_doubles(hn::Sub(splat(kHalfPixel), from)));
    const Doubles tie = plus(to_doubles(hn::IfThenElseZero(tie_goes_down, splat(-1))), 0.5);
    store(plus(plus(at_first, to_center), tie), start_ + i);
    store(times(to_doubles(slope), kSubpixelScale), rise_ + i);
    store(reciprocals(scaled), reciprocal_ + i);
  }

  int width_ = 1;
  alignas(64) std::int32_t x_major_[kGroupSize];  // -1 or 0
  // Steps along the major axis, inclusive, ascending; first > last: no pixels.
  alignas(64) std::int32_t first_[kGroupSize], last_[kGroupSize];
  // Minor coordinate of a step: floor((start + step rise) reciprocal).
  alignas(64) double start_[kGroupSize];
  alignas(64) double rise_[kGroupSize];
  alignas(64) double reciprocal_[kGroupSize];  // 1 / (256 length)
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
