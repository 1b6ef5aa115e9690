// Based on: J. Pineda, A Parallel Algorithm for Polygon Rasterization, SIGGRAPH 1988; one pixel at a time, in
// 64-bit integers.
#include "rasterize_polygon.h"

#include <algorithm>
#include <cmath>

namespace tessera::reference {
namespace {

/// Positive to the left of the line from a to b.
std::int64_t edge(Point a, Point b, Point p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

// In a counter-clockwise triangle with y up, left edges go down and top edges go left; they include their
// points.
bool owns_its_points(Point a, Point b) { return b.y < a.y || (b.y == a.y && b.x < a.x); }

bool is_inside(std::int64_t e, Point a, Point b) { return e > 0 || (e == 0 && owns_its_points(a, b)); }

/// Edge functions at a point, for the edges opposite to a, b and c.
struct Edges {
  std::int64_t a;
  std::int64_t b;
  std::int64_t c;
};

template <class Part>
Edges edges(const Part& part, Point p) {
  return {edge(part.b.at, part.c.at, p), edge(part.c.at, part.a.at, p), edge(part.a.at, part.b.at, p)};
}

template <class Part>
bool covers(const Part& part, Point p) {
  const Point a = part.a.at;
  const Point b = part.b.at;
  const Point c = part.c.at;
  const Edges e = edges(part, p);
  return is_inside(e.a, b, c) && is_inside(e.b, c, a) && is_inside(e.c, a, b);
}

double ratio(std::int64_t part, std::int64_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

// Depth is linear in the window. Formulated so that equal depths stay exact.
template <class Part>
double depth_at(const Part& part, Point p) {
  const Edges e = edges(part, p);
  return part.a.depth + ratio(e.b, part.area) * (part.b.depth - part.a.depth) +
         ratio(e.c, part.area) * (part.c.depth - part.a.depth);
}

template <class Part>
void set_share(Fragment& fragment, const Part& part, Point p) {
  const Edges e = edges(part, p);
  const double wa = ratio(e.a, part.area) * part.a.inverse_w;
  const double wb = ratio(e.b, part.area) * part.b.inverse_w;
  const double wc = ratio(e.c, part.area) * part.c.inverse_w;
  const double sum = wa + wb + wc;
  fragment.weights.resize(part.a.weights.size());
  for (std::size_t i = 0; i < fragment.weights.size(); ++i)
    fragment.weights[i] =
        wa / sum * part.a.weights[i] + wb / sum * part.b.weights[i] + wc / sum * part.c.weights[i];
}

/// Gradients of the edge functions per pixel.
struct EdgeSteps {
  Edges dx;
  Edges dy;
};

template <class Part>
EdgeSteps edge_steps(const Part& part) {
  const Point a = part.c.at - part.b.at;
  const Point b = part.a.at - part.c.at;
  const Point c = part.b.at - part.a.at;
  return {{-a.y * kSubpixels, -b.y * kSubpixels, -c.y * kSubpixels},
          {a.x * kSubpixels, b.x * kSubpixels, c.x * kSubpixels}};
}

// A weight is a quotient of two linear functions of the window: quotient rule.
template <class Part>
void set_derivatives(Fragment& fragment, const Part& part, Point p) {
  const auto weights = [&](const Edges& e) {
    return Vec3{ratio(e.a, part.area) * part.a.inverse_w, ratio(e.b, part.area) * part.b.inverse_w,
                ratio(e.c, part.area) * part.c.inverse_w};
  };
  const auto derivative = [&](Vec3 step, double sum, std::size_t i) {
    const double numerator =
        step.x * part.a.weights[i] + step.y * part.b.weights[i] + step.z * part.c.weights[i];
    return (numerator - fragment.weights[i] * (step.x + step.y + step.z)) / sum;
  };
  const Vec3 at = weights(edges(part, p));
  const EdgeSteps steps = edge_steps(part);
  const std::size_t count = fragment.weights.size();
  fragment.weights_dx.resize(count);
  fragment.weights_dy.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    fragment.weights_dx[i] = derivative(weights(steps.dx), at.x + at.y + at.z, i);
    fragment.weights_dy[i] = derivative(weights(steps.dy), at.x + at.y + at.z, i);
  }
}

}  // namespace

WindowPolygon::WindowPolygon(const std::vector<ClipVertex>& polygon, const Window& window) : window_(window) {
  for (const ClipVertex& vertex : polygon) vertices_.push_back(window_vertex(vertex, window));
  const auto fan_area = [&](std::size_t i, std::size_t j) {
    return edge(vertices_[0].at, vertices_[i].at, vertices_[j].at);
  };
  for (std::size_t i = 2; i < vertices_.size(); ++i) signed_area_ += fan_area(i - 1, i);
  for (std::size_t i = 2; i < vertices_.size(); ++i) {
    const auto [second, third] = signed_area_ > 0 ? std::pair{i - 1, i} : std::pair{i, i - 1};
    const std::int64_t area = fan_area(second, third);
    // A non-positive area is degenerate, or a sliver of a clipped polygon that snapping flipped.
    if (area > 0) parts_.push_back({vertices_[0], vertices_[second], vertices_[third], area});
  }
}

const WindowPolygon::Part& WindowPolygon::largest_part() const {
  return *std::max_element(parts_.begin(), parts_.end(),
                           [](const Part& p, const Part& q) { return p.area < q.area; });
}

double WindowPolygon::depth_slope() const {
  if (parts_.empty()) return 0;
  const auto& [a, b, c, area] = largest_part();
  const auto difference = [](std::int64_t p, std::int64_t q) { return static_cast<double>(p - q); };
  const double b_depth = b.depth - a.depth;
  const double c_depth = c.depth - a.depth;
  const double per_pixel = static_cast<double>(kSubpixels) / static_cast<double>(area);
  return per_pixel *
         std::max(std::abs(b_depth * difference(c.at.y, a.at.y) - c_depth * difference(b.at.y, a.at.y)),
                  std::abs(b_depth * difference(c.at.x, a.at.x) - c_depth * difference(b.at.x, a.at.x)));
}

double WindowPolygon::largest_depth() const {
  double largest = 0;
  for (const WindowVertex& vertex : vertices_) largest = std::max(largest, std::abs(vertex.depth));
  return largest;
}

void WindowPolygon::for_each_fragment(double depth_offset, const FragmentCallback& take) const {
  if (parts_.empty()) return;
  const auto [left, right] = std::ranges::minmax(vertices_, {}, [](const WindowVertex& v) { return v.at.x; });
  const auto [low, high] = std::ranges::minmax(vertices_, {}, [](const WindowVertex& v) { return v.at.y; });
  const Pixels pixels = visible_pixels({left.at.x, low.at.y}, {right.at.x, high.at.y}, window_);
  const std::span<const Point> offsets = sample_offsets(window_.samples);

  const auto part_at = [&](Point p) -> const Part* {
    for (const Part& part : parts_)
      if (covers(part, p)) return &part;
    return nullptr;
  };
  Fragment fragment;
  for (std::int64_t y = pixels.first_y; y <= pixels.last_y; ++y)
    for (std::int64_t x = pixels.first_x; x <= pixels.last_x; ++x) {
      const Point center = pixel_center(x, y);
      fragment.x = static_cast<int>(x + window_.viewport.x);
      fragment.y = static_cast<int>(y + window_.viewport.y);
      fragment.coverage = 0;
      for (std::size_t i = 0; i < offsets.size(); ++i) {
        const Point sample = center + offsets[i];
        const Part* part = part_at(sample);
        if (part == nullptr) continue;
        fragment.coverage |= 1u << i;
        fragment.depth[i] = std::clamp(depth_at(*part, sample) + depth_offset, 0.0, 1.0);
      }
      if (fragment.coverage == 0) continue;
      // None beyond the edge, where a sliver of the fan would extrapolate.
      const Part* covering = part_at(center);
      const Part& part = covering != nullptr ? *covering : largest_part();
      set_share(fragment, part, center);
      if (window_.derivatives) set_derivatives(fragment, part, center);
      take(fragment);
    }
}

}  // namespace tessera::reference
