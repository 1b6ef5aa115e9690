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
  /// Writes normals per vertex: the area-weighted mean over the faces with a vertex at the same position,
  /// unit length or 0, object space.
  /// - Sums run in the order of the faces, so bits do not depend on the number of threads.
  /// - Throws std::bad_alloc.
  /// @param normals  receives 3 floats per vertex
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
    Scratch<std::size_t> ends;  ///< per task and partition: end of its items
    std::size_t tasks = 0;
    std::size_t partitions = 0;

    void reserve(const Partitioning& partitioning, std::size_t count);
    template <class ForEach>
    void sort(WorkerPool& worker_pool, const Partitioning& partitioning, const ForEach& for_each_of_task);
    template <class Work>
    void for_each_in(std::size_t partition, const Work& work) const;
  };
  /// A corner of a face.
  struct Corner {
    std::uint32_t vertex;  ///< the first one at its position
    std::uint32_t face;
  };

  /// Sets `first_` and zeroes `sums_`.
  void find_first_at_positions(const MeshArrays& mesh, WorkerPool& worker_pool,
                               const Partitioning& partitioning);
  /// Adds the area-weighted normal of each face to the sums of its positions.
  void sum_faces(const MeshArrays& mesh, WorkerPool& worker_pool, const Partitioning& partitioning);

  Scratch<std::uint8_t> partition_;  // per vertex; equal for equal positions
  PartitionedItems<std::uint32_t> vertices_;
  Scratch<std::uint32_t> table_;  // per partition: a hash table of vertices
  Scratch<std::uint32_t> first_;  // per vertex: the first vertex at the same position
  Scratch<glm::dvec3> areas_;     // per face: its normal, with twice its area as length
  Scratch<glm::dvec3> sums_;      // per vertex that is the first at its position
  PartitionedItems<Corner> corners_;
};

/// Writes normals[3 t .. 3 t + 2] for each triangle t of the faces that begin in triangles [first, last): the
/// normal of its face, unit length or 0, object space.
void make_face_normals(const MeshArrays& mesh, std::size_t first, std::size_t last, float* normals);

}  // namespace tessera::detail
