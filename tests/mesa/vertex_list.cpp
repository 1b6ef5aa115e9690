#include "vertex_list.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "shadow.h"
#include "tests/reference/primitives.h"

namespace tessera::mesa {
namespace {

using reference::Mesh;
using reference::Primitive;
using reference::Vec3;

/// The same mesh with one vertex per element of its index list; keeps only the positions.
Mesh unshared(const Mesh& mesh) {
  Mesh result;
  result.primitive = mesh.primitive;
  for (const std::uint32_t index : mesh.indices) result.positions.push_back(mesh.positions[index]);
  result.indices.resize(mesh.indices.size());
  std::iota(result.indices.begin(), result.indices.end(), 0u);
  return result;
}

Vec3 point(const Mesh& mesh, std::size_t corner) {
  const reference::Vec4 p = mesh.positions[corner];
  return (1 / p.w) * reference::xyz(p);
}

// Sum over the fan of triangles around the first corner, with a length of twice their area. Null for points,
// lines, and faces with corners at infinity.
Vec3 face_vector(const Mesh& mesh, const Primitive& face) {
  const auto from_first = [&](std::size_t i) {
    return point(mesh, face.vertices[i]) - point(mesh, face.vertices[0]);
  };
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < face.vertices.size(); ++i)
    sum = sum + reference::cross(from_first(i), from_first(i + 1));
  return std::isfinite(reference::dot(sum, sum)) ? sum : Vec3{};
}

bool precedes(Vec3 a, Vec3 b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

// Sorts the corners of all faces by position and assigns each run of equal positions the sum of its faces.
std::vector<Vec3> smooth_normals(const Mesh& mesh) {
  struct FaceCorner {
    std::uint32_t vertex;
    Vec3 place;
    Vec3 face;
  };
  std::vector<FaceCorner> corners;
  for (std::size_t i = 0; i < reference::primitive_count(mesh); ++i) {
    const Primitive face = reference::primitive(mesh, i, reference::ProvokingVertex::kLast);
    const Vec3 vector = face_vector(mesh, face);
    for (const std::uint32_t vertex : face.vertices) corners.push_back({vertex, point(mesh, vertex), vector});
  }
  std::ranges::stable_sort(
      corners, [](const FaceCorner& a, const FaceCorner& b) { return precedes(a.place, b.place); });

  std::vector<Vec3> normals(mesh.positions.size());
  for (std::size_t first = 0; first < corners.size();) {
    std::size_t last = first;
    Vec3 sum;
    while (last < corners.size() && !precedes(corners[first].place, corners[last].place))
      sum = sum + corners[last++].face;
    for (; first < last; ++first) normals[corners[first].vertex] = reference::normalize(sum);
  }
  return normals;
}

// Each vertex of a list provokes at most one primitive, under the given convention. The normals of all other
// vertices are unused and get a value that is valid for any lighting.
std::vector<Vec3> flat_normals(const Mesh& mesh, reference::ProvokingVertex convention) {
  std::vector<Vec3> normals(mesh.positions.size(), Vec3{0, 0, 1});
  for (std::size_t i = 0; i < reference::primitive_count(mesh); ++i) {
    const Primitive face = reference::primitive(mesh, i, convention);
    normals[face.vertices[face.provoking]] = reference::normalize(face_vector(mesh, face));
  }
  return normals;
}

std::vector<Vec3> generated_normals(const Mesh& mesh, const reference::Draw& draw) {
  return draw.shading == reference::Shading::kFlat ? flat_normals(mesh, draw.provoking_vertex)
                                                   : smooth_normals(mesh);
}

std::array<float, 3> floats(Vec3 n) {
  return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
}

std::array<float, 4> floats(reference::Vec4 c) {
  return {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z), static_cast<float>(c.w)};
}

}  // namespace

std::vector<Vertex> vertex_list(const Mesh& mesh, const reference::Draw& draw) {
  const bool is_colored = has_vertex_colors(draw, mesh);
  std::vector<Vec3> generated;
  if (mesh.normals.empty()) generated = generated_normals(unshared(mesh), draw);

  std::vector<Vertex> vertices;
  for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
    const std::uint32_t index = mesh.indices[corner];
    const reference::Vec4 p = mesh.positions[index];
    vertices.push_back({{p.x, p.y, p.z, p.w},
                        floats(generated.empty() ? mesh.normals[index] : generated[corner]),
                        floats(is_colored ? mesh.colors[index] : draw.material.diffuse),
                        mesh.texcoords.empty() ? std::array<double, 2>{} : mesh.texcoords[index]});
  }
  return vertices;
}

}  // namespace tessera::mesa
