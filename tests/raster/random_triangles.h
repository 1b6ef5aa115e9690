// Random triangles of the shapes that are difficult for a rasterizer, near a tile whose first pixel is (0,
// 0).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ostream>
#include <random>

#include "raster/coverage_reference.h"

namespace tessera::test {
using namespace detail;

using Triangle = std::array<WindowVertex, 3>;

inline TriangleReference reference_of(const Triangle& t) {
  const WindowVertex v[3] = {t[0], t[1], t[2]};
  return TriangleReference(v);
}

enum class Shape {
  tiny,            // within 4x4 pixels
  medium,          // up to 30 pixels
  large,           // up to 300
  widest_edges32,  // as wide as the 32-bit path allows
  edges64,         // up to the widest possible
  sliver,          // long, and a few 1/256 pixel thick
  needle,          // long, and thinner than 1/256 pixel
  on_centers,      // vertices on pixel centres
  on_borders,      // vertices on and next to the tile's borders
  axis_aligned,    // horizontal and vertical edges
  kCount
};

class RandomTriangles {
 public:
  RandomTriangles(std::uint32_t seed, int tile_size) : random_(seed), tile_size_(tile_size) {}

  std::int32_t between(std::int32_t low, std::int32_t high) {
    return std::uniform_int_distribution<std::int32_t>(low, high)(random_);
  }
  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  std::mt19937& random() { return random_; }
  Shape any_shape() { return static_cast<Shape>(between(0, static_cast<int>(Shape::kCount) - 1)); }

  Triangle next() { return next(any_shape()); }
  Triangle next(Shape shape) {
    Triangle t = make(shape);
    if (between(0, 1) != 0) std::swap(t[1], t[2]);
    std::rotate(t.begin(), t.begin() + between(0, 2), t.end());
    return t;
  }

