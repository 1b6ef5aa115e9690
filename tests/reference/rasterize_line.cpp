#include "rasterize_line.h"

#include <algorithm>
#include <cmath>

#include "diamond_exit.h"

namespace tessera::reference {
namespace {

class Line {
 public:
  Line(const WindowVertex& a, const WindowVertex& b, double depth_offset, const Window& window,
       const FragmentCallback& take)
      : a_(a), b_(b), along_(b.at - a.at), depth_offset_(depth_offset), window_(window), take_(take) {
    fragment_.weights.resize(a.weights.size());
    fragment_.weights_dx = fragment_.weights_dy = CornerWeights(a.weights.size(), 0.0);
  }

  void rasterize_pixels(std::int64_t width) {
    const bool x_major = std::abs(along_.x) >= std::abs(along_.y);
    const std::int64_t down = (width - 1) * kSubpixels / 2;
    const Point shift = x_major ? Point{0, down} : Point{down, 0};
    const Point a = a_.at - shift;
    const Point b = b_.at - shift;
    const Point replicated = x_major ? Point{0, width - 1} : Point{width - 1, 0};
    const Pixels all =
        visible_pixels({std::min(a.x, b.x) - kSubpixels, std::min(a.y, b.y) - kSubpixels},
                       {std::max(a.x, b.x) + kSubpixels, std::max(a.y, b.y) + kSubpixels}, window_);
    // Scans column by column, or row by row. Within a column the line stays within half a pixel of where it
    // passes the middle, and so do the diamonds it meets, whose centres are another half pixel away: two
    // pixels up and down suffice.
    const std::int64_t first = x_major ? all.first_x : all.first_y, last = x_major ? all.last_x : all.last_y;
    for (std::int64_t major = first; major <= last; ++major) {
      const std::int64_t near = pixel_at(a, pixel_center(major, major), x_major);
      for (std::int64_t minor = near - 2; minor <= near + 2; ++minor) {
        const Point pixel = x_major ? Point{major, minor} : Point{minor, major};
        if (exits_diamond(a, b, pixel_center(pixel.x, pixel.y))) take_pixels(pixel, pixel + replicated);
      }
    }
  }

  void rasterize_samples(double width) {
    const auto reach = static_cast<std::int64_t>(std::ceil(width)) * kSubpixels;
    const Point low{std::min(a_.at.x, b_.at.x), std::min(a_.at.y, b_.at.y)},
        high{std::max(a_.at.x, b_.at.x), std::max(a_.at.y, b_.at.y)};
    const Pixels pixels = visible_pixels(low - Point{reach, reach}, high + Point{reach, reach}, window_);
    const std::span<const Point> offsets = sample_offsets(window_.samples);
    for (std::int64_t y = pixels.first_y; y <= pixels.last_y; ++y)
      for (std::int64_t x = pixels.first_x; x <= pixels.last_x; ++x) {
        fragment_.coverage = 0;
        for (std::size_t i = 0; i < offsets.size(); ++i)
          if (is_in_rectangle(pixel_center(x, y) + offsets[i], width)) fragment_.coverage |= 1u << i;
        if (fragment_.coverage != 0) take_fragment({x, y});
      }
  }

 private:
  // The row where the line from `a` passes the column through `p`, or the column where it passes that row.
  std::int64_t pixel_at(Point a, Point p, bool x_major) const {
    if (along_.x == 0 && along_.y == 0) return 0;
    const auto dx = static_cast<double>(along_.x), dy = static_cast<double>(along_.y);
    const double minor = x_major ? static_cast<double>(a.y) + dy / dx * static_cast<double>(p.x - a.x)
                                 : static_cast<double>(a.x) + dx / dy * static_cast<double>(p.y - a.y);
    return static_cast<std::int64_t>(std::floor(minor / kSubpixels));
  }

  void take_pixels(Point first, Point last) {
    const Pixels pixels =
        visible_pixels(pixel_center(first.x, first.y), pixel_center(last.x, last.y), window_);
    fragment_.coverage = 1;
    for (std::int64_t y = pixels.first_y; y <= pixels.last_y; ++y)
      for (std::int64_t x = pixels.first_x; x <= pixels.last_x; ++x) take_fragment({x, y});
  }

