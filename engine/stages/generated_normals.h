// Normals of meshes that have none.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "engine/record/mesh_arrays.h"
#include "engine/runtime/worker_pool.h"
#include "engine/stages/scratch.h"

namespace tessera::detail {

/// Makes normals at vertices, in memory that one mesh after the other uses.
class SmoothNormals {
 public:
  /// Takes the memory for meshes of so many vertices and elements, so that make() takes none for them. Throws
  /// std::bad_alloc.
  void reserve(std::size_t vertices, std::size_t elements);
  /// For each vertex the area-weighted mean over the faces that have a vertex at the very same position, unit
  /// length (or 0), in object space; 3 floats each. The same bits for any number of threads: each sum is made
  /// in the faces' order. Throws std::bad_alloc.
  /// @param normals  of 3 floats for each vertex
  void make(const MeshArrays& mesh, WorkerPool& worker_pool, float* normals);

 private:
  /// How a mesh is cut.
  struct Partitioning {
    std::size_t tasks;       ///< ranges of its vertices or faces
    std::size_t partitions;  ///< of its vertices: all at one position are in the same

    Partitioning(std::size_t vertices, std::size_t elements);
    /// Calls work(first, last) for each task's range of `count` things.
    template <class Work>
    void for_each_range(WorkerPool& worker_pool, std::size_t count, const Work& work) const;
  };
  /// Items sorted by partition of the mesh, those of a partition in the order in which they came.
  template <class Item>
  struct PartitionedItems {
    Scratch<Item> items;
    Scratch<std::size_t> ends;  ///< of each task's items of each partition

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

  Scratch<std::uint8_t> partition_;  // of each vertex: the same at the same position
  PartitionedItems<std::uint32_t> vertices_;
  Scratch<std::uint32_t> table_, first_;
  Scratch<glm::dvec3> areas_, sums_;  // of faces; at the first vertices
  PartitionedItems<Corner> corners_;
};

/// Of the faces that begin in triangles [first, last): for each triangle its face's normal, unit length (or
/// 0), in object space; 3 floats each. Stands from 3 first on.
void make_face_normals(const MeshArrays& mesh, std::size_t first, std::size_t last, float* normals);

}  // namespace tessera::detail
