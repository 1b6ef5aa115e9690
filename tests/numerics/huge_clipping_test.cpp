// Geometry that reaches to 10^30 on both sides of the eye is drawn at its exact place: ground planes under
// any camera, and edges that pass close by from very far to very far. The oracle casts a ray through each
// pixel in long double and intersects the plane by its own coefficients, which do not depend on its size.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/numerics/counted_mesh.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::huge_clipping_test {
namespace {

constexpr int kSide = 64;

// Expected coverage of the pixels. If moving a pixel by 1/256 pixel (snapping is half of that) changes the
// result, both results count as right.
template <class IsVisible>
std::vector<Cover> expected_covers(const IsVisible& is_visible) {
  std::vector<Cover> covers;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      int visible = 0;
      for (const auto& [dx, dy] : {std::pair{-1, -1}, {1, -1}, {-1, 1}, {1, 1}})
        visible +=
            is_visible((x + 0.5L + dx / 256.0L) * 2 / kSide - 1, 1 - (y + 0.5L + dy / 256.0L) * 2 / kSide)
                ? 1
                : 0;
      if (visible == 4) covers.push_back(Cover::once);
      else covers.push_back(visible == 0 ? Cover::never : Cover::at_most_once);
    }
  return covers;
}

void expect_ground_planes(const std::string& what, bool reversed) {
  expect_coverage(
      what, {.width = kSide, .height = kSide, .depth = DepthFormat::float32, .reversed = reversed},
      [reversed](const Count& count, bool is_tessera) {
        for (int n = 0; n < (is_tessera && long_tests() ? 100000 : 1000); ++n) {
          MeshRandom random(n);
          const double near = random.one_of({0.01, 0.5, 2.0});
          const double pitch = random.between(-60, 60);
          const double roll = random.one_of({0.0, 30.0, 117.0});
          const bool looks_ahead = n % 4 == 0;
          const Matrix eye = looks_ahead ? Matrix() : rotate(roll, 0, 0, 1) * rotate(pitch, 1, 0, 0);
          const int size = random.between(20, 100);
          CountedMesh mesh;
          for (const auto& [x, z] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
            const double far_x = std::ldexp(x * (1 + 0.5 * random.unit()), size);
            const double far_z = std::ldexp(z * (1 + 0.5 * random.unit()), size);
            mesh.add_vertex(far_x, -1, far_z, 1);
          }
          mesh.add_triangle(0, 1, 2);
          mesh.add_triangle(0, 2, 3);
          mesh.shuffle(random);
          CaseDraw draw = counting(mesh);
          draw.transform = perspective(90, 1, near, std::numeric_limits<double>::infinity(), reversed) * eye;
          // Clip coordinates of any scale denote the same points.
          const int scale = random.between(-8, 8) * 100;
          if (is_tessera)
            for (double& element : draw.transform->m) element = std::ldexp(element, scale);
          const auto is_visible = [&](long double x, long double y) {
            // In eye space, and how far down that is in the plane's space.
            const long double to[] = {x, y, -1};
            const long double down = -(eye.m[1] * to[0] + eye.m[5] * to[1] + eye.m[9] * to[2]);
            return down > 0 && 1 / down >= near;
          };
          // Slivers may also fold along the horizon.
          count({draw}, "plane " + std::to_string(n) + " scale " + std::to_string(scale),
                {.pixels = expected_covers(is_visible), .folds_along_cuts = true});
        }
      });
}

TEST(HugeClipping, GroundIsExactUnderAnyCamera) {
  expect_ground_planes("ground of 10^6 to 10^30", false);
  expect_ground_planes("ground of 10^6 to 10^30, reversed depth", true);
}

// Two triangles; the first covers everything left of a line through the middle of the window or close to it.
TEST(HugeClipping, EdgesAreExact) {
  expect_coverage(
      "edges 10^4 to 10^30 long", {.width = kSide, .height = kSide}, [](const Count& count, bool is_tessera) {
        for (int n = 0; n < (is_tessera && long_tests() ? 100000 : 2000); ++n) {
          MeshRandom random(n);
          // From one end through the middle to the other end, `apart` times as far away. The floats have few
          // bits, so the line is exact.
          const int size = random.between(14, 100);
          const int apart = random.between(0, 10);
          const double x = random.between(-15, 15), y = random.between(-15, 15);
          if (x == 0 && y == 0) continue;
          CountedMesh mesh;
          const std::uint32_t a = mesh.add_vertex(std::ldexp(x, size), std::ldexp(y, size));
          const std::uint32_t b = mesh.add_vertex(std::ldexp(-x, size - apart), std::ldexp(-y, size - apart));
          const std::uint32_t left = mesh.add_vertex(std::ldexp(-y, size), std::ldexp(x, size));
          const std::uint32_t right = mesh.add_vertex(std::ldexp(y, size), std::ldexp(-x, size));
          mesh.add_triangle(a, left, b);
          const bool both = random.coin();
          if (both) mesh.add_triangle(b, right, a);
          mesh.shuffle(random);
          count({counting(mesh)}, "edge " + std::to_string(n),
                {.pixels = expected_covers(
                     [&](long double px, long double py) { return both || x * py - y * px > 0; })});
        }
      });
}

}  // namespace
}  // namespace tessera::test::huge_clipping_test
