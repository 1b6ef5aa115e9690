#include "tests/numerics/snapped_folds.h"

#include <array>
#include <vector>

#include <gmpxx.h>

namespace tessera::test {
namespace {

constexpr int kGuardBand = 16383;  // pixels from the viewport's centre

using Point = std::array<mpq_class, 4>;

// Value of the plane's linear function. Zero coefficients are skipped for speed.
mpq_class value_at(const Point& p, const Point& plane) {
  mpq_class value = 0;
  for (std::size_t c = 0; c < 4; ++c)
    if (plane[c] != 0) value += plane[c] * p[c];
  return value;
}

// Each plane is given by the coefficients of x, y, z and w; its inside is >= 0.
std::vector<Point> clip(std::vector<Point> polygon, const std::vector<Point>& planes) {
  for (const Point& plane : planes) {
    std::vector<Point> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point& a = polygon[i];
      const Point& b = polygon[(i + 1) % polygon.size()];
      const mpq_class da = value_at(a, plane);
      const mpq_class db = value_at(b, plane);
      if (da >= 0) kept.push_back(a);
      if ((da < 0) == (db < 0)) continue;
      const mpq_class along = da / (da - db);
      Point cut;
      for (std::size_t c = 0; c < 4; ++c) cut[c] = a[c] + along * (b[c] - a[c]);
      kept.push_back(cut);
    }
    polygon = std::move(kept);
  }
  return polygon;
}

// Rounds to the nearest 1/256 pixel, halves up.
std::int64_t snap(const mpq_class& coordinate, const mpq_class& w, const SquareViewport& view) {
  const mpq_class units = 128 * view.side * coordinate / w + mpq_class(1, 2);
  mpz_class floor;
  mpz_fdiv_q(floor.get_mpz_t(), units.get_num_mpz_t(), units.get_den_mpz_t());
  return floor.get_si();
}

int sign(std::int64_t value) { return (value > 0) - (value < 0); }

bool edges_cross(const std::vector<WindowPoint>& p) {
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 2; j < p.size(); ++j) {
      const WindowPoint& a = p[i];
      const WindowPoint& b = p[i + 1];
      const WindowPoint& c = p[j];
      const WindowPoint& d = p[(j + 1) % p.size()];
      if (sign(doubled_area(a, b, c)) * sign(doubled_area(a, b, d)) < 0 &&
          sign(doubled_area(c, d, a)) * sign(doubled_area(c, d, b)) < 0)
        return true;
    }
  return false;
}

bool folds(const std::array<Point, 3>& v, const std::vector<Point>& planes, const SquareViewport& view) {
  std::vector<WindowPoint> snapped;
  for (const Point& p : clip({v.begin(), v.end()}, planes))
    if (p[3] > 0) snapped.push_back({snap(p[0], p[3], view), snap(p[1], p[3], view)});
  std::int64_t area = 0;
  for (std::size_t i = 2; i < snapped.size(); ++i)
    area += doubled_area(snapped[0], snapped[i - 1], snapped[i]);
  const mpq_class turn = v[0][0] * (v[1][1] * v[2][3] - v[1][3] * v[2][1]) +
                         v[0][1] * (v[1][3] * v[2][0] - v[1][0] * v[2][3]) +
                         v[0][3] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
  const bool is_flipped = sign(area) * sgn(turn) < 0;
  const bool is_no_longer_flat = sgn(turn) == 0 && area != 0;
  return is_flipped || is_no_longer_flat || edges_cross(snapped);
}

}  // namespace

bool snapping_folds(const CountedMesh& mesh, const SquareViewport& view, bool reversed,
                    const Matrix& transform) {
  const mpq_class guard(2 * kGuardBand, view.side);
  const std::vector<Point> planes{reversed ? Point{0, 0, -1, 1} : Point{0, 0, 1, 1},
                                  reversed ? Point{0, 0, 1, 0} : Point{0, 0, -1, 1},
                                  {1, 0, 0, guard},
                                  {-1, 0, 0, guard},
                                  {0, 1, 0, guard},
                                  {0, -1, 0, guard}};
  std::vector<Point> positions;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 4) {
    Point position;
    Point carried;
    for (std::size_t c = 0; c < 4; ++c) position[c] = mesh.positions[i + c];
    for (std::size_t r = 0; r < 4; ++r)
      carried[r] = value_at(position, {transform.m[4 * r], transform.m[4 * r + 1], transform.m[4 * r + 2],
                                       transform.m[4 * r + 3]});
    positions.push_back(carried);
  }
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
    if (folds({positions[mesh.indices[t]], positions[mesh.indices[t + 1]], positions[mesh.indices[t + 2]]},
              planes, view))
      return true;
  return false;
}

}  // namespace tessera::test
