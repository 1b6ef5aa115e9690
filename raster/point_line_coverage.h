// Pixels and samples that points and lines cover, in exact integers of 1/256 pixel. Lines of one sample:
// line_walk.h, line_steps-inl.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "framebuffer/tile_grid.h"
#include "raster/line_walk.h"

namespace tessera::detail {

/// Larger points and lines, in pixels, are drawn at this size, which exceeds any frame buffer.
inline constexpr float kMaxPointLineSize = 65536;

/// Size in whole pixels for pixels of one sample: rounded, halves up, at least 1 [GL 2.1, 3.3 and 3.4].
inline int rounded_size(float size) {
  return std::max(1, static_cast<int>(std::floor(std::min(size, kMaxPointLineSize) + 0.5f)));
}
/// Size in 1/256 pixel for pixels of several samples: snapped like positions.
inline std::int32_t snapped_size(float size) {
  return std::max(1, static_cast<std::int32_t>(std::floor(
                         static_cast<double>(std::min(size, kMaxPointLineSize)) * kSubpixelScale + 0.5)));
}

/// Largest distance per axis, in 1/256 pixel, of a covered pixel's centre from a line. With several samples:
/// a sample is less than half a pixel from the centre, and a rounded size differs from the snapped one by
/// less than that.
inline std::int32_t line_reach(float width, int samples) {
  return samples == 1 ? rounded_size(width) * kHalfPixel : (snapped_size(width) + 1) / 2 + kHalfPixel;
}

/// Bounds of the pixels whose centres are within `reach` of a line, per axis.
constexpr PixelRect pixels_near(LinePoint a, LinePoint b, std::int32_t reach) {
  return {first_pixel(std::min(a.x, b.x) - reach), first_pixel(std::min(a.y, b.y) - reach),
          last_pixel(std::max(a.x, b.x) + reach) + 1, last_pixel(std::max(a.y, b.y) + reach) + 1};
}

/// Square of a point of `size` pixels. An odd size is centred on the pixel that contains the point, an even
/// size on the nearest pixel corner. On a border, the pixel or corner to the right or above is chosen.
constexpr PixelRect point_square(LinePoint at, int size) {
  const bool odd = size % 2 != 0;
  const int x = (odd ? at.x : at.x + kHalfPixel) >> kSubpixelBits;
  const int y = (odd ? at.y - 1 : at.y + kHalfPixel - 1) >> kSubpixelBits;
  return {x - size / 2, y - size / 2, x - size / 2 + size, y - size / 2 + size};
}

/// Coverage of a point with several samples: a closed disc.
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

/// Coverage of a line with several samples: a rectangle along the line, of its width. The fill rule of
/// polygons applies to its border: left and top sides belong to it [GL 2.1, 3.4.4].
class LineRectangle {
 public:
  /// @param width  snapped
  LineRectangle(LinePoint a, LinePoint b, std::int32_t width)
      : a_(a),
        dx_(std::int64_t{b.x} - a.x),
        dy_(std::int64_t{b.y} - a.y),
        squared_length_(dx_ * dx_ + dy_ * dy_) {
    // Largest integer half <= width / 2 * length, that is, 4 half^2 <= width^2 length^2.
    __extension__ using Wide = __int128;
    const Wide bound = Wide{width} * width * squared_length_;
    half_ = static_cast<std::int64_t>(0.5 * width * std::sqrt(static_cast<double>(squared_length_)));
    while (4 * Wide{half_} * half_ > bound) --half_;
    while (4 * (Wide{half_} + 1) * (half_ + 1) <= bound) ++half_;
    meets_border_ = 4 * Wide{half_} * half_ == bound;
  }

  std::int64_t squared_length() const { return squared_length_; }
  /// Position along the line, 0 to squared_length() between its ends.
  std::int64_t along(LinePoint p) const { return dx_ * (p.x - a_.x) + dy_ * (p.y - a_.y); }
  /// Signed distance from the line times its length; positive to the right of its direction (y down).
  std::int64_t across(LinePoint p) const { return dx_ * (p.y - a_.y) - dy_ * (p.x - a_.x); }

  bool covers(LinePoint p) const {
    const std::int64_t forward = along(p), aside = across(p);
    const bool is_beyond_ends = forward < 0 || forward > squared_length_;
    const bool is_beyond_sides = aside < -half_ || aside > half_;
    if (is_beyond_ends || is_beyond_sides || squared_length_ == 0) return false;
    // A left side has the inside to its right, a top side has it below.
    const auto owns = [](std::int64_t inside_x, std::int64_t inside_y) {
      return inside_x > 0 || (inside_x == 0 && inside_y > 0);
    };
    if (forward == 0 && !owns(dx_, dy_)) return false;
    if (forward == squared_length_ && !owns(-dx_, -dy_)) return false;
    if (!meets_border_) return true;
    if (aside == half_ && !owns(dy_, -dx_)) return false;
    return aside != -half_ || owns(-dy_, dx_);
  }
  /// False if the square around `p`, `reach` to each side, does not touch the rectangle. Conservative.
  bool may_touch(LinePoint p, std::int32_t reach) const {
    const std::int64_t margin = (std::abs(dx_) + std::abs(dy_)) * reach;
    return std::abs(across(p)) <= half_ + margin && along(p) >= -margin &&
           along(p) <= squared_length_ + margin;
  }

 private:
  LinePoint a_;
  std::int64_t dx_, dy_;
  std::int64_t squared_length_;
  std::int64_t half_ = 0;      // half the width times the length, rounded down
  bool meets_border_ = false;  // half_ is not rounded: grid points can lie on the long sides
};

}  // namespace tessera::detail
