#include "raster/clip.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "raster/exact_intersection.h"
#include "raster/exact_vertex.h"

namespace tessera::detail {
namespace {

// Near and far first: the remaining part has w >= 0, as the guard band's plane equations assume.
constexpr Outcode kPlanes[] = {kBeforeNear,       kBehindFar,      kLeftOfGuardBand,
                               kRightOfGuardBand, kBelowGuardBand, kAboveGuardBand};
// Cuts at the near and far planes make new vertices, which rounding may move across a guard plane that no
// original vertex crosses. After such a cut every plane is tested.
bool may_clip(Outcode plane, std::uint8_t outcodes) {
  return (outcodes & (plane | kBeforeNear | kBehindFar)) != 0;
}

// Signed distance of a position from a plane, up to scale; negative outside.
double distance(const VertexTransform& t, Outcode plane, const ClipPosition& p) {
  switch (plane) {
    case kLeftOfGuardBand: return p.x + t.guard_x * p.w;
    case kRightOfGuardBand: return t.guard_x * p.w - p.x;
    case kBelowGuardBand: return p.y + t.guard_y * p.w;
    case kAboveGuardBand: return t.guard_y * p.w - p.y;
    case kBeforeNear: return t.reversed ? p.w - p.z : p.z + p.w;
    case kBehindFar: return t.reversed ? p.z : p.w - p.z;
    default: return p.w;
  }
}

double max_abs(const ClipPosition& p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), std::abs(p.w)});
}

// Magnitude of the terms whose sums are the coordinates.
double term_magnitude(const VertexTransform& t, const ClipVertex& v) {
  if (!v.object || v.needs_exact) return max_abs(v.position);
  const auto& [x, y, z, w] = *v.object;
  return std::max(max_abs(v.position), std::scalbn(t.term_magnitude(x, y, z, w), v.object_exponent));
}

// -1, 0 or 1: outside, on the plane, inside.
int side(const VertexTransform& t, Outcode plane, const ClipVertex& v) {
  const double d = v.needs_exact && v.object
                       ? ExactVertex(t, *v.object, v.object_exponent).distance(t, plane).value()
                       : distance(t, plane, v.position);
  return (d > 0 ? 1 : 0) - (d < 0 ? 1 : 0);
}

// The unclipped polygon. Every cut is computed between its original vertices, so that neighbours sharing an
// edge get the same point.
class UnclippedPolygon {
 public:
  UnclippedPolygon(const VertexTransform& transform, std::span<const ClipVertex> vertices,
                   int attribute_count)
      : transform_(transform), vertices_(vertices), attribute_count_(attribute_count) {}

  // Intersection of the edge from `a` to `b` with a plane; exactly one end is inside. Independent of the
  // edge's direction.
  ClipVertex cut(Outcode plane, const ClipCorner& a, const ClipVertex& b, bool a_is_inside) const {
    if (a.edge >= 0) {
      const auto first = static_cast<std::size_t>(a.edge);
      if (const auto v = cut_whole_edge(plane, vertices_[first],
                                        vertices_[first + 1 == vertices_.size() ? 0 : first + 1]))
        return *v;
    }
    const InterpolatedVertex interpolated =
        a_is_inside ? interpolate(plane, a.vertex, b) : interpolate(plane, b, a.vertex);
    if (interpolated.is_accurate || a.edge >= 0) return on_plane(plane, interpolated.vertex);
    // The point lies on two planes and in one triangle of the fan around vertex 0.
    for (std::size_t i = 2; i < vertices_.size() && exact_cuts_left_ > 0; ++i, --exact_cuts_left_)
      if (const auto v = exact_two_plane_intersection(transform_, plane, a.plane, vertices_[0],
                                                      vertices_[i - 1], vertices_[i], attribute_count_))
        return on_plane(plane, *v);
    return on_plane(plane, interpolated.vertex);
  }
  // Intersection of an original edge. Absent if both ends are on one side.
  std::optional<ClipVertex> cut_whole_edge(Outcode plane, const ClipVertex& a, const ClipVertex& b) const {
    const bool a_inside = side(transform_, plane, a) >= 0;
    const bool b_inside = side(transform_, plane, b) >= 0;
    if (a_inside == b_inside) return std::nullopt;
    const ClipVertex& inner = a_inside ? a : b;
    const ClipVertex& outer = a_inside ? b : a;
    const InterpolatedVertex interpolated = interpolate(plane, inner, outer);
    if (interpolated.is_accurate) return on_plane(plane, interpolated.vertex);
    return on_plane(plane, exact_edge_intersection(transform_, plane, inner, outer, attribute_count_)
                               .value_or(interpolated.vertex));
  }

