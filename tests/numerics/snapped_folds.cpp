#include "tests/numerics/snapped_folds.h"

#include <array>
#include <cmath>
#include <vector>

namespace tessera::test {
namespace {

constexpr long double kGuardBand = 16383;  // pixels from the viewport's centre

using Point = std::array<long double, 4>;

// By x, y, z and w times the plane's four numbers.
std::vector<Point> clip(std::vector<Point> polygon, const std::vector<Point>& planes) {
  for (const Point& plane : planes) {
    std::vector<Point> kept;
    const auto inside = [&plane](const Point& p) { return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3] * p[3]; };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const long double da = inside(a), db = inside(b);
      if (da >= 0) kept.push_back(a);
      if ((da < 0) == (db < 0)) continue;
      Point cut;
      for (std::size_t c = 0; c < 4; ++c) cut[c] = a[c] + da / (da - db) * (b[c] - a[c]);
      kept.push_back(cut);
    }
    polygon = std::move(kept);
  }
  return polygon;
}

int sign(std::int64_t value) { return (value > 0) - (value < 0); }

bool edges_cross(const std::vector<WindowPoint>& p) {
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 2; j < p.size(); ++j) {
      const WindowPoint &a = p[i], &b = p[i + 1], &c = p[j], &d = p[(j + 1) % p.size()];
      if (sign(doubled_area(a, b, c)) * sign(doubled_area(a, b, d)) < 0 && sign(doubled_area(c, d, a)) * sign(doubled_area(c, d, b)) < 0) return true;
    }
  return false;
}

bool folds(const std::array<Point, 3>& v, const std::vector<Point>& planes, const SquareView& view) {
  std::vector<WindowPoint> snapped;
  for (const Point& p : clip({v.begin(), v.end()}, planes)) {
    const auto snap = [&](long double c) { return static_cast<std::int64_t>(std::floor(128.0L * view.side * c / p[3] + 0.5L)); };
    if (p[3] > 0) snapped.push_back({snap(p[0]), snap(p[1])});
  }
  std::int64_t area = 0;
  for (std::size_t i = 2; i < snapped.size(); ++i) area += doubled_area(snapped[0], snapped[i - 1], snapped[i]);
  const long double turn = v[0][0] * (v[1][1] * v[2][3] - v[1][3] * v[2][1]) + v[0][1] * (v[1][3] * v[2][0] - v[1][0] * v[2][3]) + v[0][3] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
  return (turn == 0 ? area != 0 : static_cast<long double>(area) * turn < 0) || edges_cross(snapped);
}

}  // namespace

bool snapping_folds(const CountedMesh& mesh, const SquareView& view, bool reversed) {
  const long double guard = 2 * kGuardBand / view.side;
  const std::vector<Point> planes{reversed ? Point{0, 0, -1, 1} : Point{0, 0, 1, 1}, reversed ? Point{0, 0, 1, 0} : Point{0, 0, -1, 1}, {1, 0, 0, guard}, {-1, 0, 0, guard}, {0, 1, 0, guard}, {0, -1, 0, guard}};
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    std::array<Point, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 4; ++c) corners[k][c] = mesh.positions[4 * mesh.indices[t + k] + c];
    if (folds(corners, planes, view)) return true;
  }
  return false;
}

}  // namespace tessera::test
