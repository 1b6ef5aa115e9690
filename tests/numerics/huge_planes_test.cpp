// Planes whose distance from the eye vanishes next to the coordinates of their vertices: a double cannot hold
// 10^30 and 1 in one sum. The oracle uses the plane's own coefficients, which have few digits, in whole
// numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/engine/frame/api_support.h"
#include "tests/numerics/bounds.h"
#include "tests/numerics/plane_mesh.h"
#include "tests/numerics/snapped_folds.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::huge_planes_test {
namespace {

constexpr int kSide = 64;

/// Corners around the origin of (u, v): each u is 2^size times 1 to 1.5, each v 2^size_v; as floats.
struct Corners {
  std::array<std::array<float, 2>, 4> at;
  Corners(MeshRandom& random, int size, int size_v) {
    const auto u = [&](int sign) {
      return static_cast<float>(std::ldexp(sign * (1 + 0.5 * random.unit()), size));
    };
    const auto v = [&](int sign) {
      return static_cast<float>(std::ldexp(sign * (1 + 0.5 * random.unit()), size_v));
    };
    at = {{{u(-1), v(-1)}, {u(1), v(-1)}, {u(1), v(1)}, {u(-1), v(1)}}};
  }
};

// Maps (u, v, 0, 1) to the plane's point in clip space, scaled by 2^exponent.
Matrix matrix_of(const ClipPlane& plane, int exponent) {
  Matrix m;
  const std::int64_t ClipPoint::*const rows[] = {&ClipPoint::x, &ClipPoint::y, &ClipPoint::z, &ClipPoint::w};
  for (std::size_t r = 0; r < 4; ++r) {
    const double columns[] = {static_cast<double>(plane.to_u.*rows[r]),
                              static_cast<double>(plane.to_v.*rows[r]), 0,
                              static_cast<double>(plane.origin.*rows[r])};
    for (std::size_t c = 0; c < 4; ++c) m.m[4 * r + c] = std::ldexp(columns[c], exponent);
  }
  return m;
}

// Largest exponent in the oracle; beyond it only the horizon is visible.
constexpr int kMaxOracleExponent = 38;

void expect_planes(const std::string& what, bool reversed) {
  expect_coverage(
      what, {.width = kSide, .height = kSide, .depth = DepthFormat::float32, .reversed = reversed},
      [reversed](const Count& count, bool is_tessera) {
        for (int n = 0; n < (is_tessera && long_tests() ? 100000 : 3000); ++n) {
          MeshRandom random(n);
          ClipPlane plane = random_plane(random);
          // Some planes run along the near plane, so that distant points are as close to it as the visible
          // ones.
          const int to_near = reversed ? 1 : -1;
          if (n % 3 == 0) plane.to_u.z = to_near * plane.to_u.w;
          if (n % 6 == 0) plane.to_v.z = to_near * plane.to_v.w;
          const SquareViewport view{0, 0, kSide};
          const std::optional<VisiblePlane> visible = plane.visible(view);
          if (!visible) continue;
          const int size = random.between(10, 110);
          const int exponent =
              is_tessera ? random.one_of({0, 0, random.between(-800, 1000 - size), 970 - size}) : 0;
          const int size_v = random.coin() ? size : random.between(3, size);
          const Corners corners(random, size, size_v);
          CountedMesh mesh;
          for (const auto& [u, v] : corners.at) mesh.add_vertex(double{u}, double{v}, 0, 1);
          const bool is_fan = random.coin();
          if (is_fan) {
            // Around a random vertex; there two edges may be closer to each other in the window than snapping
            // moves them.
            const int middle = random.between(-4, size - 1);
            const double u = std::ldexp(random.unit() - 0.5, middle);
            const double v = std::ldexp(random.unit() - 0.5, std::min(middle, size_v));
            mesh.add_vertex(u, v, 0, 1);
            for (const std::uint32_t k : {0, 1, 2, 3}) mesh.add_triangle(4, k, (k + 1) % 4);
          } else {
            const std::uint32_t first = random.coin() ? 0 : 1;
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first, first + 2, (first + 3) % 4);
          }
          mesh.shuffle(random);
          CaseDraw draw = counting(mesh);
          draw.transform = matrix_of(plane, exponent);
          count(
              {draw},
              "plane " + std::to_string(n) + " of 2^" + std::to_string(size) + " times 2^" +
                  std::to_string(exponent),
              {.pixels = covers_of(
                   plane.region(*visible, std::int64_t{1} << std::min(size_v, kMaxOracleExponent), reversed),
                   kSide, kSide, view),
               .overlaps = [&] { return snapping_folds(mesh, view, reversed, *draw.transform); },
               .folds_along_cuts = true});
        }
      });
}

TEST(HugePlanes, CoverThePixelsOfTheExactPlane) {
  expect_planes("planes of 2^10 to 2^110, offsets of one digit", false);
  expect_planes("planes of 2^10 to 2^110, offsets of one digit, reversed depth", true);
}