 private:
  WindowVertex in_tile() {
    return {between(-512, tile_size_ * 256 + 512), between(-512, tile_size_ * 256 + 512), 0, 1};
  }
  static WindowVertex moved(const WindowVertex& v, double dx, double dy) {
    return {v.x + static_cast<std::int32_t>(std::lround(dx)),
            v.y + static_cast<std::int32_t>(std::lround(dy)), 0, 1};
  }
  Triangle around(double low_px, double high_px) {
    // Corners in three directions from a point of the tile, so that most triangles touch the tile.
    const WindowVertex c = in_tile();
    const double start = unit() * 6.283185307;
    Triangle t;
    for (int k = 0; k < 3; ++k) {
      const double angle = start + (k + 0.9 * unit()) * 2.0943951;
      const double radius = 256 * (low_px + (high_px - low_px) * unit());
      t[static_cast<std::size_t>(k)] = moved(c, radius * std::cos(angle), radius * std::sin(angle));
    }
    return t;
  }
  Triangle thin(double thickness) {
    const WindowVertex c = in_tile();
    const double angle = unit() * 6.283185307;
    const double before = 256 * std::exp2(unit() * 13.9);
    const double after = 256 * std::exp2(unit() * 13.9);
    const double x = std::cos(angle), y = std::sin(angle);
    const double off = thickness * (2 * unit() - 1);
    const double at = unit();
    const WindowVertex a = moved(c, -before * x, -before * y), b = moved(c, after * x, after * y);
    return {a, b, moved(a, at * (b.x - a.x) - off * y, at * (b.y - a.y) + off * x)};
  }
  // From a pixel's centre along a lattice vector b to the lattice points nearest to its line: the doubled
  // area is a small multiple of gcd(b).
  Triangle needle() {
    const WindowVertex c{between(0, tile_size_ - 1) * 256 + 128, between(0, tile_size_ - 1) * 256 + 128, 0,
                         1};
    const int reach = 1 << between(4, 22);
    std::int64_t bx = between(-reach, reach), by = between(-reach, reach);
    if (between(0, 2) == 0) bx = bx / 256 * 256, by = by / 256 * 256;  // through other centres
    // Euclid's algorithm: bx v - by u = gcd.
    std::int64_t r0 = bx, r1 = by, s0 = 1, s1 = 0, t0 = 0, t1 = 1;
    while (r1 != 0) {
      const std::int64_t q = r0 / r1;
      std::swap(r0 -= q * r1, r1);
      std::swap(s0 -= q * s1, s1);
      std::swap(t0 -= q * t1, t1);
    }
    const std::int64_t u = -t0, v = s0, times = between(0, 1) != 0 ? 1 : between(1, 4096);
    const std::int64_t longest = std::max<std::int64_t>({std::abs(bx), std::abs(by), 1});
    const std::int64_t ux = times * u;
    const std::int64_t uy = times * v;
    const bool is_x_longer = std::abs(bx) > std::abs(by);
    const std::int64_t sign = (is_x_longer ? bx : by) < 0 ? -1 : 1;
    const std::int64_t turns = (is_x_longer ? ux : uy) / longest * sign;
    const WindowVertex far{c.x + static_cast<std::int32_t>(bx), c.y + static_cast<std::int32_t>(by), 0, 1};
    const WindowVertex beside{c.x + static_cast<std::int32_t>(ux - turns * bx),
                              c.y + static_cast<std::int32_t>(uy - turns * by), 0, 1};
    return {c, far, beside};
  }
  Triangle make(Shape shape) {
    switch (shape) {
      case Shape::tiny: return around(0, 2);
      case Shape::medium: return around(1, 16);
      case Shape::large: return around(10, 300);
      case Shape::widest_edges32: {
        Triangle t = around(900, 992);
        if (between(0, 1) != 0) t[1] = {t[0].x + 1984 * 256, t[0].y - between(0, 1984 * 256), 0, 1};
        return t;
      }
      case Shape::edges64: {
        if (between(0, 1) != 0) return around(1000, 16383);
        const std::int32_t far = 16383 * 256;
        Triangle t{WindowVertex{-far, between(-far, far), 0, 1}, WindowVertex{far, between(-far, far), 0, 1},
                   in_tile()};
        if (between(0, 1) != 0)
          for (WindowVertex& v : t) std::swap(v.x, v.y);
        return t;
      }
      case Shape::sliver: return thin(4);
      case Shape::needle: return needle();
      case Shape::on_centers: {
        Triangle t = between(0, 1) != 0 ? around(0, 8) : around(0, 100);
        for (WindowVertex& v : t) v.x = (v.x & ~255) + 128, v.y = (v.y & ~255) + 128;
        return t;
      }
      case Shape::on_borders: {
        Triangle t;
        for (WindowVertex& v : t) {
          const auto place = [&] {
            const std::int32_t border = between(0, 1) * tile_size_ * 256;
            return between(0, 3) == 0 ? between(0, tile_size_ * 256)
                                      : border + between(-1, 1) * (between(0, 1) != 0 ? 128 : 1);
          };
          v = {place(), place(), 0, 1};
        }
        return t;
      }
      default: {
        Triangle t = around(0, 60);
        if (between(0, 1) != 0) t[1].x = t[0].x;
        if (between(0, 1) != 0) t[2].y = t[0].y;
        return t;
      }
    }
  }

  std::mt19937 random_;
  int tile_size_;
};

/// True if TESSERA_LONG requests long-running tests.
inline bool long_tests() {
  const char* value = std::getenv("TESSERA_LONG");
  return value != nullptr && *value != '\0' && *value != '0';
}

struct Describe {
  const Triangle& triangle;
  friend std::ostream& operator<<(std::ostream& out, const Describe& d) {
    for (const WindowVertex& v : d.triangle)
      out << "{" << v.x << ", " << v.y << ", z " << v.z << ", rw " << v.rw << "} ";
    return out;
  }
};

}  // namespace tessera::test
