// Based on: I. Sutherland, G. Hodgman, Reentrant Polygon Clipping, CACM 1974, in homogeneous coordinates.
#include "clip.h"

namespace tessera::reference {
namespace {

/// The inside is x px + y py + z pz + w pw + offset >= 0.
struct Plane {
  Vec4 normal;
  double offset = 0;

  double distance(Vec4 p) const {
    return normal.x * p.x + normal.y * p.y + normal.z * p.z + normal.w * p.w + offset;
  }
};

std::vector<Plane> planes_of(const ClipVolume& volume) {
  constexpr double kMinW = 1e-30;  // w > 0
  std::vector<Plane> planes{{{0, 0, 0, 1}, -kMinW}};
  const Plane w_minus_z{{0, 0, -1, 1}};
  const Plane w_plus_z{{0, 0, 1, 1}};
  const Plane z{{0, 0, 1, 0}};
  planes.push_back(volume.reversed ? w_minus_z : w_plus_z);
  if (!volume.infinite_far) planes.push_back(volume.reversed ? z : w_minus_z);
  for (const double side : {-1.0, 1.0}) {
    planes.push_back({{side, 0, 0, volume.guard_x}});
    planes.push_back({{0, side, 0, volume.guard_y}});
  }
  return planes;
}

// Always computed from the inside to the outside, so that the two triangles that share an edge get the same
// point. Formulated so that a component equal at both ends keeps its exact value.
ClipVertex crossing(const ClipVertex& inside, const ClipVertex& outside, double t) {
  const auto mix = [t](double a, double b) { return a + t * (b - a); };
  const Vec4 p = inside.position;
  const Vec4 q = outside.position;
  ClipVertex vertex{{mix(p.x, q.x), mix(p.y, q.y), mix(p.z, q.z), mix(p.w, q.w)}, inside.weights};
  for (std::size_t i = 0; i < vertex.weights.size(); ++i)
    vertex.weights[i] = mix(inside.weights[i], outside.weights[i]);
  return vertex;
}

std::vector<ClipVertex> clipped(const std::vector<ClipVertex>& polygon, const Plane& plane) {
  std::vector<ClipVertex> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ClipVertex& a = polygon[i];
    const ClipVertex& b = polygon[(i + 1) % polygon.size()];
    const double da = plane.distance(a.position);
    const double db = plane.distance(b.position);
    if (da >= 0) kept.push_back(a);
    if (da >= 0 && db < 0) kept.push_back(crossing(a, b, da / (da - db)));
    if (da < 0 && db >= 0) kept.push_back(crossing(b, a, db / (db - da)));
  }
  return kept;
}

}  // namespace

ClipVertex corner_vertex(Vec4 position, std::size_t index, std::size_t count) {
  ClipVertex vertex{position, CornerWeights(count, 0.0)};
  vertex.weights[index] = 1;
  return vertex;
}

std::vector<ClipVertex> clip_polygon(std::vector<ClipVertex> polygon, const ClipVolume& volume) {
  for (const Plane& plane : planes_of(volume)) polygon = clipped(polygon, plane);
  for (const ClipVertex& vertex : polygon)
    if (!(vertex.position.w > 0)) return {};
  return polygon.size() < 3 ? std::vector<ClipVertex>{} : polygon;
}

std::vector<ClipVertex> clip_line(ClipVertex from, ClipVertex to, const ClipVolume& volume) {
  for (const Plane& plane : planes_of(volume)) {
    const double d_from = plane.distance(from.position);
    const double d_to = plane.distance(to.position);
    if (d_from < 0 && d_to < 0) return {};
    if (d_from < 0) from = crossing(to, from, d_to / (d_to - d_from));
    else if (d_to < 0) to = crossing(from, to, d_from / (d_from - d_to));
  }
  if (!(from.position.w > 0 && to.position.w > 0)) return {};
  return {from, to};
}

bool is_in_view(Vec4 position, const ClipVolume& volume) {
  for (const Plane& plane : planes_of(volume))
    if (!(plane.distance(position) >= 0)) return false;
  return is_between_sides(position);
}

bool is_between_sides(Vec4 p) { return std::abs(p.x) <= p.w && std::abs(p.y) <= p.w; }

}  // namespace tessera::reference
