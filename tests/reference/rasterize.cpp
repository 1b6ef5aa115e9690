// Based on: J. Pineda, A Parallel Algorithm for Polygon Rasterization, SIGGRAPH 1988; one pixel at a time, in 64-bit integers.
#include "rasterize.h"

#include <algorithm>

namespace tessera::reference {
namespace {

constexpr std::int64_t kSubpixels = 256;

// Bound of |coordinate| from the viewport's centre, in pixels. An edge function is a difference of two products of coordinate
// differences, each at most twice the extent.
constexpr std::int64_t kExtent = std::int64_t{1} << 21;
constexpr std::int64_t kMaxDifference = 2 * (kExtent + 1) * kSubpixels;
static_assert(kMaxDifference <= INT64_MAX / kMaxDifference / 2);

// Relative to the viewport's centre, so that whole pixels of offset never change it.
std::int64_t snap(double pixels_from_centre) {
  return static_cast<std::int64_t>(std::floor(pixels_from_centre * kSubpixels + 0.5));
}

struct Point {
  std::int64_t x, y;
};

/// Above 0 to the left of the way from a to b.
std::int64_t edge(Point a, Point b, Point p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

// In a counter-clockwise triangle with y up, left edges go down and top edges go left: they own the points on them.
bool owns_its_points(Point a, Point b) { return b.y < a.y || (b.y == a.y && b.x < a.x); }

bool is_inside(std::int64_t e, Point a, Point b) { return e > 0 || (e == 0 && owns_its_points(a, b)); }

std::int64_t floor_pixel(std::int64_t subpixels) { return subpixels >> 8; }
static_assert(kSubpixels == 1 << 8);

}  // namespace

Rect intersection(Rect a, Rect b) {
  const int left = std::max(a.x, b.x), right = std::min(a.x + a.width, b.x + b.width);
  const int bottom = std::max(a.y, b.y), top = std::min(a.y + a.height, b.y + b.height);
  return {left, bottom, std::max(0, right - left), std::max(0, top - bottom)};
}

ClipVolume clip_volume(const Camera& camera, Rect viewport) {
  const auto guard = [](int size) { return 2.0 * static_cast<double>(kExtent) / std::max(size, 1); };
  return {camera.reversed, camera.infinite_far, guard(viewport.width), guard(viewport.height)};
}

WindowPolygon::WindowPolygon(const std::vector<ClipVertex>& polygon, const Window& window) : window_(window) {
  const Rect& viewport = window.viewport;
  for (const ClipVertex& vertex : polygon) {
    const Vec4 p = vertex.position;
    const double z = p.z / p.w, depth = window.reversed ? z : (z + 1) / 2;
    vertices_.push_back({snap(p.x / p.w * viewport.width / 2) + viewport.width * kSubpixels / 2,
                         snap(p.y / p.w * viewport.height / 2) + viewport.height * kSubpixels / 2,
                         window.depth_range[0] + (window.depth_range[1] - window.depth_range[0]) * std::clamp(depth, 0.0, 1.0),
                         1 / p.w, vertex.share});
  }
}

std::int64_t WindowPolygon::signed_area() const {
  std::int64_t area = 0;
  for (std::size_t i = 2; i < vertices_.size(); ++i)
    area += edge({vertices_[0].x, vertices_[0].y}, {vertices_[i - 1].x, vertices_[i - 1].y}, {vertices_[i].x, vertices_[i].y});
  return area;
}

void WindowPolygon::for_each_fragment(const std::function<void(const Fragment&)>& take) const {
  const bool counter_clockwise = signed_area() > 0;
  for (std::size_t i = 2; i < vertices_.size(); ++i) {
    if (counter_clockwise) rasterize(vertices_[0], vertices_[i - 1], vertices_[i], take);
    else rasterize(vertices_[0], vertices_[i], vertices_[i - 1], take);
  }
}

void WindowPolygon::rasterize(const Vertex& va, const Vertex& vb, const Vertex& vc,
                              const std::function<void(const Fragment&)>& take) const {
  const Point a{va.x, va.y}, b{vb.x, vb.y}, c{vc.x, vc.y};
  const std::int64_t area = edge(a, b, c);
  if (area <= 0) return;  // nothing, or a sliver of a clipped polygon that snapping turned over

  const Rect& visible = window_.visible;  // from here on relative to the viewport, as the vertices are
  const std::int64_t left = visible.x - window_.viewport.x, bottom = visible.y - window_.viewport.y;
  const std::int64_t x0 = std::max(left, floor_pixel(std::min({a.x, b.x, c.x}))),
                     x1 = std::min(left + visible.width - 1, floor_pixel(std::max({a.x, b.x, c.x})));
  const std::int64_t y0 = std::max(bottom, floor_pixel(std::min({a.y, b.y, c.y}))),
                     y1 = std::min(bottom + visible.height - 1, floor_pixel(std::max({a.y, b.y, c.y})));
  for (std::int64_t y = y0; y <= y1; ++y)
    for (std::int64_t x = x0; x <= x1; ++x) {
      const Point centre{x * kSubpixels + kSubpixels / 2, y * kSubpixels + kSubpixels / 2};
      const std::int64_t ea = edge(b, c, centre), eb = edge(c, a, centre), ec = edge(a, b, centre);
      if (!is_inside(ea, b, c) || !is_inside(eb, c, a) || !is_inside(ec, a, b)) continue;

      const double la = static_cast<double>(ea) / static_cast<double>(area),
                   lb = static_cast<double>(eb) / static_cast<double>(area),
                   lc = static_cast<double>(ec) / static_cast<double>(area);
      // Depth is linear in the window; written so that equal depths stay exactly equal.
      const double depth = va.depth + lb * (vb.depth - va.depth) + lc * (vc.depth - va.depth);
      const double wa = la * va.inverse_w, wb = lb * vb.inverse_w, wc = lc * vc.inverse_w, sum = wa + wb + wc;
      const Vec3 share = wa / sum * va.share + wb / sum * vb.share + wc / sum * vc.share;
      take({static_cast<int>(x + window_.viewport.x), static_cast<int>(y + window_.viewport.y), std::clamp(depth, 0.0, 1.0),
            share});
    }
}

}  // namespace tessera::reference
