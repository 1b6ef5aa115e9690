#include "raster/clip.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace tessera {
namespace {

// Near and far first: what they leave has w >= 0, so the guard band's planes then mean what they say.
constexpr ClipCode kPlanes[] = {kBeforeNear, kBehindFar, kLeftOfGuardBand, kRightOfGuardBand, kBelowGuardBand, kAboveGuardBand};
// A cut moves vertices, and rounding may carry one across a plane that no vertex crossed before: after the first cut every plane is
// looked at.
bool is_looked_at(ClipCode plane, std::uint8_t codes) { return (codes & (plane | kBeforeNear | kBehindFar)) != 0; }

// How far inside a plane a position lies; negative outside.
double distance(const VertexTransform& t, ClipCode plane, const ClipPosition& p) {
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

ClipVertex cut(const VertexTransform& transform, ClipCode plane, const ClipVertex& inner, const ClipVertex& outer, double inner_distance, double outer_distance, int attribute_count) {
  const double t = inner_distance / (inner_distance - outer_distance);
  const auto mix = [t](double a, double b) { return std::fma(t, b - a, a); };
  ClipVertex v;
  v.position = {mix(inner.position.x, outer.position.x), mix(inner.position.y, outer.position.y), mix(inner.position.z, outer.position.z),
                mix(inner.position.w, outer.position.w)};
  // Between ends that are very far away, what is mixed is off by more than the guard band is wide.
  switch (plane) {
    case kLeftOfGuardBand: v.position.x = -(transform.guard_x * v.position.w); break;
    case kRightOfGuardBand: v.position.x = transform.guard_x * v.position.w; break;
    case kBelowGuardBand: v.position.y = -(transform.guard_y * v.position.w); break;
    case kAboveGuardBand: v.position.y = transform.guard_y * v.position.w; break;
    default: break;
  }
  for (int k = 0; k < attribute_count; ++k) v.attributes[k] = static_cast<float>(mix(inner.attributes[k], outer.attributes[k]));
  return v;
}

// False where the eye's plane is touched in a single point, which is no pixel; and where sums of the largest numbers overflowed.
bool is_usable(const ClipPosition& p) { return p.w > 0 && std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.w); }

// What of a polygon is inside of one plane, vertex by vertex.
template <class Keep>
void keep_inside(const VertexTransform& transform, ClipCode plane, const ClipVertex* vertices, int count, int attribute_count, const Keep& keep) {
  for (int i = 0; i < count; ++i) {
    const ClipVertex &a = vertices[i], &b = vertices[i + 1 == count ? 0 : i + 1];
    const double da = distance(transform, plane, a.position), db = distance(transform, plane, b.position);
    if (da >= 0) keep(a);
    if (da >= 0 && db < 0) keep(cut(transform, plane, a, b, da, db, attribute_count));
    if (da < 0 && db >= 0) keep(cut(transform, plane, b, a, db, da, attribute_count));
  }
}

// Distances, and differences of positions, of the largest doubles would be infinite. A power of two in all positions of a polygon moves none of its points.
void keep_finite(std::span<ClipVertex> vertices) {
  constexpr double kLarge = 0x1p980, kScale = 0x1p-40;  // sums of two numbers below 2^984, times at most 2^15 of a guard band
  const auto size = [](const ClipPosition& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), std::abs(p.w)}); };
  if (std::none_of(vertices.begin(), vertices.end(), [&](const ClipVertex& v) { return size(v.position) > kLarge; })) return;
  for (ClipVertex& v : vertices) v.position = {v.position.x * kScale, v.position.y * kScale, v.position.z * kScale, v.position.w * kScale};
}

}  // namespace

ClippedPolygon clip_triangle(const VertexTransform& transform, const ClipVertex (&triangle)[3], std::uint8_t codes, int attribute_count) {
  ClippedPolygon polygon;
  for (const ClipVertex& v : triangle) polygon.vertices[polygon.count++] = v;
  keep_finite({polygon.vertices, 3});
  for (const ClipCode plane : kPlanes) {
    if (!is_looked_at(plane, codes)) continue;
    ClippedPolygon kept;
    keep_inside(transform, plane, polygon.vertices, polygon.count, attribute_count, [&kept](const ClipVertex& v) {
      if (kept.count < kMaxClippedVertices) kept.vertices[kept.count++] = v;  // a convex polygon gains one vertex a plane; only rounding could make more
    });
    polygon = kept;
    if (polygon.count < 3) return {};
  }
  for (int i = 0; i < polygon.count; ++i)
    if (!is_usable(polygon.vertices[i].position)) return {};
  return polygon;
}

std::vector<ClipVertex> clip_polygon(const VertexTransform& transform, std::vector<ClipVertex> polygon, std::uint8_t codes, int attribute_count) {
  keep_finite(polygon);
  for (const ClipCode plane : kPlanes) {
    if (!is_looked_at(plane, codes)) continue;
    std::vector<ClipVertex> kept;
    keep_inside(transform, plane, polygon.data(), static_cast<int>(polygon.size()), attribute_count, [&kept](const ClipVertex& v) { kept.push_back(v); });
    polygon = std::move(kept);
    if (polygon.size() < 3) return {};
  }
  for (const ClipVertex& v : polygon)
    if (!is_usable(v.position)) return {};
  return polygon;
}

bool clip_line(const VertexTransform& transform, ClipVertex (&line)[2], std::uint8_t codes, int attribute_count) {
  keep_finite(line);
  for (const ClipCode plane : kPlanes) {
    if (!is_looked_at(plane, codes)) continue;
    const double d0 = distance(transform, plane, line[0].position), d1 = distance(transform, plane, line[1].position);
    if (!(d0 >= 0 || d1 >= 0)) return false;
    if (d0 < 0) line[0] = cut(transform, plane, line[1], line[0], d1, d0, attribute_count);
    if (d1 < 0) line[1] = cut(transform, plane, line[0], line[1], d0, d1, attribute_count);
  }
  return is_usable(line[0].position) && is_usable(line[1].position);
}

bool is_between_sides(const ClipPosition& p) { return std::abs(p.x) <= p.w && std::abs(p.y) <= p.w; }

bool is_in_view(const VertexTransform& transform, const ClipPosition& p) {
  return p.w > 0 && is_between_sides(p) && distance(transform, kBeforeNear, p) >= 0 && distance(transform, kBehindFar, p) >= 0;
}

}  // namespace tessera
