#include "engine/program/import/model_normals.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/program/import/index_table.h"
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

/// Calls act() with 0 to count - 1, and reports progress.
template <class Act>
void for_each(std::size_t count, const ReportProgress& progress, const Act& act) {
  constexpr std::size_t kReportInterval = 1 << 16;
  for (std::size_t i = 0; i < count; ++i) {
    act(i);
    if (progress && i % kReportInterval == 0) progress(static_cast<double>(i) / static_cast<double>(count));
  }
}

/// The corners at each position, in ascending order.
class CornersByPosition {
 public:
  CornersByPosition(const MeshData& mesh, const ReportProgress& progress) : ends_(mesh.vertex_count() + 1) {
    const std::vector<std::uint32_t> first = first_vertices(mesh, part_of(progress, 0, 0.5));
    const std::size_t corners = mesh.indices.size() / 3 * 3;
    for_each(corners, part_of(progress, 0.5, 0.7),
             [&](std::size_t corner) { ++ends_[first[mesh.indices[corner]] + 1]; });
    std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
    corners_.resize(corners);
    for_each(corners, part_of(progress, 0.7, 1), [&](std::size_t corner) {
      corners_[ends_[first[mesh.indices[corner]]]++] = static_cast<std::uint32_t>(corner);
    });
  }
  /// The corners at the position of a vertex, if it is the first one there; else none.
  std::span<const std::uint32_t> at(std::uint32_t vertex) const {
    const std::uint32_t begin = vertex == 0 ? 0 : ends_[vertex - 1];
    return std::span(corners_).subspan(begin, ends_[vertex] - begin);
  }

 private:
  /// The first vertex at the position of each vertex.
  static std::vector<std::uint32_t> first_vertices(const MeshData& mesh, const ReportProgress& progress) {
    std::vector<std::uint32_t> first(mesh.vertex_count());
    IndexTable table;
    for_each(first.size(), progress, [&](std::size_t i) {
      const auto vertex = static_cast<std::uint32_t>(i);
      const std::array<std::uint32_t, 3> here = position_bits(mesh, vertex);
      const auto is_here = [&](std::uint32_t other) { return position_bits(mesh, other) == here; };
      const std::uint64_t hash = mixed(mixed(here[0], here[1]), here[2]);
      first[vertex] = table.find_or_add(static_cast<std::uint32_t>(hash), vertex, is_here);
    });
    return first;
  }
  static std::array<std::uint32_t, 3> position_bits(const MeshData& mesh, std::uint32_t vertex) {
    return std::bit_cast<std::array<std::uint32_t, 3>>(float3(mesh.positions, vertex));
  }

  std::vector<std::uint32_t> ends_;  // per vertex, end of its corners, where those of the next vertex begin
  std::vector<std::uint32_t> corners_;
};

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

  /// Forgets the copies: the following corners are at another position.
  void begin_position() { copies_.clear(); }

 private:
  struct Copy {
    std::uint32_t vertex;
    Float3 normal;
    std::uint32_t index;
  };

  std::uint32_t copy_with(std::uint32_t vertex, const Float3& normal) {
    for (const Copy& copy : copies_)
      if (copy.vertex == vertex && copy.normal == normal) return copy.index;
    const auto index = static_cast<std::uint32_t>(mesh_.vertex_count());
    copies_.push_back({vertex, normal, index});
    const Float3 p = float3(mesh_.positions, vertex);
    mesh_.positions.insert(mesh_.positions.end(), p.begin(), p.end());
    mesh_.normals.insert(mesh_.normals.end(), normal.begin(), normal.end());
    for (std::size_t k = 0; k < 4 && !mesh_.colors.empty(); ++k)
      mesh_.colors.push_back(mesh_.colors[4 * std::size_t{vertex} + k]);
    for (std::size_t k = 0; k < 2 && !mesh_.texcoords.empty(); ++k)
      mesh_.texcoords.push_back(mesh_.texcoords[2 * std::size_t{vertex} + k]);
    return index;
  }

  MeshData& mesh_;
  std::vector<bool> is_set_;
  std::vector<Copy> copies_;  // copied vertices at this position
};

Float3 rounded(const Double3& n) {
  return {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])};
}

/// Adds the normals of corners at one position.
class PositionNormals {
 public:
  PositionNormals(MeshData& mesh, const std::vector<bool>& missing, double min_cosine)
      : mesh_(mesh), missing_(missing), min_cosine_(min_cosine), splitter_(mesh) {}

