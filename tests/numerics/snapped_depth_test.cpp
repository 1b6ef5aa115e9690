// Depth belongs to the snapped triangle (vertices at 1/256 pixel), as in Direct3D 11. This test bounds its
// distance from the plane of the unsnapped triangle.
//
// Let Z be the unsnapped plane with gradient g, and let vertex i move by d_i when it snaps. A point p of the
// snapped triangle has barycentric weights b_i >= 0 with p = sum b_i (v_i + d_i). The snapped depth at p is
// sum b_i z_i, and Z(p) = sum b_i (z_i + g.d_i). They differ by at most max |g.d_i|. Each coordinate moves by
// at most 1/512 pixel, so the bound is (|dz/dx| + |dz/dy|) / 512.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/case_renderer.h"
#include "tests/numerics/depth_formats.h"
#include "tests/numerics/tilted_triangles.h"
#include "tests/numerics/window_triangle.h"

namespace tessera::test::snapped_depth_test {
namespace {

constexpr int kSide = 256;
constexpr std::size_t kTriangles = 200;

// Snapping moves a coordinate by (1/2 + 2^-28) of 1/256 pixel at most.
constexpr double kLargestMove = (1 + 0x1p-27) / 512;

/// A vertex before it is snapped: pixels from the upper left corner, y down, and its depth.
struct UnsnappedVertex {
  double x, y;
  double depth;
};

/// The plane through the three unsnapped vertices of a triangle.
class UnsnappedPlane {
 public:
  explicit UnsnappedPlane(const std::array<UnsnappedVertex, 3>& v) : origin_(v[0]) {
    const double x1 = v[1].x - v[0].x;
    const double y1 = v[1].y - v[0].y;
    const double x2 = v[2].x - v[0].x;
    const double y2 = v[2].y - v[0].y;
    const double z1 = v[1].depth - v[0].depth;
    const double z2 = v[2].depth - v[0].depth;
    doubled_area_ = x1 * y2 - x2 * y1;
    dz_dx_ = (z1 * y2 - z2 * y1) / doubled_area_;
    dz_dy_ = (x1 * z2 - x2 * z1) / doubled_area_;
  }
  double doubled_area() const { return doubled_area_; }
  double at(double x, double y) const {
    return origin_.depth + (x - origin_.x) * dz_dx_ + (y - origin_.y) * dz_dy_;
  }
  double largest_change() const { return (std::abs(dz_dx_) + std::abs(dz_dy_)) * kLargestMove; }

 private:
  UnsnappedVertex origin_;
  double doubled_area_;
  double dz_dx_, dz_dy_;
};

/// Adds a random triangle of at least half a pixel to the draw and returns its plane. Its colour is its
/// number.
UnsnappedPlane add_random_triangle(CaseDraw& draw, Rng& rng, std::size_t number) {
  for (;;) {
    const bool is_small = rng.maybe();
    const bool has_perspective = rng.maybe();
    const double left = (kSide + 32) * rng.unit() - 16, top = (kSide + 32) * rng.unit() - 16;
    const double size = is_small ? 16 : kSide;
    std::vector<float> positions;
    std::array<UnsnappedVertex, 3> vertices;
    for (UnsnappedVertex& v : vertices) {
      const double w = has_perspective ? static_cast<float>(std::exp2(6 * rng.unit() - 3)) : 1;
      const double x = left + size * (rng.unit() - 0.5), y = top + size * (rng.unit() - 0.5);
      const float clip_x = static_cast<float>(w * (x / (kSide / 2) - 1));
      const float clip_y = static_cast<float>(w * (1 - y / (kSide / 2)));
      const float clip_z = static_cast<float>(w * (0.125 + 0.75 * rng.unit()));
      v = {(clip_x / w + 1) * (kSide / 2), (1 - clip_y / w) * (kSide / 2), clip_z / w};
      positions.insert(positions.end(), {clip_x, clip_y, clip_z, static_cast<float>(w)});
    }
    const UnsnappedPlane plane(vertices);
    if (!(std::abs(plane.doubled_area()) >= 1)) continue;
    draw.positions.insert(draw.positions.end(), positions.begin(), positions.end());
    for (int k = 0; k < 3; ++k) {
      for (const std::size_t shift : {0, 8, 16})
        draw.colors.push_back(static_cast<float>((number + 1) >> shift & 255) / 255);
      draw.colors.push_back(1);
    }
    return plane;
  }
}

/// Rounding of a stored depth, from README.md: half a level and 2^-20 of the vertices, and the plane's
/// levels; for float32 one rounding each of the vertices and of the plane.
double rounding_budget(const DepthCase& depth, double exact) {
  if (depth.is_float()) return 0x1p-23 * exact + 0x1p-49;
  const double plane_levels = depth.bits == 32 ? 4 : 1;
  return (plane_levels + 0.5 + 0x1p-20) / static_cast<double>(depth.levels());
}

double depth_of(const DepthCase& depth, std::uint32_t stored) {
  return depth.is_float() ? double{float_of(stored)} : stored / static_cast<double>(depth.levels());
}

TEST(SnappedDepth, IsWithinTheMoveOfTheVerticesFromTheUnsnappedPlane) {
  for (const DepthCase& depth : {kUnorm24, kUnorm32, kFloat32})
    expect_figure("depth, " + std::string(depth.name) + ", from the unsnapped plane", 1, "of its bound",
                  [&](const MakeRenderer& make, bool is_tessera) {
                    const auto renderer =
                        make({.width = kSide, .height = kSide, .depth = depth.format, .reversed = true});
                    Rng rng(81);
                    long double worst = 0;
                    std::size_t visible = 0;
                    for (int round = 0; round < 20 * rounds_of(is_tessera); ++round) {
                      CaseDraw draw{.test_depth = true, .depth_func = Compare::always};
                      std::vector<UnsnappedPlane> planes;
                      for (std::size_t n = 0; n < kTriangles; ++n)
                        planes.push_back(add_random_triangle(draw, rng, n));
                      const CasePicture& picture = renderer->draw({draw});
                      for (std::size_t i = 0; i < picture.depth.size(); ++i) {
                        const std::size_t number = number_of(picture.colors[i]);
                        if (number >= planes.size()) continue;
                        const UnsnappedPlane& plane = planes[number];
                        const double exact = plane.at(static_cast<double>(i % kSide) + 0.5,
                                                      static_cast<double>(i / kSide) + 0.5);
                        const double bound = plane.largest_change() + rounding_budget(depth, exact);
                        update_worst(worst, std::abs(depth_of(depth, picture.depth[i]) - exact) / bound);
                        ++visible;
                      }
                    }
                    EXPECT_GT(visible, 500000u);
                    // The bound is nearly reached, so half of it would be too small.
                    EXPECT_TRUE(!is_tessera || worst > 0.9L) << worst;
                    return worst;
                  });
}

}  // namespace
}  // namespace tessera::test::snapped_depth_test
