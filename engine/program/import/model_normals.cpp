#include "engine/program/import/model_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {
namespace {

using Double3 = std::array<double, 3>;
using Float3 = std::array<float, 3>;

// Comparing the triangles at one position costs their number squared. Above this limit all of them count as
// one smooth surface.
constexpr std::size_t kMaxComparedTriangles = 256;

double dot(const Double3& a, const Double3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Float3 float3(const std::vector<float>& from, std::uint32_t vertex) {
  const float* const p = &from[3 * std::size_t{vertex}];
  return {p[0] + 0.0f, p[1] + 0.0f, p[2] + 0.0f};  // turns -0 into +0
}

/// The length is twice the triangle's area.
Double3 face_normal(const MeshData& mesh, std::size_t first_index) {
  const Float3 a = float3(mesh.positions, mesh.indices[first_index]);
  const Float3 b = float3(mesh.positions, mesh.indices[first_index + 1]);
  const Float3 c = float3(mesh.positions, mesh.indices[first_index + 2]);
  Double3 u;
  Double3 v;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = double{b[k]} - a[k];
    v[k] = double{c[k]} - a[k];
  }
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

Double3 unit(const Double3& n) {
  const double length = std::sqrt(dot(n, n));
  return length > 0 && std::isfinite(length) ? Double3{n[0] / length, n[1] / length, n[2] / length}
                                             : Double3{};
}

std::uint32_t group_of(std::span<const std::uint32_t> groups, std::uint32_t corner) {
  return groups.empty() ? 0 : groups[corner / 3];
}

/// Sorts corners by position and group. Positions with NaN components come last.
std::vector<std::uint32_t> sorted_corners(const MeshData& mesh, std::span<const std::uint32_t> groups) {
  std::vector<std::uint32_t> corners(mesh.indices.size() / 3 * 3);
  std::iota(corners.begin(), corners.end(), 0u);
  const auto key = [&](std::uint32_t corner) {
    Float3 p = float3(mesh.positions, mesh.indices[corner]);
    for (float& x : p)
      if (std::isnan(x)) x = INFINITY;
    return p;
  };
  std::sort(corners.begin(), corners.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Float3 p = key(a);
    const Float3 q = key(b);
    if (p != q) return p < q;
    const std::uint32_t group_a = group_of(groups, a), group_b = group_of(groups, b);
    return group_a != group_b ? group_a < group_b : a < b;
  });
  return corners;
}

/// Assigns normals to corners. A vertex keeps the first normal that it gets; corners with another normal get
/// a copy of the vertex.
class VertexSplitter {
 public:
  explicit VertexSplitter(MeshData& mesh) : mesh_(mesh), is_set_(mesh.vertex_count()) {}

  void set(std::uint32_t corner, const Float3& normal) {
    const std::uint32_t vertex = mesh_.indices[corner];
    if (!is_set_[vertex]) {
      is_set_[vertex] = true;
      std::copy(normal.begin(), normal.end(), mesh_.normals.begin() + 3 * std::ptrdiff_t{vertex});
    } else if (float3(mesh_.normals, vertex) != normal) {
      mesh_.indices[corner] = copy_with(vertex, normal);
    }
  }

 private:
  std::uint32_t copy_with(std::uint32_t vertex, const Float3& normal) {
    const auto [entry, is_new] =
        copies_.try_emplace({vertex, normal}, static_cast<std::uint32_t>(mesh_.vertex_count()));
    if (is_new) {
      const Float3 p = float3(mesh_.positions, vertex);
      mesh_.positions.insert(mesh_.positions.end(), p.begin(), p.end());
      mesh_.normals.insert(mesh_.normals.end(), normal.begin(), normal.end());
      for (std::size_t k = 0; k < 4 && !mesh_.colors.empty(); ++k)
        mesh_.colors.push_back(mesh_.colors[4 * std::size_t{vertex} + k]);
      for (std::size_t k = 0; k < 2 && !mesh_.texcoords.empty(); ++k)
        mesh_.texcoords.push_back(mesh_.texcoords[2 * std::size_t{vertex} + k]);
    }
    return entry->second;
  }

  MeshData& mesh_;
  std::vector<bool> is_set_;
  std::map<std::pair<std::uint32_t, Float3>, std::uint32_t> copies_;
};

/// Normals of all triangles of a mesh.
struct FaceNormals {
  std::vector<Double3> areas;   // length twice the triangle's area
  std::vector<double> lengths;  // lengths of `areas`
  std::vector<Double3> units;