  /// @param groups  as for add_creased_normals()
  void add(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> groups) {
    if (std::ranges::none_of(corners, [this](std::uint32_t corner) { return is_missing(corner); })) return;
    splitter_.begin_position();
    if (groups.empty()) return add_group(corners, true);
    const auto group_of = [groups](std::uint32_t corner) { return groups[corner / 3]; };
    sorted_.assign(corners.begin(), corners.end());
    std::ranges::stable_sort(sorted_, {}, group_of);
    for (auto first = sorted_.begin(), end = first; first != sorted_.end(); first = end) {
      const std::uint32_t group = group_of(*first);
      end =
          std::find_if(first, sorted_.end(), [&](std::uint32_t corner) { return group_of(corner) != group; });
      add_group({first, end}, group == 0);
    }
  }

 private:
  struct Face {
    Double3 area;   // length twice the triangle's area
    double length;  // length of area
    Double3 unit;
  };

  bool is_missing(std::uint32_t corner) const { return missing_[mesh_.indices[corner]]; }

  /// @param is_creased  whether edges sharper than the crease angle separate triangles
  void add_group(std::span<const std::uint32_t> corners, bool is_creased) {
    faces_.clear();
    for (const std::uint32_t corner : corners) {
      const Double3 area = face_normal(mesh_, corner / 3 * 3);
      faces_.push_back({area, std::sqrt(dot(area, area)), unit(area)});
    }
    const bool is_compared = is_creased && corners.size() <= kMaxComparedTriangles;
    const Double3 shared = is_compared ? Double3{} : mean([](const Face&) { return true; });
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!is_missing(corners[i])) continue;
      const Double3& own = faces_[i].unit;
      const auto is_smooth = [&](const Face& face) { return dot(face.unit, own) >= min_cosine_; };
      const Double3 normal = is_compared ? mean(is_smooth) : shared;
      splitter_.set(corners[i], rounded(normal == Double3{} ? own : normal));
    }
  }

  /// The mean over the triangles that belong; null if they cancel out.
  template <class Belongs>
  Double3 mean(const Belongs& belongs) const {
    Double3 sum{};
    double length = 0;
    for (const Face& face : faces_) {
      if (!belongs(face)) continue;
      for (std::size_t k = 0; k < 3; ++k) sum[k] += face.area[k];
      length += face.length;
    }
    constexpr double kMinShare = 1e-9;  // below it, the sum is made of rounding errors
    return std::sqrt(dot(sum, sum)) > kMinShare * length ? unit(sum) : Double3{};
  }

  MeshData& mesh_;
  const std::vector<bool>& missing_;  // per vertex, before any was added
  double min_cosine_;
  VertexSplitter splitter_;
  std::vector<Face> faces_;            // per corner of the group
  std::vector<std::uint32_t> sorted_;  // corners by group
};

}  // namespace

bool is_missing_normal(const float* normal) {
  const bool is_zero = !(normal[0] != 0 || normal[1] != 0 || normal[2] != 0);
  return is_zero || !std::isfinite(normal[0] + normal[1] + normal[2]);
}

void add_creased_normals(MeshData& mesh, double crease_degrees, std::span<const std::uint32_t> groups,
                         const ReportProgress& progress) {
  mesh.normals.resize(mesh.positions.size());
  const auto vertices = static_cast<std::uint32_t>(mesh.vertex_count());
  std::vector<bool> missing(vertices);
  for (std::size_t vertex = 0; vertex < vertices; ++vertex)
    missing[vertex] = is_missing_normal(&mesh.normals[3 * vertex]);
  if (std::ranges::find(missing, true) == missing.end()) return;
  // The tolerance keeps triangles of a plane together although their positions are rounded.
  const double min_cosine = sin_cos_degrees(crease_degrees).cosine - 1e-9;
  const CornersByPosition corners(mesh, part_of(progress, 0, 0.5));
  PositionNormals normals(mesh, missing, min_cosine);
  for_each(vertices, part_of(progress, 0.5, 1),
           [&](std::size_t vertex) { normals.add(corners.at(static_cast<std::uint32_t>(vertex)), groups); });
}

void add_creased_normals(Model& model, double crease_degrees, const ReportProgress& progress) {
  // Parts of triangles come first.
  std::size_t triangle_indices = 0;
  for (const ModelPart& part : model.parts)
    if (part.primitive == Primitive::triangles) triangle_indices = part.first_index + part.index_count;
  std::vector<std::uint32_t>& indices = model.mesh.indices;
  const auto end_of_triangles = indices.begin() + static_cast<std::ptrdiff_t>(triangle_indices);
  const std::vector<std::uint32_t> others(end_of_triangles, indices.end());
  indices.erase(end_of_triangles, indices.end());
  add_creased_normals(model.mesh, crease_degrees, {}, progress);
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

void complete_normals(Model& model, const ReportProgress& progress) {
  add_creased_normals(model, kCreaseDegrees, progress);
  orient_by_normals(model);
}

}  // namespace tessera::program
