// Generated normals of meshes without normals.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "engine/record/mesh_arrays.h"
#include "engine/runtime/worker_pool.h"
#include "engine/stages/scratch.h"

namespace tessera::detail {

/// Generates normals at vertices. Memory is reused from mesh to mesh.
class SmoothNormals {
 public:
  /// Allocates memory for meshes of this size; make() then allocates none. Throws std::bad_alloc.
  void reserve(std::size_t vertices, std::size_t elements);
  /// Per vertex: the area-weighted mean over the faces with a vertex at the same position, unit length or 0,
  /// object space. Sums run in the order of the faces, so bits do not depend on the number of threads. Throws
  /// std::bad_alloc.
  /// @param normals  3 floats per vertex
  void make(const MeshArrays& mesh, WorkerPool& worker_pool, float* normals);

 private:
  /// Partitioning of a mesh for parallel work.
  struct Partitioning {
    std::size_t tasks;       ///< ranges of its vertices or faces
    std::size_t partitions;  ///< groups of vertices; equal positions are in the same group

    Partitioning(std::size_t vertices, std::size_t elements);
    /// Calls work(first, last) for each task's range of `count` items.
    template <class Work>
    void for_each_range(WorkerPool& worker_pool, std::size_t count, const Work& work) const;
  };
  /// Items sorted by partition; stable.
  template <class Item>
  struct PartitionedItems {
    Scratch<Item> items;
    Scratch<std::size_t> ends;  ///< per partition and task: end of its items

    void reserve(const Partitioning& partitioning, std::size_t count);
    template <class ForEach>
    void sort(WorkerPool& worker_pool, const Partitioning& partitioning, const ForEach& for_each_of_task);
    template <class Work>
    void for_each_in(std::size_t partition, const Work& work) const;

    std::size_t tasks = 0, partitions = 0;
  };
  /// A corner of a face.
  struct Corner {
    std::uint32_t vertex, face;
  };

  void find_first_at_positions(const MeshArrays& mesh, WorkerPool& worker_pool,
                               const Partitioning& partitioning);
  void sum_faces(const MeshArrays& mesh, WorkerPool& worker_pool, const Partitioning& partitioning);

  Scratch<std::uint8_t> partition_;  // per vertex; equal for equal positions
  PartitionedItems<std::uint32_t> vertices_;
  Scratch<std::uint32_t> table_, first_;
  Scratch<glm::dvec3> areas_, sums_;  // per face; per first vertex at a position
  PartitionedItems<Corner> corners_;
};

/// Writes normals[3 t .. 3 t + 2] for each triangle t of the faces that begin in triangles [first, last): the
/// normal of its face, unit length or 0, object space.
void make_face_normals(const MeshArrays& mesh, std::size_t first, std::size_t last, float* normals);

}  // namespace tessera::detail
