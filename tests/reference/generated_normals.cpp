#include "generated_normals.h"

#include <map>
#include <set>
#include <tuple>

#include "primitives.h"

namespace tessera::reference {
namespace {

using Key = std::tuple<double, double, double, double>;

Key key_of(Vec4 p) { return {p.x, p.y, p.z, p.w}; }

Primitive any_primitive(const Mesh& mesh, std::size_t index) {
  return primitive(mesh, index, ProvokingVertex::kLast);
}

// Normal with a length of twice the area.
Vec3 area_normal(const Mesh& mesh, const Primitive& polygon) {
  const auto corner = [&](std::size_t i) {
    const Vec4 p = mesh.positions[polygon.vertices[i]];
    return Vec3{p.x / p.w, p.y / p.w, p.z / p.w};
  };
  Vec3 normal;
  for (std::size_t i = 2; i < polygon.vertices.size(); ++i)
    normal = normal + cross(corner(i - 1) - corner(0), corner(i) - corner(0));
  return std::isfinite(dot(normal, normal)) ? normal : Vec3{};
}

}  // namespace

Vec3 face_normal(const Mesh& mesh, std::size_t primitive) {
  return normalize(area_normal(mesh, any_primitive(mesh, primitive)));
}

std::vector<Vec3> mean_face_normals(const Mesh& mesh) {
  std::map<Key, Vec3> sums;
  for (std::size_t i = 0; i < primitive_count(mesh); ++i) {
    const Primitive polygon = any_primitive(mesh, i);
    const Vec3 normal = area_normal(mesh, polygon);
    std::set<Key> positions;  // several corners may share a position
    for (const std::uint32_t vertex : polygon.vertices) positions.insert(key_of(mesh.positions[vertex]));
    for (const Key& position : positions) sums[position] = sums[position] + normal;
  }
  std::vector<Vec3> normals;
  for (const Vec4 p : mesh.positions) normals.push_back(normalize(sums[key_of(p)]));
  return normals;
}

}  // namespace tessera::reference
