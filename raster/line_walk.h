// Pixels of a line by the diamond-exit rule, in exact integers [GL 2.1, 3.4.1]: a line produces a fragment
// for each pixel whose diamond |x - xc| + |y - yc| < 1/2 it exits. Ties at the border of a diamond are
// resolved by moving the line by (-e, -e^2), y up, for an infinitesimal e. Strips are therefore continuous,
// and no pixel is drawn twice at a joint of two segments in the same octant.
//
// Lines with slopes up to 1 have one pixel per column (x-major), all others one per row (y-major). Along the
// major axis a line enters the near half of a diamond and exits the far half; at a pixel's centre it is
// inside the diamond. Only the pixels at the two ends need the diamond test.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "framebuffer/tile_grid.h"
#include "raster/fixed_point.h"

namespace tessera::detail {

/// A point in raster space (y down), 1/256 pixel.
struct LinePoint {
  std::int32_t x, y;
};

/// True if a point, moved by (-e, +e^2) in raster space, is inside the diamond of the pixel that contains it
/// after the move.
constexpr bool in_diamond(LinePoint p) {
  // On a border between pixels the move selects the left one and the lower one.
  const std::int32_t dx = p.x - (((p.x - 1) >> kSubpixelBits << kSubpixelBits) + kHalfPixel);
  const std::int32_t dy = p.y - ((p.y >> kSubpixelBits << kSubpixelBits) + kHalfPixel);
  const std::int32_t distance = (dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy);
  return distance < kHalfPixel || (distance == kHalfPixel && dx > 0);
}

/// The pixels of one line, in steps along its major axis.
class LineWalk {
 public:
  /// @param width  pixels per step along the minor axis, at least 1 [GL 2.1, 3.4.2]
  /// @pre coordinates below 2^24
  constexpr LineWalk(LinePoint a, LinePoint b, int width = 1) : width_(width) {
    const std::int32_t dx = b.x - a.x, dy = b.y - a.y;
    x_major_ = std::abs(dx) >= std::abs(dy);
    // The lowest (x-major) or leftmost pixel of each step is that of a line of width 1, shifted by half of
    // width - 1.
    const std::int32_t aside = kHalfPixel * (width - 1);
    if (x_major_) {
      a.y += aside;
      b.y += aside;
    } else {
      a.x -= aside;
      b.x -= aside;
    }
    const std::int32_t along = x_major_ ? dx : dy;
    const std::int32_t across = x_major_ ? dy : dx;
    forward_ = along > 0;
    length_ = std::abs(along);
    rise_ = forward_ ? across : -across;
    start_major_ = x_major_ ? a.x : a.y;
    start_minor_ = x_major_ ? a.y : a.x;
    if (along == 0) return;
    const std::int32_t end_major = x_major_ ? b.x : b.y;
    const bool starts_in_near_half = is_before_center(start_major_) == forward_;
    const bool ends_in_near_half = is_before_center(end_major) == forward_;
    const int step = forward_ ? 1 : -1;
    first_ = pixel_of(start_major_);
    last_ = pixel_of(end_major);
    if (!starts_in_near_half && !in_diamond(a)) first_ += step;
    if (ends_in_near_half || in_diamond(b)) last_ -= step;
    empty_ = forward_ ? first_ > last_ : first_ < last_;
  }

  constexpr bool empty() const { return empty_; }
  constexpr bool x_major() const { return x_major_; }

  /// Calls pixel(x, y) for the line's pixels in `rect`, from its start to its end.
  template <class Pixel>
  constexpr void for_each(const PixelRect& rect, const Pixel& pixel) const {
    if (empty_ || rect.empty()) return;
    const int low = x_major_ ? rect.x0 : rect.y0, high = (x_major_ ? rect.x1 : rect.y1) - 1;
    const int from = std::max(std::min(first_, last_), low), to = std::min(std::max(first_, last_), high);
    if (from > to) return;
    const int step = forward_ ? 1 : -1;
    const int begin = forward_ ? from : to;
    const int count = to - from + 1;
    // The minor pixel coordinate at the centre of each step is floor(numerator / divisor); ties go in the
    // direction of the infinitesimal move.
    const std::int64_t divisor = std::int64_t{kSubpixelScale} * length_;
    const std::int64_t numerator =
        std::int64_t{start_minor_} * length_ +
        std::int64_t{rise_} * (std::int64_t{begin} * kSubpixelScale + kHalfPixel - start_major_) -
        (tie_goes_down() ? 1 : 0);
    std::int64_t minor = numerator / divisor;
    std::int64_t rest = numerator % divisor;
    if (rest < 0) {
      rest += divisor;
      --minor;
    }
    const std::int64_t change = std::int64_t{rise_} * kSubpixelScale * step;  // |change| <= divisor
    for (int i = 0, major = begin; i < count; ++i, major += step) {
      draw_step(rect, major, static_cast<int>(minor), pixel);
      rest += change;
      if (rest >= divisor) {
        rest -= divisor;
        ++minor;
      }
      if (rest < 0) {
        rest += divisor;
        --minor;
      }
    }
  }

 private:
  // The rule moves the ends by -e along x and by +e^2 along y.
  constexpr int pixel_of(std::int32_t major) const { return (x_major_ ? major - 1 : major) >> kSubpixelBits; }
  constexpr bool is_before_center(std::int32_t major) const {
    const std::int32_t center = pixel_of(major) * kSubpixelScale + kHalfPixel;
    return x_major_ ? major <= center : major < center;
  }
  // The move changes the minor coordinate by slope e + e^2 (x-major) or by -e (y-major).
  constexpr bool tie_goes_down() const { return x_major_ ? rise_ < 0 : true; }

  // The `width` pixels of a step: upwards (x-major) or to the right.
  template <class Pixel>
  constexpr void draw_step(const PixelRect& rect, int major, int minor, const Pixel& pixel) const {
    const int first = x_major_ ? minor - (rect.y1 - 1) : rect.x0 - minor;
    const int last = x_major_ ? minor - rect.y0 : rect.x1 - 1 - minor;
    for (int k = std::max(first, 0); k <= std::min(last, width_ - 1); ++k)
      pixel(x_major_ ? major : minor + k, x_major_ ? minor - k : major);
  }

  int width_ = 1;
  bool x_major_ = true;
  bool forward_ = true;  // towards larger major coordinates
  bool empty_ = true;
  std::int32_t length_ = 0;  // along the major axis
  std::int32_t rise_ = 0;    // along the minor axis, per length_ in the direction of larger major coordinates
  std::int32_t start_major_ = 0, start_minor_ = 0;
  int first_ = 0, last_ = 0;  // major pixel coordinates of the first and the last step, inclusive
};

}  // namespace tessera::detail