// The visible part is so close to the origin of (u, v), relative to the vertices, that it has the colour of
// the origin.
TEST(HugePlanes, HaveTheColorAtTheOrigin) {
  Renderer renderer({.threads = 1});
  long double worst = 0;
  std::size_t seen_pixels = 0;
  for (int n = 0; n < (long_tests() ? 100000 : 4000); ++n) {
    MeshRandom random(n);
    const ClipPlane plane = random_plane(random);
    const SquareViewport view{0, 0, kSide};
    const std::optional<VisiblePlane> visible = plane.visible(view);
    if (!visible) continue;
    const int size = random.between(40, 110);
    const Corners corners(random, size, size);
    std::vector<float> positions, colors;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t k = 0; k < 3; ++k) {
      // A triangle that contains the origin: two corners, and a third opposite to their midpoint.
      const float u = k < 2 ? corners.at[k][0] : -(corners.at[0][0] + corners.at[1][0]) / 2;
      const float v = k < 2 ? corners.at[k][1] : -(corners.at[0][1] + corners.at[1][1]) / 2;
      positions.insert(positions.end(), {u, v, 0, 1});
      for (int c = 0; c < 3; ++c) colors.push_back(static_cast<float>(random.between(0, 255)) / 255);
      colors.push_back(1);
    }
    FrameBuffer buffer({.width = kSide, .height = kSide, .depth = DepthFormat::none, .stencil_bits = 0});
    Frame frame(buffer);
    frame.clear({.color = Color{0, 0, 0, 1}});
    DrawState state;
    state.lighting = false;
    state.transform = matrix_of(plane, 0);
    frame.draw({.positions = positions, .position_components = 4, .colors = colors}, state);
    renderer.finish(frame);
    // At the origin the weights of the vertices are 1/4, 1/4 and 1/2.
    const std::vector<std::uint32_t> words = packed_colors(buffer);
    // Visible part of a far larger triangle without the horizon.
    const ExactRegion region = plane.region(*visible, 1 << 12);
    for (std::size_t i = 0; i < words.size(); ++i) {
      const auto [x, y] = center_of(static_cast<int>(i % kSide), static_cast<int>(i / kSide), kSide, view);
      if (region.side(x, y) != ExactRegion::Side::in) continue;
      ++seen_pixels;
      for (std::size_t c = 0; c < 3; ++c) {
        const long double expected = 255 * (0.25L * colors[c] + 0.25L * colors[4 + c] + 0.5L * colors[8 + c]);
        update_worst(worst, std::abs(static_cast<long double>(words[i] >> (16 - 8 * c) & 255) - expected));
      }
    }
  }
  EXPECT_GT(seen_pixels, 100000u);
  // Half a level of storing, and 2^-28 of the vertices' differences for the distance from the origin.
  expect_within("colours of triangles of 2^40 to 2^110", worst, 0.501L, "levels of 255");
}

// An outline matches that of a smaller plane whose far edges are at the horizon, too.
TEST(HugePlanes, OutlinesDoNotDependOnTheSize) {
  Renderer renderer({.threads = 1});
  const auto outline = [&](double roll, double yaw, int size) {
    FrameBuffer buffer({.width = kSide, .height = kSide, .depth = DepthFormat::none, .stencil_bits = 0});
    Frame frame(buffer);
    frame.clear({.color = Color{0, 0, 0, 1}});
    std::vector<float> positions;
    for (const auto& [x, z] : {std::pair{-1, -1}, {-1, 1}, {1, 1}, {1, -1}})
      positions.insert(positions.end(),
                       {std::ldexp(static_cast<float>(x), size), 0, std::ldexp(static_cast<float>(z), size)});
    DrawState state;
    state.lighting = false;
    state.front_mode = state.back_mode = PolygonMode::line;
    state.transform = perspective(90, 1, 2, std::numeric_limits<double>::infinity()) * rotate(roll, 0, 0, 1) *
                      rotate(yaw, 0, 1, 0) * translate(0, -1, 0);
    frame.draw({.primitive = Primitive::quads, .positions = positions}, state);
    renderer.finish(frame);
    return packed_colors(buffer);
  };
  for (const double roll : {0.0, 30.0, -71.0})
    for (const double yaw : {0.0, 20.0, 45.0}) {
      const std::vector<std::uint32_t> small = outline(roll, yaw, 20);
      // The horizon and the near edge.
      EXPECT_GT(std::count_if(small.begin(), small.end(), [](std::uint32_t word) { return word != 0; }),
                3 * kSide / 2);
      for (const int size : {40, 50, 60, 80, 100})
        EXPECT_EQ(outline(roll, yaw, size), small) << "roll " << roll << ", yaw " << yaw << ", 2^" << size;
    }
}

}  // namespace
}  // namespace tessera::test::huge_planes_test
