#include "generated_normals.h"

#include <map>
#include <tuple>

namespace tessera::reference {
namespace {

using Key = std::tuple<double, double, double, double>;

Key key_of(Vec4 p) { return {p.x, p.y, p.z, p.w}; }

// Twice the area long.
Vec3 area_normal(const Mesh& mesh, std::size_t triangle) {
  const auto [a, b, c] = triangle_corners(mesh, triangle);
  const Vec3 normal = cross(b - a, c - a);
  return std::isfinite(dot(normal, normal)) ? normal : Vec3{};
}

}  // namespace

std::array<Vec3, 3> triangle_corners(const Mesh& mesh, std::size_t triangle) {
  std::array<Vec3, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec4 p = mesh.positions[mesh.indices[3 * triangle + i]];
    corners[i] = {p.x / p.w, p.y / p.w, p.z / p.w};
  }
  return corners;
}

Vec3 face_normal(const Mesh& mesh, std::size_t triangle) { return normalize(area_normal(mesh, triangle)); }

std::vector<Vec3> mean_face_normals(const Mesh& mesh) {
  std::map<Key, Vec3> sums;
  for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
    const Vec3 normal = area_normal(mesh, t);
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3& sum = sums[key_of(mesh.positions[mesh.indices[3 * t + i]])];
      sum = sum + normal;
    }
  }
  std::vector<Vec3> normals;
  for (const Vec4 p : mesh.positions) normals.push_back(normalize(sums[key_of(p)]));
  return normals;
}

}  // namespace tessera::reference