 private:
  struct InterpolatedVertex {
    ClipVertex vertex;
    bool is_accurate;
  };
  InterpolatedVertex interpolate(Outcode plane, const ClipVertex& inner, const ClipVertex& outer) const {
    // Start at the end that rounds less.
    const bool from_inner = max_abs(inner.position) <= max_abs(outer.position);
    const ClipVertex& from = from_inner ? inner : outer;
    const ClipVertex& to = from_inner ? outer : inner;
    const double from_distance = distance(transform_, plane, from.position);
    const double to_distance = distance(transform_, plane, to.position);
    const double crossing = from_distance - to_distance;
    // Rounding may put both ends on one side.
    const bool is_crossed = (from_distance < 0) != (to_distance < 0);
    const double t = is_crossed ? from_distance / crossing : 0;
    const auto mix = [t](double a, double b) { return std::fma(t, b - a, a); };
    const ClipPosition &p = from.position, &q = to.position;
    InterpolatedVertex interpolated{
        {.position = {mix(p.x, q.x), mix(p.y, q.y), mix(p.z, q.z), mix(p.w, q.w)}}, false};
    for (int k = 0; k < attribute_count_; ++k) {
      const float a = from.attributes[k], b = to.attributes[k];
      interpolated.vertex.attributes[k] =
          std::clamp(static_cast<float>(mix(a, b)), std::min(a, b), std::max(a, b));
    }
    // Error bound of the interpolated point: about 2^-50 of the magnitude of the terms of `from`, scaled by
    // the edge's length over the difference of the end points' plane distances; plus t times the bound of
    // `to`. If that magnitude is below 2^20 w, the error is below 2^-7 of the 1/256 pixel grid in a window of
    // 2^14 pixels.
    const ClipPosition edge{q.x - p.x, q.y - p.y, q.z - p.z, q.w - p.w};
    const double magnitude = std::max(term_magnitude(transform_, from), t * term_magnitude(transform_, to));
    // Quotients of coordinates stay in the range of doubles; their products may not.
    interpolated.is_accurate = is_crossed && magnitude / std::abs(crossing) * (1 + factor_of_w(plane)) <=
                                                 0x1p20 * (interpolated.vertex.position.w / max_abs(edge));
    return interpolated;
  }
  // Upper bound of the factor of w in the plane's equation.
  double factor_of_w(Outcode plane) const {
    if ((plane & (kBeforeNear | kBehindFar)) != 0) return 1;
    return (plane & (kLeftOfGuardBand | kRightOfGuardBand)) != 0 ? transform_.guard_x : transform_.guard_y;
  }
  // Moves a vertex exactly onto a guard plane.
  ClipVertex on_plane(Outcode plane, ClipVertex v) const {
    switch (plane) {
      case kLeftOfGuardBand: v.position.x = -(transform_.guard_x * v.position.w); break;
      case kRightOfGuardBand: v.position.x = transform_.guard_x * v.position.w; break;
      case kBelowGuardBand: v.position.y = -(transform_.guard_y * v.position.w); break;
      case kAboveGuardBand: v.position.y = transform_.guard_y * v.position.w; break;
      default: break;
    }
    return v;
  }

  const VertexTransform& transform_;
  std::span<const ClipVertex> vertices_;
  int attribute_count_;
  // Each plane cuts a convex polygon at most twice. A polygon that is not convex may be cut more often;
  // further points are not computed exactly.
  mutable std::size_t exact_cuts_left_ = 2 * std::size(kPlanes) * vertices_.size();
};

// False for w = 0 (the polygon touches the eye plane in a point, which covers no pixel) and for coordinates
// that overflowed.
bool is_usable(const ClipPosition& p) { return p.w > 0 && is_finite(p); }

// Passes the vertices of the polygon's part inside one plane to `keep`.
template <class Keep>
void clip_to_plane(const VertexTransform& transform, const UnclippedPolygon& unclipped, Outcode plane,
                   std::span<const ClipCorner> corners, const Keep& keep) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ClipCorner &a = corners[i], &b = corners[i + 1 == corners.size() ? 0 : i + 1];
    const int side_a = side(transform, plane, a.vertex);
    const int side_b = side(transform, plane, b.vertex);
    // If `a` lies on the plane and `b` is outside, the edge that starts at `a` lies on the plane.
    if (side_a >= 0) keep(side_a > 0 || side_b >= 0 ? a : ClipCorner{a.vertex, -1, plane});
    if (side_a > 0 && side_b < 0) keep({unclipped.cut(plane, a, b.vertex, true), -1, plane});
    if (side_a < 0 && side_b > 0) keep({unclipped.cut(plane, a, b.vertex, false), a.edge, a.plane});
  }
}

