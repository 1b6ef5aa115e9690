// Reads the faces, triangle strips and edges of PLY files.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/program/import/index_table.h"
#include "engine/program/import/ply_vertices.h"

namespace tessera::program {

/// Attributes that a face gives its corners: a color, or texture coordinates of each corner.
struct PlyLook {
  std::array<float, 4> color{1, 1, 1, 1};
  std::array<float, 2> texcoord{0, 0};
};

/// Triangles of a PLY file, as indices of its vertices; or of corners, if faces have looks.
class PlyFaces {
 public:
  explicit PlyFaces(const PlyHeader& header);
  /// Vertices for the faces that are read from now on; null: polygons become fans.
  void set_vertices(const PlyVertices* vertices) { vertices_ = vertices; }

  /// Reads an element `face`: polygons in a list `vertex_indices` or `vertex_index`. Those with fewer than 3
  /// corners are ignored, concave ones of up to 4096 corners become triangles inside.
  /// - Colors as for vertices; the list `texcoord` (MeshLab) holds s t of each corner.
  /// @throws Error for an index of no vertex, and as PlyValues does
  void read_polygons(const PlyElement& element, PlyValues& values);
  /// Reads an element `tristrips`: a list `vertex_indices` of strips, which -1 ends.
  void read_strips(const PlyElement& element, PlyValues& values);
  /// Reads an element `edge`: vertex1 and vertex2.
  void read_edges(const PlyElement& element, PlyValues& values);

  bool has_triangles() const { return !triangles_.empty(); }
  std::vector<std::uint32_t>& triangles() { return triangles_; }
  std::vector<std::uint32_t>& edges() { return edges_; }

  /// If faces have looks, gives each corner of triangles a vertex with the look of its face. Equal ones are
  /// shared, and vertices that no face uses are removed.
  void apply_looks(PlyVertices& vertices);

 private:
  struct Polygon {
    std::vector<std::uint32_t> corners;
    std::vector<float> texcoords;
    std::array<float, 4> color{1, 1, 1, 1};
  };

  std::uint32_t index(PlyValues& values, PlyType type) const;
  void add(const Polygon& polygon);
  void add_triangle(const Polygon& polygon, const std::array<std::uint32_t, 3>& numbers);
  std::uint32_t corner_of(std::uint32_t vertex, const PlyLook& look);

  const PlyVertices* vertices_ = nullptr;
  std::uint64_t vertex_count_ = 0;  // as the header claims
  std::vector<std::uint32_t> triangles_, edges_;
  bool have_colors_ = false, have_texcoords_ = false;
  // Corners with different vertices or looks.
  std::vector<std::uint32_t> corner_vertices_;
  std::vector<PlyLook> corner_looks_;
  IndexTable corners_;
};

}  // namespace tessera::program
