#include "engine/stages/generated_normals.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include <glm/glm.hpp>

#include "engine/record/matrix.h"

namespace tessera::detail {
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

/// Twice the area of a polygon times its unit normal. The sum over its triangles does not depend on the
/// split.
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
  const glm::dvec3 m = scaled_to_safe_range(v);
  const double length = glm::length(m);
  const glm::dvec3 n = length > 0 ? m / length : glm::dvec3(0);
  for (int k = 0; k < 3; ++k) out[k] = static_cast<float>(n[k]);
}

/// Bits of a position. Positions are compared as bits, because a NaN differs from itself as a float.
using Key = std::array<std::uint32_t, 4>;
Key key_at(const MeshArrays& mesh, std::size_t vertex) {
  const float* p = mesh.positions.at(vertex);
  const float w = mesh.components == 4 ? p[3] : 1.0f;
  // + 0 turns -0 into 0.
  return std::bit_cast<Key>(std::array<float, 4>{p[0] + 0.0f, p[1] + 0.0f, p[2] + 0.0f, w + 0.0f});
}
std::uint64_t hash_of(const Key& key) {
  std::uint64_t hash = 0;
  for (const std::uint32_t bits : key) {
    hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
  }
  return hash;
}

constexpr std::size_t kMaxTasks = 64;
constexpr std::size_t kItemsPerTask = 1024;
constexpr std::size_t kMaxPartitions = 64;
constexpr std::size_t kVerticesPerPartition = 4096;

/// Size of an open-addressing table: a power of two.
std::size_t table_slots(std::size_t vertices) { return std::bit_ceil(2 * vertices + 1); }

}  // namespace

SmoothNormals::Partitioning::Partitioning(std::size_t vertices, std::size_t elements)
    : tasks(std::clamp(std::max(vertices, elements) / kItemsPerTask, std::size_t{1}, kMaxTasks)),
      partitions(std::clamp(vertices / kVerticesPerPartition, std::size_t{1}, kMaxPartitions)) {}
template <class Work>
void SmoothNormals::Partitioning::for_each_range(WorkerPool& worker_pool, std::size_t count,
                                                 const Work& work) const {
  worker_pool.for_each(
      tasks, [&](std::size_t task, int) { work(count * task / tasks, count * (task + 1) / tasks); });
}

template <class Item>
void SmoothNormals::PartitionedItems<Item>::reserve(const Partitioning& partitioning, std::size_t count) {
  items.resize(count);
  ends.resize(partitioning.tasks * partitioning.partitions);
}

/// @param for_each_of_task  for_each_of_task(task, add) calls add(partition, item) for each item of a task;
///                          it is called twice per task
template <class Item>
template <class ForEach>
void SmoothNormals::PartitionedItems<Item>::sort(WorkerPool& worker_pool, const Partitioning& partitioning,
                                                 const ForEach& for_each_of_task) {
  tasks = partitioning.tasks;
  partitions = partitioning.partitions;
  std::size_t* const at = ends.resize(tasks * partitions);
  worker_pool.for_each(tasks, [&](std::size_t task, int) {
    std::size_t* const counts = at + task * partitions;
    std::fill_n(counts, partitions, std::size_t{0});
    for_each_of_task(task, [&](std::size_t partition, const Item&) { ++counts[partition]; });
  });
  std::size_t begin = 0;
  for (std::size_t partition = 0; partition < partitions; ++partition)
    for (std::size_t task = 0; task < tasks; ++task)
      begin += std::exchange(at[task * partitions + partition], begin);
  Item* const sorted = items.resize(begin);
  worker_pool.for_each(tasks, [&](std::size_t task, int) {
    for_each_of_task(task, [&](std::size_t partition, const Item& item) {
      sorted[at[task * partitions + partition]++] = item;
    });
  });
}

template <class Item>
template <class Work>
void SmoothNormals::PartitionedItems<Item>::for_each_in(std::size_t partition, const Work& work) const {
  const std::size_t* const last_task = ends.data() + (tasks - 1) * partitions;
  for (std::size_t i = partition == 0 ? 0 : last_task[partition - 1]; i < last_task[partition]; ++i)
    work(items.data()[i]);
}

