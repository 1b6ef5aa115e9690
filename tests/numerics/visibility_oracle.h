// Random triangles, each nearer than all before it, and the visible triangle of each pixel from 128-bit
// integers.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "engine/tessera/tessera.hpp"
#include "tests/numerics/counted_mesh.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test {

/// Triangles for a buffer of kSide x kSide pixels over black. Corners are window coordinates that clip space
/// holds exactly. Colour, texel and depth are constant over a triangle and exact levels in all formats.
class VisibilityOracle {
 public:
  static constexpr int kSide = 128;        ///< pixels
  static constexpr int kTextureSide = 64;  ///< texels
  /// Depths are 1 - k/4096, above 1/2, where their levels are exact to less than half a level in every
  /// format.
  static constexpr std::size_t kMaxTriangleCount = 2047;

  /// Overlapping triangles of all shapes.
  static VisibilityOracle of_shapes(int n) {
    VisibilityOracle owned;
    RandomTriangles random(static_cast<std::uint32_t>(n), 64);
    while (owned.triangles_.size() < 256) {
      Triangle triangle = random.next();
      const std::int32_t dx = 64 * 256 * random.between(0, 1), dy = 64 * 256 * random.between(0, 1);
      for (WindowVertex& v : triangle) v.x += dx, v.y += dy;
      owned.add(triangle);
    }
    owned.find_visible_triangles();
    return owned;
  }
  /// A grid of cells of about `cell` pixels; vertices are moved by up to a third of a cell.
  static VisibilityOracle of_grid(int n, double cell) {
    VisibilityOracle owned;
    MeshRandom random(n);
    const int cells = std::min(30, static_cast<int>(kSide / cell) + 2);
    const double left = random.unit() * (kSide - (cells - 1) * cell) - cell / 2;
    const double top = random.unit() * (kSide - (cells - 1) * cell) - cell / 2;
    std::vector<WindowVertex> points;
    for (int j = 0; j <= cells; ++j)
      for (int i = 0; i <= cells; ++i) {
        const auto moved = [&](double at) {
          return static_cast<std::int32_t>(std::lround(256 * (at + cell * (random.unit() - 0.5) * 2 / 3)));
        };
        const std::int32_t x = moved(left + i * cell);
        points.push_back({x, moved(top + j * cell), 0, 1});
      }
    const auto point = [&](int i, int j) { return points[static_cast<std::size_t>(j * (cells + 1) + i)]; };
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i) {
        const WindowVertex p = point(i, j);
        const WindowVertex q = point(i + 1, j);
        const WindowVertex r = point(i + 1, j + 1);
        const WindowVertex s = point(i, j + 1);
        owned.add({p, q, r});
        owned.add(random.coin() ? Triangle{p, r, s} : Triangle{s, r, p});
      }
    owned.find_visible_triangles();
    return owned;
  }

  std::vector<float> positions{};  ///< x y z
  std::vector<float> colors{};     ///< r g b a
  std::vector<float> normals{};    ///< x y z
  std::vector<float> texcoords{};  ///< s t
  std::uint64_t covered = 0;       ///< sum over the triangles of their covered pixels

  std::uint32_t times(std::size_t pixel) const { return times_[pixel]; }
  /// Final value of a pixel, counted from the top left.
  std::uint32_t color_word(std::size_t pixel) const { return times_[pixel] == 0 ? 0 : word_of(last_[pixel]); }
  std::uint32_t depth_word(std::size_t pixel, DepthFormat format) const {
    const double depth = times_[pixel] == 0 ? 1 : depth_of(last_[pixel]);
    if (format == DepthFormat::float32) return std::bit_cast<std::uint32_t>(static_cast<float>(depth));
    int bits = 32;
    if (format == DepthFormat::unorm16) bits = 16;
    if (format == DepthFormat::unorm24) bits = 24;
    return static_cast<std::uint32_t>(std::floor(depth * (std::exp2(bits) - 1) + 0.5));
  }
  /// RGBA, rows from the bottom: texel (i, j) belongs to triangle i + 64 j.
  static std::vector<std::uint8_t> texels() {
    std::vector<std::uint8_t> texels;
    for (std::uint32_t id = 0; id < kTextureSide * kTextureSide; ++id) {
      const std::uint32_t word = word_of(id);
      for (const int shift : {16, 8, 0}) texels.push_back(static_cast<std::uint8_t>(word >> shift));
      texels.push_back(255);
    }
    return texels;
  }

 private:
  static std::uint32_t word_of(std::uint32_t id) {
    return (id & 255) << 16 | (id >> 8) << 8 | (255 - (id & 255));
  }
  static double depth_of(std::uint32_t id) { return 1 - (id + 1) / 4096.0; }

  void add(const Triangle& triangle) {
    constexpr std::int32_t kMaxCoordinate = 16000 * 256;  // within the guard band
    for (const WindowVertex& v : triangle)
      if (std::max(std::abs(v.x), std::abs(v.y)) > kMaxCoordinate) return;
    if (triangles_.size() == kMaxTriangleCount)
      throw std::length_error("VisibilityOracle: no depth is left for another triangle");
    const auto id = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(triangle);
    const std::uint32_t word = word_of(id);
    for (const WindowVertex& v : triangle) {
      positions.insert(positions.end(), {static_cast<float>(v.x) / (128 * kSide) - 1,
                                         1 - static_cast<float>(v.y) / (128 * kSide),
                                         static_cast<float>(2 * depth_of(id) - 1)});
      for (const int shift : {16, 8, 0}) colors.push_back(static_cast<float>(word >> shift & 255) / 255);
      colors.push_back(1);
      normals.insert(normals.end(), {0, 0, 1});
      texcoords.insert(texcoords.end(), {(static_cast<float>(id % kTextureSide) + 0.5f) / kTextureSide,
                                         (static_cast<float>(id / kTextureSide) + 0.5f) / kTextureSide});
    }
  }
  void find_visible_triangles() {
    for (std::uint32_t id = 0; id < triangles_.size(); ++id)
      reference_of(triangles_[id]).for_each_covered(0, 0, kSide, kSide, [&](int x, int y) {
        const auto at = static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
        ++times_[at];
        ++covered;
        last_[at] = id;
      });
  }

  std::vector<Triangle> triangles_;
  // Per pixel: number of triangles that cover it, and the last of them.
  std::vector<std::uint32_t> times_ = std::vector<std::uint32_t>(std::size_t{kSide} * kSide);
  std::vector<std::uint32_t> last_ = times_;
};

}  // namespace tessera::test
