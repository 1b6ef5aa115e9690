#include "engine/program/import/polygon_split.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tessera::program {
namespace {

using Float3 = std::array<float, 3>;
using Point = std::array<double, 2>;
using Triangle = std::array<std::uint32_t, 3>;

/// Twice the area of a triangle, positive if counter-clockwise.
double signed_area(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

float squared_distance(const Float3& a, const Float3& b) {
  const float x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2];
  return x * x + y * y + z * z;
}

/// Projects along the axis nearest to the polygon's normal, so that the result is counter-clockwise.
std::vector<Point> projected(std::span<const Float3> corners) {
  const std::array<double, 3> normal = polygon_normal(corners);
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
  std::size_t first = (axis + 1) % 3, second = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(first, second);
  std::vector<Point> points;
  for (const Float3& p : corners) points.push_back({p[first], p[second]});
  return points;
}

/// Cuts ears off a counter-clockwise polygon: G. H. Meisters, Polygons Have Ears, 1975.
class EarCutter {
 public:
  explicit EarCutter(std::vector<Point> points) : points_(std::move(points)) {
    for (std::uint32_t i = 0; i < points_.size(); ++i) left_.push_back(i);
    for (std::uint32_t i = 0; i < points_.size(); ++i)
      if (area_at(i) <= 0) reflex_.push_back(i);
  }

  std::vector<Triangle> cut() {
    std::vector<Triangle> triangles;
    std::size_t tip = 1;
    while (left_.size() > 3) {
      tip = next_ear(tip);
      triangles.push_back({before(tip), left_[tip], after(tip)});
      std::erase(reflex_, left_[tip]);
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(tip));
      if (tip >= left_.size()) tip = 0;
    }
    triangles.push_back({left_[0], left_[1], left_[2]});
    return triangles;
  }

 private:
  std::uint32_t before(std::size_t i) const { return left_[(i + left_.size() - 1) % left_.size()]; }
  std::uint32_t after(std::size_t i) const { return left_[(i + 1) % left_.size()]; }
  double area_at(std::size_t i) const {
    return signed_area(points_[before(i)], points_[left_[i]], points_[after(i)]);
  }

  /// The first ear from `start` on; `start` itself if there is none.
  std::size_t next_ear(std::size_t start) const {
    for (std::size_t k = 0; k < left_.size(); ++k) {
      const std::size_t tip = (start + k) % left_.size();
      if (area_at(tip) > 0 && is_free(tip)) return tip;
    }
    return start;
  }

  /// Whether no corner lies in the triangle at `tip`. Corners at the place of the triangle's own do not
  /// count: outlines with holes pass them twice.
  bool is_free(std::size_t tip) const {
    const Point& a = points_[before(tip)];
    const Point& b = points_[left_[tip]];
    const Point& c = points_[after(tip)];
    return std::ranges::none_of(reflex_, [&](std::uint32_t corner) {
      const Point& p = points_[corner];
      if (p == a || p == b || p == c) return false;
      return signed_area(a, b, p) >= 0 && signed_area(b, c, p) >= 0 && signed_area(c, a, p) >= 0;
    });
  }

  std::vector<Point> points_;
  std::vector<std::uint32_t> left_;    // corners that are not cut off
  std::vector<std::uint32_t> reflex_;  // those of the whole polygon: only they can lie in an ear
};

std::vector<Triangle> split_quadrilateral(std::span<const Float3> p) {
  const std::array<std::array<Triangle, 2>, 2> ways{{{{{0, 1, 2}, {0, 2, 3}}}, {{{0, 1, 3}, {1, 2, 3}}}}};
  const auto faces_both_sides = [&](const std::array<Triangle, 2>& way) {
    std::array<std::array<double, 3>, 2> normals;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::array<Float3, 3> corners{p[way[i][0]], p[way[i][1]], p[way[i][2]]};
      normals[i] = polygon_normal(corners);
    }
    return normals[0][0] * normals[1][0] + normals[0][1] * normals[1][1] + normals[0][2] * normals[1][2] < 0;
  };
  std::size_t way = squared_distance(p[0], p[2]) < squared_distance(p[1], p[3]) ? 0 : 1;
  if (faces_both_sides(ways[way]) && !faces_both_sides(ways[1 - way])) way = 1 - way;
  return {ways[way].begin(), ways[way].end()};
}

}  // namespace

std::array<double, 3> polygon_normal(std::span<const Float3> corners) {
  std::array<double, 3> normal{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    // Relative to a corner, which keeps small polygons far from the origin precise.
    std::array<double, 3> a, b;
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = double{corners[i][k]} - corners[0][k];
      b[k] = double{corners[(i + 1) % corners.size()][k]} - corners[0][k];
    }
    for (std::size_t k = 0; k < 3; ++k)
      normal[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
  }
  return normal;
}

std::vector<Triangle> split_polygon(std::span<const Float3> corners) {
  if (corners.size() == 3) return {{0, 1, 2}};
  if (corners.size() == 4) return split_quadrilateral(corners);
  return EarCutter(projected(corners)).cut();
}

}  // namespace tessera::program
