// Triangles whose vertices lie on the snapping grid, with exact edge functions in 128-bit integers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace tessera::test {

__extension__ using Whole = __int128;

inline constexpr int kGrid = 256;  ///< steps per pixel

/// A point in 1/256 pixel from the window's upper left corner, y down.
struct GridPoint {
  std::int64_t x = 0, y = 0;
};

struct WindowTriangle {
  std::array<GridPoint, 3> at;

  /// Twice the area of the triangle between vertex k's opposite edge and a point: positive inside, for either
  /// winding.
  Whole edge(std::size_t k, const GridPoint& p) const {
    const GridPoint& a = at[(k + 1) % 3];
    const GridPoint& b = at[(k + 2) % 3];
    const Whole side = Whole{b.x - a.x} * (p.y - a.y) - Whole{b.y - a.y} * (p.x - a.x);
    return signed_area() < 0 ? -side : side;
  }
  Whole area() const { return signed_area() < 0 ? -signed_area() : signed_area(); }
  /// The vertex with the smallest y; among equals, the one with the smallest x.
  std::size_t topmost() const {
    const auto above = [](const GridPoint& a, const GridPoint& b) {
      return a.y < b.y || (a.y == b.y && a.x < b.x);
    };
    return static_cast<std::size_t>(std::min_element(at.begin(), at.end(), above) - at.begin());
  }
  static GridPoint center(int x, int y) {
    return {std::int64_t{x} * kGrid + kGrid / 2, std::int64_t{y} * kGrid + kGrid / 2};
  }
  bool contains(const GridPoint& p) const {
    return area() > 0 && edge(0, p) >= 0 && edge(1, p) >= 0 && edge(2, p) >= 0;
  }

 private:
  Whole signed_area() const {
    return Whole{at[1].x - at[0].x} * (at[2].y - at[0].y) - Whole{at[1].y - at[0].y} * (at[2].x - at[0].x);
  }
};

/// Clip coordinates of a grid point, exact in floats if the sides are powers of two.
inline double clip_x(std::int64_t x, int width) { return static_cast<double>(x) / (kGrid / 2.0 * width) - 1; }
inline double clip_y(std::int64_t y, int height) {
  return 1 - static_cast<double>(y) / (kGrid / 2.0 * height);
}

/// Random numbers that are identical on every machine and standard library.
struct Rng {
  std::mt19937 random;
  explicit Rng(std::uint32_t seed) : random(seed) {}
  double unit() { return static_cast<double>(random()) * 0x1p-32; }
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>((std::uint64_t{random()} << 32 | random()) %
                                           static_cast<std::uint64_t>(high - low + 1));
  }
  bool maybe() { return random() % 2 != 0; }
  template <class Range>
  const auto& one_of(const Range& range) {
    return range[random() % std::size(range)];
  }
};

enum class WindowShape {
  small,    ///< within a few pixels
  any,      ///< corners anywhere in the window
  centers,  ///< on pixel centres
  sliver,   ///< from end to end of the window, up to four grid steps thick
  needle    ///< long, and as thin as the grid allows: an area of half a grid square, or little more
};
inline constexpr WindowShape kWindowShapes[] = {WindowShape::small, WindowShape::any, WindowShape::centers,
                                                WindowShape::sliver, WindowShape::needle};

/// A triangle of positive area, close enough to the window to be drawn without clipping.
inline WindowTriangle random_triangle(Rng& rng, WindowShape shape, int width, int height) {
  const std::int64_t w = std::int64_t{width} * kGrid;
  const std::int64_t h = std::int64_t{height} * kGrid;
  const auto anywhere = [&] {
    return GridPoint{rng.between(-kGrid, w + kGrid), rng.between(-kGrid, h + kGrid)};
  };
  for (;;) {
    WindowTriangle t{{anywhere(), anywhere(), anywhere()}};
    GridPoint& a = t.at[0];
    GridPoint& b = t.at[1];
    GridPoint& c = t.at[2];
    switch (shape) {
      case WindowShape::any: break;
      case WindowShape::small:
        for (GridPoint* p : {&b, &c})
          *p = {a.x + rng.between(-4 * kGrid, 4 * kGrid), a.y + rng.between(-4 * kGrid, 4 * kGrid)};
        break;
      case WindowShape::centers:
        if (rng.maybe())
          for (GridPoint* p : {&b, &c})
            *p = {a.x + rng.between(-8 * kGrid, 8 * kGrid), a.y + rng.between(-8 * kGrid, 8 * kGrid)};
        for (GridPoint& p : t.at) p = {(p.x & -kGrid) + kGrid / 2, (p.y & -kGrid) + kGrid / 2};
        break;
      case WindowShape::sliver: {
        if (width > height) {
          a.x = rng.between(-kGrid, kGrid);
          b.x = w - rng.between(-kGrid, kGrid);
        } else {
          a.y = rng.between(-kGrid, kGrid);
          b.y = h - rng.between(-kGrid, kGrid);
        }
        const double along = rng.unit();
        c = {a.x + std::llround(along * static_cast<double>(b.x - a.x)) + rng.between(-4, 4),
             a.y + std::llround(along * static_cast<double>(b.y - a.y)) + rng.between(-4, 4)};
        break;
      }
      case WindowShape::needle: {
        // From a pixel's centre through other centres. Euclid's algorithm finds the third vertex, closest to
        // that line.
        a = {(a.x & -kGrid) + kGrid / 2, (a.y & -kGrid) + kGrid / 2};
        const std::int64_t turns = rng.between(1, 4);
        const std::int64_t dx = (b.x - a.x) / kGrid * kGrid;
        const std::int64_t dy = (b.y - a.y) / kGrid * kGrid;
        const std::int64_t step_x = dx + rng.between(-1, 1);
        const std::int64_t step_y = dy + rng.between(-1, 1);
        b = {a.x + step_x, a.y + step_y};
        std::int64_t r0 = step_x;
        std::int64_t r1 = step_y;
        std::int64_t s0 = 1;
        std::int64_t s1 = 0;
        std::int64_t t0 = 0;
        std::int64_t t1 = 1;
        while (r1 != 0) {
          const std::int64_t q = r0 / r1;
          std::swap(r0 -= q * r1, r1);
          std::swap(s0 -= q * s1, s1);
          std::swap(t0 -= q * t1, t1);
        }
        c = {a.x - turns * t0, a.y + turns * s0};
        break;
      }
    }
    const bool drawn_whole = std::all_of(t.at.begin(), t.at.end(), [&](const GridPoint& p) {
      const bool is_near_window = p.x >= -w && p.x <= 2 * w && p.y >= -h && p.y <= 2 * h;
      const bool is_in_guard_band =
          std::abs(p.x - w / 2) < 16000 * kGrid && std::abs(p.y - h / 2) < 16000 * kGrid;
      return is_near_window && is_in_guard_band;
    });
    if (drawn_whole && t.area() > 0) {
      std::rotate(t.at.begin(), t.at.begin() + rng.between(0, 2), t.at.end());
      if (rng.maybe()) std::swap(t.at[1], t.at[2]);
      return t;
    }
  }
}

}  // namespace tessera::test