// Per partition, a table with open addressing holds the first vertex at each position.
void SmoothNormals::find_first_at_positions(const MeshArrays& mesh, WorkerPool& worker_pool,
                                            const Partitioning& partitioning) {
  std::uint8_t* const partition = partition_.resize(mesh.vertices);
  partitioning.for_each_range(worker_pool, mesh.vertices, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v)
      partition[v] = static_cast<std::uint8_t>((hash_of(key_at(mesh, v)) >> 32) % partitioning.partitions);
  });
  vertices_.sort(worker_pool, partitioning, [&](std::size_t task, const auto& add) {
    for (std::size_t v = mesh.vertices * task / partitioning.tasks;
         v < mesh.vertices * (task + 1) / partitioning.tasks; ++v)
      add(partition[v], static_cast<std::uint32_t>(v));
  });
  std::size_t begin[kMaxPartitions + 1] = {};
  for (std::size_t p = 0; p < partitioning.partitions; ++p) {
    std::size_t count = 0;
    vertices_.for_each_in(p, [&](std::uint32_t) { ++count; });
    begin[p + 1] = begin[p] + table_slots(count);
  }
  std::uint32_t* const tables = table_.resize(begin[partitioning.partitions]);
  std::uint32_t* const first_at = first_.resize(mesh.vertices);
  glm::dvec3* const sums = sums_.resize(mesh.vertices);
  worker_pool.for_each(partitioning.partitions, [&](std::size_t p, int) {
    constexpr std::uint32_t kEmpty = 0xffffffffu;
    std::uint32_t* const table = tables + begin[p];
    const std::size_t slots = begin[p + 1] - begin[p];
    std::fill_n(table, slots, kEmpty);
    vertices_.for_each_in(p, [&](std::uint32_t v) {
      const Key key = key_at(mesh, v);
      std::size_t slot = hash_of(key) & (slots - 1);
      while (table[slot] != kEmpty && key_at(mesh, table[slot]) != key) slot = (slot + 1) & (slots - 1);
      if (table[slot] == kEmpty) table[slot] = v;
      first_at[v] = table[slot];
      sums[v] = glm::dvec3(0);
    });
  });
}

void SmoothNormals::sum_faces(const MeshArrays& mesh, WorkerPool& worker_pool,
                              const Partitioning& partitioning) {
  const std::size_t each = mesh.triangles_per_polygon();
  const std::size_t faces = mesh.elements / each;
  glm::dvec3* const areas = areas_.resize(faces);
  partitioning.for_each_range(worker_pool, faces, [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) areas[f] = area_normal(mesh, f * each, (f + 1) * each);
  });
  corners_.sort(worker_pool, partitioning, [&](std::size_t task, const auto& add) {
    const auto add_corner = [&](std::size_t vertex, std::size_t face) {
      add(partition_.data()[vertex], Corner{first_.data()[vertex], static_cast<std::uint32_t>(face)});
    };
    for (std::size_t f = faces * task / partitioning.tasks; f < faces * (task + 1) / partitioning.tasks;
         ++f) {
      // A polygon that is not finite will be dropped; its neighbours keep their normals.
      if (!std::isfinite(areas[f].x + areas[f].y + areas[f].z)) continue;
      // The first triangle of a polygon has three of its vertices; each further triangle adds one.
      for (const std::size_t v : vertices_of(mesh, f * each)) add_corner(v, f);
      for (std::size_t t = f * each + 1; t < (f + 1) * each; ++t)
        add_corner(mesh.vertex_at(added_corner(mesh.primitive, t)), f);
    }
  });
  // A face counts once per position, even if several of its corners coincide. Within a partition, corners of
  // a face are consecutive.
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t* const last_face = table_.data();  // per vertex; reuses the memory of the table
  if (each > 1)
    partitioning.for_each_range(worker_pool, mesh.vertices, [&](std::size_t first, std::size_t last) {
      std::fill(last_face + first, last_face + last, kNone);
    });
  worker_pool.for_each(partitioning.partitions, [&](std::size_t partition, int) {
    corners_.for_each_in(partition, [&](const Corner& corner) {
      if (each == 1 || std::exchange(last_face[corner.vertex], corner.face) != corner.face)
        sums_.data()[corner.vertex] += areas[corner.face];
    });
  });
}

void SmoothNormals::reserve(std::size_t vertices, std::size_t elements) {
  const Partitioning partitioning(vertices, elements);
  partition_.resize(vertices);
  vertices_.reserve(partitioning, vertices);
  table_.resize(4 * vertices + 2 * partitioning.partitions);  // table_slots(n) <= 4 n + 2
  first_.resize(vertices);
  sums_.resize(vertices);
  areas_.resize(elements);
  corners_.reserve(partitioning, 3 * elements);
}

void SmoothNormals::make(const MeshArrays& mesh, WorkerPool& worker_pool, float* normals) {
  const bool has_faces = mesh.topology() == Topology::triangles;
  const Partitioning partitioning(mesh.vertices, mesh.elements);
  if (has_faces) {
    find_first_at_positions(mesh, worker_pool, partitioning);
    sum_faces(mesh, worker_pool, partitioning);
  }
  partitioning.for_each_range(worker_pool, mesh.vertices, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v)
      store_unit(has_faces ? sums_.data()[first_.data()[v]] : glm::dvec3(0), normals + 3 * v);
  });
}

void make_face_normals(const MeshArrays& mesh, std::size_t first, std::size_t last, float* normals) {
  const std::size_t each = mesh.triangles_per_polygon();
  for (std::size_t begin = (first + each - 1) / each * each; begin < last; begin += each) {
    const glm::dvec3 normal = area_normal(mesh, begin, begin + each);
    for (std::size_t t = begin; t < begin + each; ++t) store_unit(normal, normals + 3 * t);
  }
}

}  // namespace tessera::detail
