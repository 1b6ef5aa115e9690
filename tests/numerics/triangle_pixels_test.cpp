// Coverage of single triangles against the fill rule in 128-bit integers. The oracle starts from the float
// vertices, snaps them by exact division, and shares no arithmetic with the engine. No tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "tests/numerics/case_renderer.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::triangle_pixels_test {
namespace {

// Each triangle has its own viewport in a large buffer, so that tile borders cross each one at a different
// place.
constexpr int kView = 32;
constexpr int kPitch = 37;
constexpr int kRow = 27;
constexpr int kBuffer = kRow * kPitch;
constexpr int kBatch = kRow * kRow;

__extension__ using Wide = __int128;

/// Granularity of all vertex coordinates: floats hold its multiples exactly.
constexpr double kUnit = 0x1p-30;
float drawn(double value) { return static_cast<float>(std::nearbyint(value / kUnit) * kUnit); }
Wide units(float value) { return static_cast<Wide>(double{value} / kUnit); }

Wide floor_of(Wide numerator, Wide denominator) {
  return numerator / denominator - (numerator % denominator != 0 && (numerator < 0) != (denominator < 0));
}

/// A vertex as drawn; z is 0.
struct Corner {
  float x, y, w;
  /// The nearest 1/256 pixel from the viewport's centre; halves go up and to the right. The result is unique:
  /// a quotient of floats is either a half or at least 2^-26 away from one, as its denominator has 24 bits,
  /// and doubles below 2^22 are off by at most 2^-30 after two roundings.
  std::array<Wide, 2> snapped() const {
    const auto snap = [this](float c) {
      return floor_of(2 * 256 * (kView / 2) * units(c) + units(w), 2 * units(w));
    };
    return {snap(x), snap(y)};
  }
};

/// Calls pixel(i, j, covered, on_edge), rows from the bottom. A centre on an edge counts as moved by (e, e^2)
/// to the right and down, e infinitely small.
template <class Pixel>
void for_each_pixel(const std::array<Corner, 3>& corners, const Pixel& pixel) {
  const std::array<Wide, 2> v[3] = {corners[0].snapped(), corners[1].snapped(), corners[2].snapped()};
  const Wide area = (v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[1][1] - v[0][1]) * (v[2][0] - v[0][0]);
  const int sign = area < 0 ? -1 : 1;
  Wide dx[3], dy[3], row[3];  // edge function, positive inside
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<Wide, 2>&a = v[k], &b = v[(k + 1) % 3];
    dx[k] = sign * (a[1] - b[1]);
    dy[k] = sign * (b[0] - a[0]);
    row[k] = dx[k] * (128 - 128 * kView - a[0]) + dy[k] * (128 - 128 * kView - a[1]);
  }
  for (int j = 0; j < kView; ++j) {
    Wide side[3] = {row[0], row[1], row[2]};
    for (int i = 0; i < kView; ++i) {
      bool covered = area != 0;
      bool on_edge = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const bool owns_edge = dx[k] > 0 || (dx[k] == 0 && dy[k] < 0);
        covered &= side[k] > 0 || (side[k] == 0 && owns_edge);
        on_edge |= side[k] == 0;
        side[k] += 256 * dx[k];
      }
      pixel(i, j, covered, on_edge);
    }
    for (std::size_t k = 0; k < 3; ++k) row[k] += 256 * dy[k];
  }
}

// Triangles of all shapes, up to the guard band: vertices on the snapping grid, halfway between grid points
// if `with_halves`, and, with varying w, anywhere.
std::array<Corner, 3> random_corners(RandomTriangles& source, bool with_halves) {
  const Triangle shape = source.next();
  const bool perspective = source.between(0, 1) != 0;
  const bool halves = source.between(0, 1) != 0 && with_halves;
  std::array<Corner, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto centered = [&](std::int32_t c) {
      return (std::clamp(c - 128 * kView, -16382 * 256, 16382 * 256) +
              (halves ? 0.5 * source.between(0, 1) : 0)) /
             (128.0 * kView);
    };
    const double w = perspective ? drawn(std::exp2(12 * source.unit() - 6)) : 1;
    corners[k] = {drawn(centered(shape[k].x) * w), drawn(centered(shape[k].y) * w), static_cast<float>(w)};
  }
  return corners;
}

CaseDraw draw_of(const std::array<Corner, 3>& corners, int place) {
  CaseDraw draw{.color = {0, 0, 1 / 255.0f, 1},
                .add = true,
                .viewport = Rect{place % kRow * kPitch, place / kRow * kPitch, kView, kView}};
  draw.positions.reserve(4 * corners.size());
  for (const Corner& c : corners) draw.positions.insert(draw.positions.end(), {c.x, c.y, 0, c.w});
  return draw;
}

std::string text(const std::array<Corner, 3>& corners) {
  std::ostringstream out;
  out << std::hexfloat;
  for (const Corner& c : corners) out << "(" << c.x << " " << c.y << " 0 " << c.w << ") ";
  return out.str();
}

// OpenGL leaves open how halves snap and which triangle owns a centre on an edge. So Mesa gets no halves, and
// its pixels on edges are not compared.
TEST(TrianglePixels, MatchTheExactRule) {
  expect_figure("random triangles by the exact rule: wrong", 0, "pixels",
                [](const MakeRenderer& make, bool is_tessera) {
                  const std::unique_ptr<CaseRenderer> renderer = make({.width = kBuffer, .height = kBuffer});
                  RandomTriangles source(1, kView);
                  const int batches = is_tessera && long_tests() ? (1000000 + kBatch - 1) / kBatch : 20;
                  long double wrong = 0;
                  long double covered_pixels = 0;
                  for (int batch = 0; batch < batches; ++batch) {
                    std::vector<std::array<Corner, 3>> triangles;
                    std::vector<CaseDraw> draws;
                    for (int k = 0; k < kBatch; ++k) {
                      triangles.push_back(random_corners(source, is_tessera));
                      draws.push_back(draw_of(triangles.back(), k));
                    }
                    const std::vector<int> counts = renderer->count(draws);
                    for (int k = 0; k < kBatch; ++k) {
                      const std::array<Corner, 3>& corners = triangles[static_cast<std::size_t>(k)];
                      long double wrong_here = 0;
                      for_each_pixel(corners, [&](int i, int j, bool covered, bool on_edge) {
                        const int x = k % kRow * kPitch + i;
                        const int y = kBuffer - 1 - (k / kRow * kPitch + j);
                        const int count = counts[static_cast<std::size_t>(y * kBuffer + x)];
                        covered_pixels += covered;
                        if (count == (covered ? 1 : 0) || (!is_tessera && on_edge)) return;
                        if (is_tessera && wrong_here++ == 0)
                          ADD_FAILURE() << "batch " << batch << ", triangle " << k << " " << text(corners)
                                        << ": pixel (" << i << ", " << j << ") of its viewport is covered "
                                        << count << " times";
                        ++wrong;
                      });
                    }
                  }
                  EXPECT_GT(covered_pixels, 100.0L * kBatch * batches);
                  return wrong;
                });
}

}  // namespace
}  // namespace tessera::test::triangle_pixels_test
