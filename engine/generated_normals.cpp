#include "engine/generated_normals.h"

#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include <glm/glm.hpp>

#include "engine/matrix.h"

namespace tessera {
namespace {

glm::dvec3 position(const MeshArrays& mesh, std::size_t vertex) {
  const float* p = mesh.positions.at(vertex);
  const glm::dvec3 xyz(p[0], p[1], p[2]);
  return mesh.components == 4 && p[3] != 0 ? xyz / double{p[3]} : xyz;
}

std::array<std::size_t, 3> vertices_of(const MeshArrays& mesh, std::size_t triangle) {
  const auto corners = element_corners(mesh.primitive, ProvokingVertex::last, mesh.corners, triangle);
  return {mesh.vertex_at(corners[0]), mesh.vertex_at(corners[1]), mesh.vertex_at(corners[2])};
}

// Twice the area times the unit normal: the sum over the polygon's triangles, which is the same however it is split.
glm::dvec3 area_normal(const MeshArrays& mesh, std::size_t first, std::size_t last) {
  glm::dvec3 sum(0);
  for (std::size_t t = first; t < last; ++t) {
    const auto v = vertices_of(mesh, t);
    const glm::dvec3 a = position(mesh, v[0]);
    sum += glm::cross(position(mesh, v[1]) - a, position(mesh, v[2]) - a);
  }
  return sum;
}

void store_unit(const glm::dvec3& v, float* out) {
  const glm::dvec3 m = measurable(v);
  const double length = glm::length(m);
  const glm::dvec3 n = length > 0 ? m / length : glm::dvec3(0);
  for (int k = 0; k < 3; ++k) out[k] = static_cast<float>(n[k]);
}

// For each vertex the first one at the very same position: open addressing over the bits of the coordinates.
std::vector<std::uint32_t> first_at_position(const MeshArrays& mesh) {
  const std::size_t count = mesh.vertices;
  std::size_t slots = 16;
  while (slots < 2 * count) slots *= 2;
  constexpr std::uint32_t kEmpty = 0xffffffffu;
  std::vector<std::uint32_t> table(slots, kEmpty), first(count);
  using Key = std::array<std::uint32_t, 4>;  // bits: a NaN is no number, not even the same as itself
  const auto key = [&](std::size_t v) {
    const float* p = mesh.positions.at(v);
    return std::bit_cast<Key>(std::array<float, 4>{p[0] + 0.0f, p[1] + 0.0f, p[2] + 0.0f, mesh.components == 4 ? p[3] + 0.0f : 1.0f});  // + 0: -0 is 0
  };
  for (std::size_t v = 0; v < count; ++v) {
    const Key k = key(v);
    std::uint64_t hash = 0;
    for (const std::uint32_t bits : k) {
      hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 29;
    }
    std::size_t slot = hash & (slots - 1);
    while (table[slot] != kEmpty && key(table[slot]) != k) slot = (slot + 1) & (slots - 1);
    if (table[slot] == kEmpty) table[slot] = static_cast<std::uint32_t>(v);
    first[v] = table[slot];
  }
  return first;
}

}  // namespace

std::vector<float> smooth_normals(const MeshArrays& mesh) {
  if (mesh.topology() != Topology::triangles) return std::vector<float>(3 * mesh.vertices);  // no faces
  const std::vector<std::uint32_t> first = first_at_position(mesh);
  std::vector<glm::dvec3> sums(first.size(), glm::dvec3(0));
  const std::size_t each = mesh.polygon_triangles();
  for (std::size_t begin = 0; begin < mesh.elements; begin += each) {
    const glm::dvec3 normal = area_normal(mesh, begin, begin + each);
    if (!std::isfinite(normal.x + normal.y + normal.z)) continue;  // this polygon will be dropped; its neighbours keep theirs
    // A polygon's first triangle has three of its vertices, each further one another: the one that those before it have not.
    for (const std::size_t v : vertices_of(mesh, begin)) sums[first[v]] += normal;
    for (std::size_t t = begin + 1; t < begin + each; ++t) sums[first[mesh.vertex_at(added_corner(mesh.primitive, t))]] += normal;
  }
  std::vector<float> normals(3 * first.size());
  for (std::size_t v = 0; v < first.size(); ++v) store_unit(sums[first[v]], &normals[3 * v]);
  return normals;
}

std::vector<float> face_normals(const MeshArrays& mesh) {
  std::vector<float> normals(3 * mesh.elements);
  const std::size_t each = mesh.polygon_triangles();
  for (std::size_t begin = 0; begin < mesh.elements; begin += each) {
    const glm::dvec3 normal = area_normal(mesh, begin, begin + each);
    for (std::size_t t = begin; t < begin + each; ++t) store_unit(normal, &normals[3 * t]);
  }
  return normals;
}

}  // namespace tessera