  explicit FaceNormals(const MeshData& mesh) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      areas.push_back(face_normal(mesh, i));
      lengths.push_back(std::sqrt(dot(areas.back(), areas.back())));
      units.push_back(unit(areas.back()));
    }
  }

  /// The mean over those of the corners' triangles that belong; null if they cancel out.
  template <class Belongs>
  Double3 mean(std::span<const std::uint32_t> corners, const Belongs& belongs) const {
    Double3 sum{};
    double length = 0;
    for (const std::uint32_t corner : corners)
      if (const std::uint32_t face = corner / 3; belongs(face)) {
        for (std::size_t k = 0; k < 3; ++k) sum[k] += areas[face][k];
        length += lengths[face];
      }
    constexpr double kMinShare = 1e-9;  // below it, the sum is made of rounding errors
    return std::sqrt(dot(sum, sum)) > kMinShare * length ? unit(sum) : Double3{};
  }
};

Float3 rounded(const Double3& n) {
  return {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])};
}

}  // namespace

bool is_missing_normal(const float* normal) {
  const bool is_zero = !(normal[0] != 0 || normal[1] != 0 || normal[2] != 0);
  return is_zero || !std::isfinite(normal[0] + normal[1] + normal[2]);
}

void add_creased_normals(MeshData& mesh, double crease_degrees, std::span<const std::uint32_t> groups) {
  mesh.normals.resize(mesh.positions.size());
  std::vector<bool> missing;
  for (std::size_t vertex = 0; vertex < mesh.vertex_count(); ++vertex)
    missing.push_back(is_missing_normal(&mesh.normals[3 * vertex]));
  const FaceNormals faces(mesh);
  // The tolerance keeps triangles of a plane together although their positions are rounded.
  const double min_cosine = sin_cos_degrees(crease_degrees).cosine - 1e-9;
  const std::vector<std::uint32_t> corners = sorted_corners(mesh, groups);
  VertexSplitter splitter(mesh);
  for (std::size_t first = 0, end = 0; first < corners.size(); first = end) {
    const Float3 here = float3(mesh.positions, mesh.indices[corners[first]]);
    const std::uint32_t group = group_of(groups, corners[first]);
    for (end = first + 1; end < corners.size() && group_of(groups, corners[end]) == group &&
                          float3(mesh.positions, mesh.indices[corners[end]]) == here;)
      ++end;
    const std::span<const std::uint32_t> fan = std::span(corners).subspan(first, end - first);
    const bool is_compared = group == 0 && fan.size() <= kMaxComparedTriangles;
    const Double3 shared = is_compared ? Double3{} : faces.mean(fan, [](std::uint32_t) { return true; });
    for (const std::uint32_t corner : fan) {
      if (!missing[mesh.indices[corner]]) continue;
      const Double3& own = faces.units[corner / 3];
      const auto is_smooth = [&](std::uint32_t face) { return dot(faces.units[face], own) >= min_cosine; };
      const Double3 normal = is_compared ? faces.mean(fan, is_smooth) : shared;
      splitter.set(corner, rounded(normal == Double3{} ? own : normal));
    }
  }
}

void add_creased_normals(Model& model, double crease_degrees) {
  // Parts of triangles come first.
  std::size_t triangle_indices = 0;
  for (const ModelPart& part : model.parts)
    if (part.primitive == Primitive::triangles) triangle_indices = part.first_index + part.index_count;
  std::vector<std::uint32_t>& indices = model.mesh.indices;
  const auto end_of_triangles = indices.begin() + static_cast<std::ptrdiff_t>(triangle_indices);
  const std::vector<std::uint32_t> others(end_of_triangles, indices.end());
  indices.erase(end_of_triangles, indices.end());
  add_creased_normals(model.mesh, crease_degrees);
  indices.insert(indices.end(), others.begin(), others.end());
}

void orient_by_normals(Model& model) {
  MeshData& mesh = model.mesh;
  for (const ModelPart& part : model.parts) {
    if (part.primitive != Primitive::triangles || !part.is_double_sided) continue;
    for (std::size_t i = part.first_index; i < part.first_index + part.index_count; i += 3) {
      const Double3 face = face_normal(mesh, i);
      double along = 0;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Float3 n = float3(mesh.normals, mesh.indices[i + corner]);
        along += face[0] * n[0] + face[1] * n[1] + face[2] * n[2];
      }
      if (along < 0) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    }
  }
}

}  // namespace tessera::program
