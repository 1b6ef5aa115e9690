#include "vertex_list.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace tessera::mesa {
namespace {

using reference::Mesh;
using reference::Vec3;

Vec3 point(const Mesh& mesh, std::size_t corner) {
  const reference::Vec4 p = mesh.positions[mesh.indices[corner]];
  return (1 / p.w) * reference::xyz(p);
}

// As long as twice the area.
Vec3 face_vector(const Mesh& mesh, std::size_t triangle) {
  const Vec3 a = point(mesh, 3 * triangle), b = point(mesh, 3 * triangle + 1), c = point(mesh, 3 * triangle + 2);
  return reference::cross(b - a, c - a);
}

bool precedes(Vec3 a, Vec3 b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

// Sorts the corners by place and gives each run of equal places the sum of its faces.
std::vector<Vec3> smooth_normals(const Mesh& mesh) {
  std::vector<std::size_t> corners(mesh.indices.size());
  std::iota(corners.begin(), corners.end(), std::size_t{0});
  std::stable_sort(corners.begin(), corners.end(), [&](std::size_t a, std::size_t b) { return precedes(point(mesh, a), point(mesh, b)); });

  std::vector<Vec3> normals(mesh.indices.size());
  for (std::size_t first = 0; first < corners.size();) {
    std::size_t last = first;
    Vec3 sum;
    while (last < corners.size() && !precedes(point(mesh, corners[first]), point(mesh, corners[last]))) sum = sum + face_vector(mesh, corners[last++] / 3);
    for (; first < last; ++first) normals[corners[first]] = reference::normalize(sum);
  }
  return normals;
}

std::vector<Vec3> flat_normals(const Mesh& mesh) {
  std::vector<Vec3> normals(mesh.indices.size());
  for (std::size_t corner = 0; corner < normals.size(); ++corner) normals[corner] = reference::normalize(face_vector(mesh, corner / 3));
  return normals;
}

std::array<float, 4> floats(reference::Vec4 c) {
  return {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z), static_cast<float>(c.w)};
}

}  // namespace

std::vector<Vertex> vertex_list(const Mesh& mesh, const reference::Draw& draw) {
  std::vector<Vec3> generated;
  if (mesh.normals.empty()) generated = draw.shading == reference::Shading::kFlat ? flat_normals(mesh) : smooth_normals(mesh);

  std::vector<Vertex> vertices;
  for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
    const std::uint32_t index = mesh.indices[corner];
    const reference::Vec4 p = mesh.positions[index];
    const Vec3 n = generated.empty() ? mesh.normals[index] : generated[corner];
    vertices.push_back({{p.x, p.y, p.z, p.w},
                        {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)},
                        floats(mesh.colors.empty() ? draw.material.diffuse : mesh.colors[index])});
  }
  return vertices;
}

}  // namespace tessera::mesa