// Scales very large positions down: their distances and differences would overflow. A common power of two in
// all positions of a polygon moves none of its points in the window.
void scale_to_finite(std::span<ClipVertex> vertices) {
  constexpr double kLarge = 0x1p980;  // sums of two numbers below 2^984, times at most 2^15 of a guard band
  if (std::none_of(vertices.begin(), vertices.end(),
                   [&](const ClipVertex& v) { return max_abs(v.position) > kLarge; }))
    return;
  constexpr int kExponent = -40;
  for (ClipVertex& v : vertices) {
    const auto scaled = [](double c) { return std::scalbn(c, kExponent); };
    v.position = {scaled(v.position.x), scaled(v.position.y), scaled(v.position.z), scaled(v.position.w)};
    v.object_exponent = kExponent;
  }
}

}  // namespace

ClippedPolygon clip_triangle(const VertexTransform& transform, const ClipVertex (&triangle)[3],
                             std::uint8_t outcodes, int attribute_count) {
  ClipVertex vertices[3] = {triangle[0], triangle[1], triangle[2]};
  scale_to_finite(vertices);
  const UnclippedPolygon unclipped(transform, vertices, attribute_count);
  struct Polygon {
    ClipCorner corners[kMaxClippedVertices];
    std::size_t count = 0;
    void add(const ClipCorner& corner) {
      // A convex polygon gains at most one vertex per plane; only rounding could make more.
      if (count < kMaxClippedVertices) corners[count++] = corner;
    }
  } polygon;
  for (int i = 0; i < 3; ++i) polygon.add({vertices[i], i});
  for (const Outcode plane : kPlanes) {
    if (!may_clip(plane, outcodes)) continue;
    Polygon kept;
    clip_to_plane(transform, unclipped, plane, {polygon.corners, polygon.count},
                  [&kept](const ClipCorner& corner) { kept.add(corner); });
    polygon = kept;
    if (polygon.count < 3) return {};
  }
  ClippedPolygon clipped;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const ClipVertex& v = polygon.corners[i].vertex;
    if (!is_usable(v.position)) return {};
    clipped.vertices[clipped.count++] = v;
  }
  return clipped;
}

void PolygonClipper::clip(const VertexTransform& transform, std::vector<ClipVertex>& polygon,
                          std::uint8_t outcodes, int attribute_count) {
  scale_to_finite(polygon);
  const UnclippedPolygon unclipped(transform, polygon, attribute_count);
  corners_.clear();
  for (const ClipVertex& v : polygon) corners_.push_back({v, static_cast<int>(corners_.size())});
  for (const Outcode plane : kPlanes) {
    if (!may_clip(plane, outcodes)) continue;
    kept_.clear();
    clip_to_plane(transform, unclipped, plane, corners_,
                  [this](const ClipCorner& corner) { kept_.push_back(corner); });
    std::swap(corners_, kept_);
  }
  polygon.clear();
  if (corners_.size() < 3 || !std::all_of(corners_.begin(), corners_.end(),
                                          [](const ClipCorner& c) { return is_usable(c.vertex.position); }))
    return;
  for (const ClipCorner& corner : corners_) polygon.push_back(corner.vertex);
}

bool clip_line(const VertexTransform& transform, ClipVertex (&line)[2], std::uint8_t outcodes,
               int attribute_count) {
  scale_to_finite(line);
  const ClipVertex ends[2] = {line[0], line[1]};
  const UnclippedPolygon unclipped(transform, ends, attribute_count);
  for (const Outcode plane : kPlanes) {
    if (!may_clip(plane, outcodes)) continue;
    const bool first_inside = side(transform, plane, line[0]) >= 0;
    const bool second_inside = side(transform, plane, line[1]) >= 0;
    if (!first_inside && !second_inside) return false;
    if (first_inside != second_inside)
      line[first_inside ? 1 : 0] = unclipped.cut(plane, {line[0], 0}, line[1], first_inside);
  }
  return is_usable(line[0].position) && is_usable(line[1].position);
}

bool is_inside_side_planes(const ClipPosition& p) { return std::abs(p.x) <= p.w && std::abs(p.y) <= p.w; }

bool is_in_view(const VertexTransform& transform, const ClipPosition& p) {
  return p.w > 0 && is_inside_side_planes(p) && distance(transform, kBeforeNear, p) >= 0 &&
         distance(transform, kBehindFar, p) >= 0;
}

}  // namespace tessera::detail
