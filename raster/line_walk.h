// Which pixels a line covers, by the diamond-exit rule in exact integers [GL 2.1, 3.4.1]: a line makes a
// fragment of each pixel whose diamond |x - xc| + |y - yc| < 1/2 it leaves. Points on the border of a diamond
// are moved by (-e, -e^2), y up, for an e that is as small as need be. So strips are continuous, and no pixel
// is drawn twice at a joint that goes on in the same octant.
//
// Lines of slopes up to 1 have one pixel a column (x-major), all others one a row. Along the major axis a
// line enters the diamond's near half and leaves by the far one: what passes a pixel's centre is in its
// diamond there, and only the ends ask for the diamond.
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

/// Whether a point, moved by (-e, +e^2) in raster space, is inside the diamond of the pixel that then holds
/// it.
constexpr bool in_diamond(LinePoint p) {
  // The pixel that holds the moved point: of two neighbours the left one, and the lower one.
  const std::int32_t dx = p.x - (((p.x - 1) >> kSubpixelBits << kSubpixelBits) + kHalfPixel),
                     dy = p.y - ((p.y >> kSubpixelBits << kSubpixelBits) + kHalfPixel);
  const std::int32_t distance = (dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy);
  return distance < kHalfPixel || (distance == kHalfPixel && dx > 0);
}

/// The pixels of one line, one for each step along its major axis.
class LineWalk {
 public:
  /// A line of `width` pixels, 1 or more [GL 2.1, 3.4.2]: each step has so many pixels along the minor axis.
  /// @pre coordinates below 2^24
  constexpr LineWalk(LinePoint a, LinePoint b, int width = 1) : width_(width) {
    const std::int32_t dx = b.x - a.x, dy = b.y - a.y;
    x_major_ = std::abs(dx) >= std::abs(dy);
    // The lowest (x-major) or leftmost pixel of each step belongs to a line of width 1.
    const std::int32_t aside = kHalfPixel * (width - 1);
    (x_major_ ? a.y : a.x) += x_major_ ? aside : -aside;
    (x_major_ ? b.y : b.x) += x_major_ ? aside : -aside;
    const std::int32_t along = x_major_ ? dx : dy, across = x_major_ ? dy : dx;
    forward_ = along > 0;
    length_ = std::abs(along);
    rise_ = forward_ ? across : -across;
    start_major_ = x_major_ ? a.x : a.y;
    start_minor_ = x_major_ ? a.y : a.x;
    if (along == 0) return;
    first_ = pixel_of(start_major_);
    if (!(forward_ ? is_before_center(start_major_) : !is_before_center(start_major_)) && !in_diamond(a))
      first_ += forward_ ? 1 : -1;
    const std::int32_t end = x_major_ ? b.x : b.y;
    last_ = pixel_of(end);
    if ((forward_ ? is_before_center(end) : !is_before_center(end)) || in_diamond(b))
      last_ += forward_ ? -1 : 1;
    if (forward_ ? first_ > last_ : first_ < last_) return;
    empty_ = false;
  }

  constexpr bool empty() const { return empty_; }
  constexpr bool x_major() const { return x_major_; }

  /// Calls pixel(x, y) for those in `rect`, from the line's start to its end.
  template <class Pixel>
  constexpr void for_each(const PixelRect& rect, const Pixel& pixel) const {
    if (empty_ || rect.empty()) return;
    const int low = x_major_ ? rect.x0 : rect.y0, high = (x_major_ ? rect.x1 : rect.y1) - 1;
    const int from = std::max(std::min(first_, last_), low), to = std::min(std::max(first_, last_), high);
    if (from > to) return;
    const int step = forward_ ? 1 : -1, begin = forward_ ? from : to, count = to - from + 1;
    // minor / 256 = numerator / divisor, rounded down, at the centre of each step; a tie goes where the move
    // of the ends takes it.
    const std::int64_t divisor = std::int64_t{kSubpixelScale} * length_;
    const std::int64_t numerator =
        std::int64_t{start_minor_} * length_ +
        std::int64_t{rise_} * (std::int64_t{begin} * kSubpixelScale + kHalfPixel - start_major_) -
        (tie_goes_down() ? 1 : 0);
    std::int64_t minor = numerator / divisor, rest = numerator % divisor;
    if (rest < 0) rest += divisor, --minor;
    const std::int64_t change =
        std::int64_t{rise_} * kSubpixelScale * step;  // at most the divisor, either way
    for (int i = 0, major = begin; i < count; ++i, major += step) {
      draw_step(rect, major, static_cast<int>(minor), pixel);
      rest += change;
      if (rest >= divisor) rest -= divisor, ++minor;
      if (rest < 0) rest += divisor, --minor;
    }
  }

 private:
  // Along x the ends move by -e, along y by +e^2.
  constexpr int pixel_of(std::int32_t major) const { return (x_major_ ? major - 1 : major) >> kSubpixelBits; }
  constexpr bool is_before_center(std::int32_t major) const {
    const std::int32_t center = pixel_of(major) * kSubpixelScale + kHalfPixel;
    return x_major_ ? major <= center : major < center;
  }
  // x-major: the minor coordinate moves by slope e + e^2; y-major: by -e.
  constexpr bool tie_goes_down() const { return x_major_ ? rise_ < 0 : true; }

  // Upwards (x-major) or to the right.
  template <class Pixel>
  constexpr void draw_step(const PixelRect& rect, int major, int minor, const Pixel& pixel) const {
    const int before = x_major_ ? minor - (rect.y1 - 1) : rect.x0 - minor,
              within = x_major_ ? minor - rect.y0 : rect.x1 - 1 - minor;
    for (int k = std::max(before, 0); k <= std::min(within, width_ - 1); ++k)
      pixel(x_major_ ? major : minor + k, x_major_ ? minor - k : major);
  }

  int width_ = 1;
  bool x_major_ = true, forward_ = true, empty_ = true;
  std::int32_t length_ = 0,
               rise_ = 0;  // along the major axis, in its direction: rise_ / length_ is the slope
  std::int32_t start_major_ = 0, start_minor_ = 0;
  int first_ = 0, last_ = 0;  // steps, inclusive
};

}  // namespace tessera::detail