  // Border points follow the polygon rule: the left side belongs to the rectangle, and the upper side if it
  // is horizontal.
  bool is_in_rectangle(Point p, double width) const {
    const auto owns = [](Point way) { return way.y < 0 || (way.y == 0 && way.x < 0); };
    const auto dot = [](Point u, Point v) { return u.x * v.x + u.y * v.y; };
    const Point d = along_;
    const Point left{-d.y, d.x};
    const Point from_a = p - a_.at;
    const Point to_b = b_.at - p;
    if (d.x == 0 && d.y == 0) return false;
    const std::int64_t after_a = dot(d, from_a);
    const std::int64_t before_b = dot(d, to_b);
    if (after_a < 0 || (after_a == 0 && !owns(Point{} - left))) return false;
    if (before_b < 0 || (before_b == 0 && !owns(left))) return false;
    const long double length = std::hypot(static_cast<long double>(d.x), static_cast<long double>(d.y));
    const long double across = static_cast<long double>(dot(left, from_a)) / length;
    const long double half = 0.5L * width * kSubpixels;
    if (across == -half) return owns(d);
    if (across == half) return owns(Point{} - d);
    return -half < across && across < half;
  }

  /// Equation 3.5.
  double t_at(Point p) const {
    const Point from_a = p - a_.at;
    const auto dx = static_cast<double>(along_.x), dy = static_cast<double>(along_.y);
    return (static_cast<double>(from_a.x) * dx + static_cast<double>(from_a.y) * dy) / (dx * dx + dy * dy);
  }

  void take_fragment(Point pixel) {
    const std::span<const Point> offsets = sample_offsets(window_.samples);
    fragment_.x = static_cast<int>(pixel.x + window_.viewport.x);
    fragment_.y = static_cast<int>(pixel.y + window_.viewport.y);
    const Point center = pixel_center(pixel.x, pixel.y);
    for (std::size_t i = 0; i < offsets.size(); ++i)
      fragment_.depth[i] =
          std::clamp(a_.depth + t_at(center + offsets[i]) * (b_.depth - a_.depth) + depth_offset_, 0.0, 1.0);
    const double t = t_at(center);
    const double wa = (1 - t) * a_.inverse_w;
    const double wb = t * b_.inverse_w;
    for (std::size_t i = 0; i < fragment_.weights.size(); ++i)
      fragment_.weights[i] = wa / (wa + wb) * a_.weights[i] + wb / (wa + wb) * b_.weights[i];
    if (window_.derivatives) set_derivatives(wa + wb);
    take_(fragment_);
  }

  // Quotient rule on equation 3.6; t grows by 1 along the length of the line.
  void set_derivatives(double sum) {
    const double length =
        std::hypot(static_cast<double>(along_.x), static_cast<double>(along_.y)) / kSubpixels;
    for (std::size_t i = 0; i < fragment_.weights.size(); ++i)
      fragment_.weights_dx[i] = (b_.inverse_w * b_.weights[i] - a_.inverse_w * a_.weights[i] -
                                 fragment_.weights[i] * (b_.inverse_w - a_.inverse_w)) /
                                sum / length;
  }

  const WindowVertex& a_;
  const WindowVertex& b_;
  Point along_;
  double depth_offset_;
  const Window& window_;
  const FragmentCallback& take_;
  Fragment fragment_;
};

}  // namespace

void rasterize_line(const WindowVertex& a, const WindowVertex& b, double width, double depth_offset,
                    const Window& window, const FragmentCallback& take) {
  const double used = std::min(width, kMaxSize);
  Line line(a, b, depth_offset, window, take);
  if (window.samples > 1) line.rasterize_samples(used);
  else line.rasterize_pixels(std::max(std::int64_t{1}, static_cast<std::int64_t>(std::floor(used + 0.5))));
}

}  // namespace tessera::reference
