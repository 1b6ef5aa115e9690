// Normals of meshes that have none.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "engine/mesh_arrays.h"
#include "engine/parallel.h"
#include "engine/scratch.h"

namespace tessera {

/// Makes normals at vertices, in memory that one mesh after the other uses.
class SmoothNormals {
 public:
  /// For each vertex the area-weighted mean over the faces that have a vertex at the very same position, unit length (or 0), in object space;
  /// 3 floats each. The same bits for any number of threads: each sum is made in the faces' order. Throws std::bad_alloc.
  void make(const MeshArrays& mesh, Parallel& parallel, Scratch<float>& normals);

 private:
  /// Items sorted by part of the mesh, those of a part in the order in which they came.
  template <class Item>
  struct Sorted {
    Scratch<Item> items;
    Scratch<std::size_t> ends;  ///< of each task's items of each part

    template <class ForEach>
    void sort(Parallel& parallel, std::size_t parts, const ForEach& for_each_of_task);
    template <class Work>
    void for_each_in(std::size_t part, const Work& work) const;

    std::size_t parts = 0;
  };
  /// A corner of a face.
  struct Corner {
    std::uint32_t vertex, face;
  };

  void find_first_at_positions(const MeshArrays& mesh, Parallel& parallel);
  void sum_faces(const MeshArrays& mesh, Parallel& parallel);

  std::size_t parts_ = 0;
  Scratch<std::uint8_t> part_;          // of each vertex: the same at the same position
  Sorted<std::uint32_t> vertices_;
  Scratch<std::uint32_t> table_, first_;
  Scratch<glm::dvec3> areas_, sums_;    // of faces; at the first vertices
  Sorted<Corner> corners_;
};

/// Of the faces that begin in triangles [first, last): for each triangle its face's normal, unit length (or 0), in object space; 3 floats each.
/// Stands from 3 first on.
void make_face_normals(const MeshArrays& mesh, std::size_t first, std::size_t last, float* normals);

}  // namespace tessera
