// Which pixels and samples points and lines cover, in exact integers of 1/256 pixel. Lines of one sample:
// line_walk.h, line_steps-inl.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "framebuffer/tile_grid.h"
#include "raster/line_walk.h"

namespace tessera::detail {

/// Points and lines that are larger, in pixels, are drawn at this size, which more than covers any frame
/// buffer.
inline constexpr float kMaxPointLineSize = 65536;

/// The size in pixels where pixels have one sample: rounded, halves up, at least 1 [GL 2.1, 3.3 and 3.4].
inline int rounded_size(float size) {
  return std::max(1, static_cast<int>(std::floor(std::min(size, kMaxPointLineSize) + 0.5f)));
}
/// In 1/256 pixel, where they have several: sizes are snapped as positions are.
inline std::int32_t snapped_size(float size) {
  return std::max(1, static_cast<std::int32_t>(std::floor(
                         static_cast<double>(std::min(size, kMaxPointLineSize)) * kSubpixelScale + 0.5)));
}

/// Of what covers pixels with one sample the centre is within this of a line along each axis, in 1/256 pixel.
/// Of others too: a sample is less than half a pixel from the centre, and by less whole sizes differ from
/// snapped ones.
inline std::int32_t line_reach(float width, int samples) {
  return samples == 1 ? rounded_size(width) * kHalfPixel : (snapped_size(width) + 1) / 2 + kHalfPixel;
}

/// The pixels whose centres are within `reach` of a line along each axis.
constexpr PixelRect pixels_near(LinePoint a, LinePoint b, std::int32_t reach) {
  return {first_pixel(std::min(a.x, b.x) - reach), first_pixel(std::min(a.y, b.y) - reach),
          last_pixel(std::max(a.x, b.x) + reach) + 1, last_pixel(std::max(a.y, b.y) + reach) + 1};
}

/// The square of a point of `size` pixels: an odd size lies around the pixel that holds the point, an even
/// one around the nearest corner of pixels. On a border, what lies to the right or above has it.
constexpr PixelRect point_square(LinePoint at, int size) {
  const bool odd = size % 2 != 0;
  const int x = (odd ? at.x : at.x + kHalfPixel) >> kSubpixelBits,
            y = (odd ? at.y - 1 : at.y + kHalfPixel - 1) >> kSubpixelBits;
  return {x - size / 2, y - size / 2, x - size / 2 + size, y - size / 2 + size};
}

/// A point of several samples: a disc, its border included.
class PointDisc {
 public:
  /// @param diameter  snapped
  constexpr PointDisc(LinePoint at, std::int32_t diameter) : at_(at), diameter_(diameter) {}
  constexpr bool covers(LinePoint p) const {
    const std::int64_t x = p.x - at_.x, y = p.y - at_.y;
    return 4 * (x * x + y * y) <= std::int64_t{diameter_} * diameter_;
  }
  constexpr std::int32_t reach() const { return (diameter_ + 1) / 2; }

 private:
  LinePoint at_;
  std::int32_t diameter_;
};

/// A line of several samples: the rectangle of its width along it. Points on its border belong to it by the
/// rule of polygons: those on a left or top side [GL 2.1, 3.4.4].
class LineRectangle {
 public:
  /// @param width  snapped
  LineRectangle(LinePoint a, LinePoint b, std::int32_t width)
      : a_(a),
        dx_(std::int64_t{b.x} - a.x),
        dy_(std::int64_t{b.y} - a.y),
        squared_length_(dx_ * dx_ + dy_ * dy_) {
    // The largest `half` with half <= width / 2 * length: 4 half^2 <= width^2 length^2.
    __extension__ using Wide = __int128;
    const Wide bound = Wide{width} * width * squared_length_;
    half_ = static_cast<std::int64_t>(0.5 * width * std::sqrt(static_cast<double>(squared_length_)));
    while (4 * Wide{half_} * half_ > bound) --half_;
    while (4 * (Wide{half_} + 1) * (half_ + 1) <= bound) ++half_;
    meets_border_ = 4 * Wide{half_} * half_ == bound;
  }

  std::int64_t squared_length() const { return squared_length_; }
  /// How far along the line a point is, as a part of squared_length().
  std::int64_t along(LinePoint p) const { return dx_ * (p.x - a_.x) + dy_ * (p.y - a_.y); }
  /// How far to its right, y down, in units of the length.
  std::int64_t across(LinePoint p) const { return dx_ * (p.y - a_.y) - dy_ * (p.x - a_.x); }

  bool covers(LinePoint p) const {
    const std::int64_t forward = along(p), aside = across(p);
    if (forward < 0 || forward > squared_length_ || aside < -half_ || aside > half_ || squared_length_ == 0)
      return false;
    // A side is a left one if what is inside lies to the right of it, a top one if that lies below it.
    const auto owns = [](std::int64_t inside_x, std::int64_t inside_y) {
      return inside_x > 0 || (inside_x == 0 && inside_y > 0);
    };
    if (forward == 0 && !owns(dx_, dy_)) return false;
    if (forward == squared_length_ && !owns(-dx_, -dy_)) return false;
    if (!meets_border_) return true;
    if (aside == half_ && !owns(dy_, -dx_)) return false;
    return aside != -half_ || owns(-dy_, dx_);
  }
  /// Whether a square around `p`, `reach` to each side, may have points of it.
  bool may_touch(LinePoint p, std::int32_t reach) const {
    const std::int64_t most = (std::abs(dx_) + std::abs(dy_)) * reach;
    return std::abs(across(p)) <= half_ + most && along(p) >= -most && along(p) <= squared_length_ + most;
  }

 private:
  LinePoint a_;
  std::int64_t dx_, dy_, squared_length_, half_ = 0;
  bool meets_border_ = false;
};

}  // namespace tessera::detail
