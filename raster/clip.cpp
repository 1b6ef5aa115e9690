#include "raster/clip.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "raster/exact_intersection.h"
#include "raster/exact_vertex.h"

namespace tessera::detail {
namespace {

// Near and far first: what they leave has w >= 0, so the guard band's planes then mean what they say.
constexpr Outcode kPlanes[] = {kBeforeNear,       kBehindFar,      kLeftOfGuardBand,
                               kRightOfGuardBand, kBelowGuardBand, kAboveGuardBand};
// A cut moves vertices, and rounding may carry one across a plane that no vertex crossed before: after the
// first cut every plane is looked at.
bool may_clip(Outcode plane, std::uint8_t outcodes) {
  return (outcodes & (plane | kBeforeNear | kBehindFar)) != 0;
}

// How far inside a plane a position lies; negative outside.
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

// Of the sums that the coordinates are.
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
  return d > 0 ? 1 : d < 0 ? -1 : 0;
}

// The polygon as it was, of which things are cut off.
class UnclippedPolygon {
 public:
  UnclippedPolygon(const VertexTransform& transform, std::span<const ClipVertex> vertices,
                   int attribute_count)
      : transform_(transform), vertices_(vertices), attribute_count_(attribute_count) {}

  // The point of the edge from `a` to `b` on a plane, of which one is inside. It is the same whichever end is
  // named first.
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
    for (std::size_t i = 2; i < vertices_.size() && exact_cuts_left_ > 0;
         ++i, --exact_cuts_left_)  // the triangles from the first vertex to all others
      if (const auto v = exact_two_plane_intersection(transform_, plane, a.plane, vertices_[0],
                                                      vertices_[i - 1], vertices_[i], attribute_count_))
        return on_plane(plane, *v);
    return on_plane(plane, interpolated.vertex);
  }
  // The same of a whole edge. Absent if both ends are on one side.
  std::optional<ClipVertex> cut_whole_edge(Outcode plane, const ClipVertex& a, const ClipVertex& b) const {
    const bool a_inside = side(transform_, plane, a) >= 0, b_inside = side(transform_, plane, b) >= 0;
    if (a_inside == b_inside) return std::nullopt;
    const InterpolatedVertex interpolated = a_inside ? interpolate(plane, a, b) : interpolate(plane, b, a);
    return on_plane(plane, interpolated.is_accurate
                               ? interpolated.vertex
                               : exact_edge_intersection(transform_, plane, a_inside ? a : b,
                                                         a_inside ? b : a, attribute_count_)
                                     .value_or(interpolated.vertex));
  }

 private:
  struct InterpolatedVertex {
    ClipVertex vertex;
    bool is_accurate;
  };
  InterpolatedVertex interpolate(Outcode plane, const ClipVertex& inner, const ClipVertex& outer) const {
    const bool from_inner = max_abs(inner.position) <= max_abs(outer.position);  // the end that rounds less
    const ClipVertex &from = from_inner ? inner : outer, &to = from_inner ? outer : inner;
    const double first = distance(transform_, plane, from.position),
                 second = distance(transform_, plane, to.position), apart = first - second;
    const bool is_crossed = (first < 0) != (second < 0);  // rounding may have both ends on one side
    const double t = is_crossed ? first / apart : 0;
    const auto interpolate = [t](double a, double b) { return std::fma(t, b - a, a); };
    const ClipPosition &p = from.position, &q = to.position;
    InterpolatedVertex interpolated{{.position = {interpolate(p.x, q.x), interpolate(p.y, q.y),
                                                  interpolate(p.z, q.z), interpolate(p.w, q.w)}},
                                    false};
    for (int k = 0; k < attribute_count_; ++k) {
      const float a = from.attributes[k], b = to.attributes[k];
      interpolated.vertex.attributes[k] =
          std::clamp(static_cast<float>(interpolate(a, b)), std::min(a, b), std::max(a, b));
    }
    // What is interpolated is off by some 2^-50 of what that end is the sum of, and by as much more as the
    // edge is long for its way through the plane; by its share, also of the other end's. With less than 2^20
    // of what is seen, its w, that is less than 2^-7 of the 1/256 pixel of a vertex in a window of 2^14
    // pixels.
    const double guard = (plane & (kBeforeNear | kBehindFar)) != 0               ? 1
                         : (plane & (kLeftOfGuardBand | kRightOfGuardBand)) != 0 ? transform_.guard_x
                                                                                 : transform_.guard_y;
    const ClipPosition way{q.x - p.x, q.y - p.y, q.z - p.z, q.w - p.w};
    const double rounded = std::max(term_magnitude(transform_, from), t * term_magnitude(transform_, to));
    interpolated.is_accurate =
        is_crossed &&
        rounded / std::abs(apart) * (1 + guard) <=
            0x1p20 * (interpolated.vertex.position.w /
                      max_abs(way));  // doubles hold quotients of coordinates, but not all their products
    return interpolated;
  }
  // Nothing is off in the direction that counts.
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
  // Each plane cuts what is left of a convex polygon in two places. Of others, which it may cut in any number
  // of them, the rest is as doubles have it.
  mutable std::size_t exact_cuts_left_ = 2 * std::size(kPlanes) * vertices_.size();
};

// False where the eye's plane is touched in a single point, which is no pixel; and where sums of the largest
// numbers overflowed.
bool is_usable(const ClipPosition& p) {
  return p.w > 0 && std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.w);
}

// What of a polygon is inside of one plane, vertex by vertex.
template <class Keep>
void clip_to_plane(const VertexTransform& transform, const UnclippedPolygon& unclipped, Outcode plane,
                   std::span<const ClipCorner> corners, const Keep& keep) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ClipCorner &a = corners[i], &b = corners[i + 1 == corners.size() ? 0 : i + 1];
    const int of_a = side(transform, plane, a.vertex), of_b = side(transform, plane, b.vertex);
    if (of_a >= 0) keep(of_a > 0 || of_b >= 0 ? a : ClipCorner{a.vertex, -1, plane});
    if (of_a > 0 && of_b < 0) keep({unclipped.cut(plane, a, b.vertex, true), -1, plane});
    if (of_a < 0 && of_b > 0) keep({unclipped.cut(plane, a, b.vertex, false), a.edge, a.plane});
  }
}

// Distances, and differences of positions, of the largest doubles would be infinite. A power of two in all
// positions of a polygon moves none of its points.
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
      if (count < kMaxClippedVertices)
        corners[count++] =
            corner;  // a convex polygon gains one vertex a plane; only rounding could make more
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
    const bool first_inside = side(transform, plane, line[0]) >= 0,
               second_inside = side(transform, plane, line[1]) >= 0;
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
