// Meshes whose triangles share edges, and buffers that count how often each pixel is covered.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/numerics/case_renderer.h"

namespace tessera::test {

/// Random generator of the n-th mesh of a test, independent of the meshes before it.
struct MeshRandom {
  std::mt19937 random;
  explicit MeshRandom(int n) : random(static_cast<std::uint32_t>(n)) {}
  double unit() { return static_cast<double>(random()) * 0x1p-32; }
  int between(int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  }
  bool coin() { return between(0, 1) != 0; }
  template <class T, std::size_t n>
  T one_of(const T (&values)[n]) {
    return values[static_cast<std::size_t>(between(0, n - 1))];
  }
};

/// Triangles in clip space.
struct CountedMesh {
  std::vector<float> positions;  // x y z w
  std::vector<std::uint32_t> indices;

  std::uint32_t add_vertex(double x, double y, double z = 0, double w = 1) {
    for (const double c : {x, y, z, w}) positions.push_back(static_cast<float>(c));
    return static_cast<std::uint32_t>(positions.size() / 4 - 1);
  }
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    indices.insert(indices.end(), {a, b, c});
  }
  std::size_t triangles() const { return indices.size() / 3; }
  /// Shuffles the triangles, their windings and their first vertices.
  void shuffle(MeshRandom& random);
};

/// A draw that adds one level of blue to each covered pixel.
CaseDraw counting(const CountedMesh& mesh);

/// In 1/256 pixel from the lower left corner.
struct WindowPoint {
  std::int64_t x = 0, y = 0;
};
/// Positive if c is to the left of the line from a to b.
inline std::int64_t doubled_area(const WindowPoint& a, const WindowPoint& b, const WindowPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
/// Mesh of window points. Exact in clip space if the buffer's sides are powers of two.
CountedMesh mesh_of(const std::vector<WindowPoint>& points, int width, int height);

/// A grid of vertices, `columns` x `rows` cells, row by row.
struct Grid {
  int columns = 1, rows = 1;
  std::vector<WindowPoint> points;  ///< in the window or in any other plane

  std::uint32_t index(int column, int row) const {
    return static_cast<std::uint32_t>(row * (columns + 1) + column);
  }
  /// Calls cell(p, q, r, s), the corners in order.
  template <class Cell>
  void for_each_cell(const Cell& cell) const {
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i)
        cell(index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1));
  }
  /// Whether the diagonal from p to r is inside the cell.
  bool has_diagonal(std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t s) const {
    return doubled_area(points[p], points[q], points[r]) >= 0 &&
           doubled_area(points[p], points[r], points[s]) >= 0;
  }
  /// Whether any cell is inverted; such cells overlap their neighbours.
  bool folds() const;
  bool is_convex() const;
  /// Adds each cell as two triangles, split along an inner diagonal, and shuffles them.
  void cut_into(CountedMesh& mesh, MeshRandom& random) const;
};

/// Expected coverage count of a pixel.
enum class Cover : std::uint8_t { never, once, at_most_once };

/// Expected coverage of a mesh.
struct Expected {
  std::vector<Cover> pixels{};  ///< rows from the top; empty: every pixel once
  /// Called if a pixel is covered twice: whether the snapped mesh itself overlaps.
  std::function<bool()> overlaps{};
  /// Pixels expected `at_most_once` may be covered again: slivers between an edge and a cut, thinner than the
  /// snapping distance, may flip.
  bool folds_along_cuts = false;
};
/// Counts a frame's pixels; `name` identifies the mesh in messages.
using Count = std::function<void(const std::vector<CaseDraw>& draws, const std::string& name,
                                 const Expected& expected)>;

/// Expects no pixel to be left out, covered twice, or covered where nothing is expected, and reports Mesa's
/// figures in the same rows. At most one mesh in a hundred may have overlapping triangles.
///
/// @param meshes draws and counts all meshes. Tessera alternates between tile sizes and instruction sets.
void expect_coverage(const std::string& what, const CaseFormat& format,
                     const std::function<void(const Count& count, bool is_tessera)>& meshes);

}  // namespace tessera::test
