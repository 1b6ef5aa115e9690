// Vertices of a mesh for the corners of an OBJ file.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/program/import/index_table.h"
#include "engine/program/import/obj_file.h"

namespace tessera::program {

/// Arrays that the vertices of a mesh have.
struct ObjAttributes {
  bool normals = false;
  bool texcoords = false;
  bool colors = false;
};

/// Changes that a material makes to its vertices.
struct ObjVertexLook {
  std::uint32_t number = 0;  ///< equal numbers have equal looks; 0: changes nothing
  std::array<float, 4> color_factor{1, 1, 1, 1};
  std::array<float, 2> texcoord_scale{1, 1};
  std::array<float, 2> texcoord_offset{0, 0};
};

/// Turns corners into vertices; equal corners share one.
class ObjVertices {
 public:
  /// @param positions  x y z for each position of the file
  /// @param mesh       gets the vertices; others may append to it between calls
  ObjVertices(const ObjFile& file, const std::vector<float>& positions, ObjAttributes attributes,
              MeshData& mesh);

  /// The index of the corner's vertex. A missing normal is 0 0 0, missing texture coordinates are 0 0.
  std::uint32_t index(const ObjCorner& corner, const ObjVertexLook& look);

 private:
  /// Equal keys share a vertex.
  struct Key {
    std::uint32_t position, look;
    std::int32_t texcoord, normal;
    bool operator==(const Key&) const = default;
  };

  Key key_of(const ObjCorner& corner, const ObjVertexLook& look) const;
  void append(const ObjCorner& corner, const ObjVertexLook& look);

  const ObjFile& file_;
  const std::vector<float>& positions_;
  ObjAttributes attributes_;
  MeshData& mesh_;
  IndexTable table_;                     // finds keys_
  std::vector<Key> keys_;                // in the order of first use
  std::vector<std::uint32_t> vertices_;  // per key, its vertex
};

}  // namespace tessera::program
