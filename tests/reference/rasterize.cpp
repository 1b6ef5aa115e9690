// Based on: J. Pineda, A Parallel Algorithm for Polygon Rasterization, SIGGRAPH 1988; one pixel at a time, in 64-bit integers.
#include "rasterize.h"

#include <algorithm>
#include <cmath>

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

// The standard patterns of Direct3D 11, turned over: theirs are written with y down. All lie within their pixel.
constexpr std::array<SamplePosition, 1> kCentre{};
constexpr std::array<SamplePosition, 4> kFour{{{-2, 6}, {6, 2}, {-6, -2}, {2, -6}}};
constexpr std::array<SamplePosition, 8> kEight{{{1, 3}, {-1, -3}, {5, -1}, {-3, 5}, {-5, -5}, {-7, 1}, {3, -7}, {7, 7}}};
constexpr std::int64_t kSampleUnit = kSubpixels / 16;
static_assert(kEight.size() == kMaxSamples);

/// The edge functions of a point: opposite of a, of b and of c.
struct Edges {
  std::int64_t a, b, c;
};

template <class Part>
Edges edges(const Part& part, Point p) {
  const Point a{part.a.x, part.a.y}, b{part.b.x, part.b.y}, c{part.c.x, part.c.y};
  return {edge(b, c, p), edge(c, a, p), edge(a, b, p)};
}

template <class Part>
bool covers(const Part& part, Point p) {
  const Point a{part.a.x, part.a.y}, b{part.b.x, part.b.y}, c{part.c.x, part.c.y};
  const Edges e = edges(part, p);
  return is_inside(e.a, b, c) && is_inside(e.b, c, a) && is_inside(e.c, a, b);
}

double ratio(std::int64_t part, std::int64_t whole) { return static_cast<double>(part) / static_cast<double>(whole); }

// Depth is linear in the window; written so that equal depths stay exactly equal.
template <class Part>
double depth_at(const Part& part, Point p) {
  const Edges e = edges(part, p);
  return part.a.depth + ratio(e.b, part.area) * (part.b.depth - part.a.depth) + ratio(e.c, part.area) * (part.c.depth - part.a.depth);
}

template <class Part>
Vec3 share_at(const Part& part, Point p) {
  const Edges e = edges(part, p);
  const double wa = ratio(e.a, part.area) * part.a.inverse_w, wb = ratio(e.b, part.area) * part.b.inverse_w,
               wc = ratio(e.c, part.area) * part.c.inverse_w, sum = wa + wb + wc;
  return wa / sum * part.a.share + wb / sum * part.b.share + wc / sum * part.c.share;
}

}  // namespace

std::span<const SamplePosition> sample_positions(int samples) {
  if (samples == 4) return kFour;
  if (samples == 8) return kEight;
  return kCentre;
}

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
  const auto fan_area = [&](std::size_t i, std::size_t j) {
    return edge({vertices_[0].x, vertices_[0].y}, {vertices_[i].x, vertices_[i].y}, {vertices_[j].x, vertices_[j].y});
  };
  for (std::size_t i = 2; i < vertices_.size(); ++i) signed_area_ += fan_area(i - 1, i);
  for (std::size_t i = 2; i < vertices_.size(); ++i) {
    const auto [second, third] = signed_area_ > 0 ? std::pair{i - 1, i} : std::pair{i, i - 1};
    const std::int64_t area = fan_area(second, third);
    // Else nothing, or a sliver of a clipped polygon that snapping turned over.
    if (area > 0) parts_.push_back({vertices_[0], vertices_[second], vertices_[third], area});
  }
}

const WindowPolygon::Part& WindowPolygon::largest_part() const {
  return *std::max_element(parts_.begin(), parts_.end(), [](const Part& p, const Part& q) { return p.area < q.area; });
}

double WindowPolygon::depth_slope() const {
  if (parts_.empty()) return 0;
  const auto& [a, b, c, area] = largest_part();
  const auto difference = [](std::int64_t p, std::int64_t q) { return static_cast<double>(p - q); };
  const double b_depth = b.depth - a.depth, c_depth = c.depth - a.depth;
  const double per_pixel = static_cast<double>(kSubpixels) / static_cast<double>(area);
  return per_pixel * std::max(std::abs(b_depth * difference(c.y, a.y) - c_depth * difference(b.y, a.y)),
                              std::abs(b_depth * difference(c.x, a.x) - c_depth * difference(b.x, a.x)));
}

double WindowPolygon::largest_depth() const {
  double largest = 0;
  for (const Vertex& vertex : vertices_) largest = std::max(largest, std::abs(vertex.depth));
  return largest;
}

void WindowPolygon::for_each_fragment(double depth_offset, const std::function<void(const Fragment&)>& take) const {
  if (parts_.empty()) return;
  const auto [left, right] = std::ranges::minmax(vertices_, {}, &Vertex::x);
  const auto [low, high] = std::ranges::minmax(vertices_, {}, &Vertex::y);
  const Rect& visible = window_.visible;  // from here on relative to the viewport, as the vertices are
  const std::int64_t first_x = visible.x - window_.viewport.x, first_y = visible.y - window_.viewport.y;
  const std::int64_t x0 = std::max(first_x, floor_pixel(left.x)), x1 = std::min(first_x + visible.width - 1, floor_pixel(right.x));
  const std::int64_t y0 = std::max(first_y, floor_pixel(low.y)), y1 = std::min(first_y + visible.height - 1, floor_pixel(high.y));
  const std::span<const SamplePosition> positions = sample_positions(window_.samples);

  const auto part_at = [&](Point p) -> const Part* {
    for (const Part& part : parts_)
      if (covers(part, p)) return &part;
    return nullptr;
  };
  for (std::int64_t y = y0; y <= y1; ++y)
    for (std::int64_t x = x0; x <= x1; ++x) {
      const Point centre{x * kSubpixels + kSubpixels / 2, y * kSubpixels + kSubpixels / 2};
      Fragment fragment{static_cast<int>(x + window_.viewport.x), static_cast<int>(y + window_.viewport.y)};
      for (std::size_t i = 0; i < positions.size(); ++i) {
        const Point sample{centre.x + positions[i].x * kSampleUnit, centre.y + positions[i].y * kSampleUnit};
        const Part* part = part_at(sample);
        if (part == nullptr) continue;
        fragment.coverage |= 1u << i;
        fragment.depth[i] = std::clamp(depth_at(*part, sample) + depth_offset, 0.0, 1.0);
      }
      if (fragment.coverage == 0) continue;
      const Part* part = part_at(centre);  // none: beyond the edge, where a sliver of the fan would say nonsense
      fragment.share = share_at(part != nullptr ? *part : largest_part(), centre);
      take(fragment);
    }
}

}  // namespace tessera::reference
