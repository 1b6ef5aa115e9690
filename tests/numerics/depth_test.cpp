// Surfaces separated by the smallest step of a depth format: one level, one float, one unit of polygon
// offset. The nearer one shows at every pixel in either drawing order. No tolerance: figures are numbers of
// wrong pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/case_renderer.h"
#include "tests/numerics/depth_formats.h"
#include "tests/numerics/window_triangle.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::depth_test {
namespace {

constexpr Color kNear{0, 1, 0, 1}, kFar{1, 0, 0, 1}, kBehind{0, 0, 1, 1};

struct Window {
  int width, height;
};
constexpr Window kWindows[] = {{64, 64}, {16384, 8}, {8, 16384}};

// Large and small triangles, up to the far corner of the window. Depths are in units that the transform maps
// to clip space.
CaseDraw mesh_in(Rng& rng, const Window& window, const std::function<double()>& depth) {
  CaseDraw draw{.test_depth = true};
  for (const WindowShape shape : kWindowShapes)
    for (int n = 0; n < 8; ++n)
      for (const GridPoint& p : random_triangle(rng, shape, window.width, window.height).at)
        for (const double c : {clip_x(p.x, window.width), clip_y(p.y, window.height), depth(), 1.0})
          draw.positions.push_back(static_cast<float>(c));
  return draw;
}

// Maps depth = `scale` z + `start`, within 0 .. 1, to clip space.
Matrix depth_transform(double scale, double start) {
  return {.m = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2 * scale, 2 * start - 1, 0, 0, 0, 1}};
}

/// Depth functions: for the nearer surface drawn after the farther one, and for all other draws.
struct Tests {
  Compare nearer = Compare::less;
  Compare others = Compare::less;
};

// Pixels covered by the mesh that do not show the nearer surface.
long double wrong_pixels(CaseRenderer& renderer, CaseDraw draw, const Matrix& nearer, const Matrix& farther,
                         const Tests& tests = {}) {
  const auto colored = [&](const Color& color, const Matrix& transform, Compare func) {
    draw.color = color;
    draw.transform = transform;
    draw.depth_func = func;
    return draw;
  };
  CaseDraw behind = colored(kBehind, nearer, Compare::always);
  behind.test_depth = false;
  long double wrong = 0;
  long double visible_pixels = 0;
  for (const bool near_first : {false, true}) {
    const CaseDraw first =
        near_first ? colored(kNear, nearer, tests.others) : colored(kFar, farther, tests.others);
    const CaseDraw second =
        near_first ? colored(kFar, farther, tests.others) : colored(kNear, nearer, tests.nearer);
    for (const std::array<float, 3>& color : renderer.draw({behind, first, second}).colors) {
      wrong += color[0] > 0 || color[2] > 0;
      visible_pixels += color[0] > 0 || color[1] > 0 || color[2] > 0;
    }
  }
  EXPECT_GT(visible_pixels, 100);
  return wrong;
}

// A depth that stores as this number on every path: the middle of the level.
double depth_of(const DepthCase& depth, std::int64_t stored) {
  return depth.is_float() ? float_of(static_cast<std::uint32_t>(stored))
                          : static_cast<double>(stored) / static_cast<double>(depth.levels());
}

/// Number of random cases for a window; `large_window` for windows other than 64 pixels wide.
int cases_of(const Window& window, bool is_tessera, int large_window) {
  if (is_tessera && long_tests()) return 500;
  return window.width == 64 ? 40 : large_window;
}

TEST(DepthSeparation, ParallelSurfacesOneStepApartStayApart) {
  for (const DepthCase& depth : kDepthCases)
    expect_figure("depth, " + std::string(depth.name) + ", one step apart, facing the viewer", 0, "pixels",
                  [&](const MakeRenderer& make, bool is_tessera) {
                    Rng rng(11);
                    long double wrong = 0;
                    // From 2^-31 on, doubles in -1 .. 1 hold 2 z - 1 exactly for a float z.
                    // The far end itself never passes `less` against the clear value.
                    const std::int64_t first = depth.is_float() ? 0x30000000 : 0;
                    const std::int64_t last = depth.is_float() ? 0x3f800000 : depth.levels();
                    for (const Window& window : kWindows) {
                      const auto renderer =
                          make({.width = window.width, .height = window.height, .depth = depth.format});
                      std::vector<std::int64_t> nearer{first, first + 1, (first + last) / 2, last - 2};
                      for (int n = 0; n < cases_of(window, is_tessera, 2); ++n)
                        nearer.push_back(rng.between(first, last - 2));
                      for (const std::int64_t stored : nearer)
                        wrong += wrong_pixels(*renderer, mesh_in(rng, window, [] { return 0.0; }),
                                              depth_transform(0, depth_of(depth, stored)),
                                              depth_transform(0, depth_of(depth, stored + 1)));
                    }
                    return wrong;
                  });
}

// Reversed depth is z itself: adjacent floats stay apart down to the smallest float.
TEST(DepthSeparation, ParallelSurfacesOneFloatApartStayApartInReversedDepth) {
  expect_figure("depth, floats, reversed, one step apart, facing the viewer", 0, "pixels",
                [&](const MakeRenderer& make, bool is_tessera) {
                  Rng rng(15);
                  long double wrong = 0;
                  for (const Window& window : kWindows) {
                    const auto renderer = make({.width = window.width,
                                                .height = window.height,
                                                .depth = DepthFormat::float32,
                                                .reversed = true,
                                                .cleared_depth = 0});
                    const auto flat = [](std::int64_t word) {
                      return Matrix{.m = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0,
                                          float_of(static_cast<std::uint32_t>(word)), 0, 0, 0, 1}};
                    };
                    for (int exponent = 0; exponent < 127;
                         exponent += window.width == 64 ? 1 : 21) {  // from below 2^-126 up to 1
                      const std::int64_t first = std::int64_t{exponent} << 23, last = first + 0x7fffff;
                      std::vector<std::int64_t> farther{std::max(first, std::int64_t{1}), last};
                      for (int n = 0; n < (is_tessera && long_tests() ? 50 : 1); ++n)
                        farther.push_back(rng.between(first + 1, last - 1));
                      for (const std::int64_t word : farther)
                        wrong +=
                            wrong_pixels(*renderer, mesh_in(rng, window, [] { return 0.0; }), flat(word + 1),
                                         flat(word), {Compare::greater, Compare::greater});
                    }
                  }
                  return wrong;
                });
}

// The same tilted triangles moved by one level, with vertices between two levels or in the middle of one.
TEST(DepthSeparation, TiltedSurfacesOneLevelApartStayApart) {
  for (const bool on_levels : {false, true})
    for (const DepthCase& depth : kUnorms)
      expect_figure("depth, " + std::string(depth.name) + ", one step apart, tilted, vertices " +
                        (on_levels ? "on levels" : "anywhere"),
                    0, "pixels", [&](const MakeRenderer& make, bool is_tessera) {
                      Rng rng(12);
                      long double wrong = 0;
                      const double level = 1 / static_cast<double>(depth.levels());
                      for (const Window& window : kWindows) {
                        const auto renderer =
                            make({.width = window.width, .height = window.height, .depth = depth.format});
                        for (int n = 0; n < cases_of(window, is_tessera, 4); ++n) {
                          const std::int64_t most = std::min<std::int64_t>(depth.levels(), (1 << 24) - 1);
                          const std::int64_t spread = std::int64_t{1} << rng.between(0, 23);
                          const std::int64_t middle = rng.between(0, most);
                          const CaseDraw mesh = mesh_in(rng, window, [&] {
                            return static_cast<double>(
                                std::clamp<std::int64_t>(middle + rng.between(-spread, spread), 2, most - 2));
                          });
                          const double scale =
                              level * (depth.bits == 32 ? 256 : 1) * (on_levels ? 1 : 0.99 * rng.unit());
                          wrong += wrong_pixels(*renderer, mesh, depth_transform(scale, 0),
                                                depth_transform(scale, level));
                        }
                      }
                      return wrong;
                    });
}

// Between the vertices the depth is rounded to float, so a surface one float nearer at the vertices may be
// equally near, but is never farther. (The depth gradients are identical for both, and every operation up to
// a pixel's depth is monotonic.) A surface two floats nearer is strictly nearer.
TEST(DepthSeparation, TiltedSurfacesOneFloatNearerNeverFallBehindTwoFloatsAreNearer) {
  for (const int floats : {1, 2})
    expect_figure(std::string("depth, floats, tilted, ") +
                      (floats == 1 ? "one step apart, tested by lequal" : "two steps apart"),
                  0, "pixels", [&](const MakeRenderer& make, bool is_tessera) {
                    Rng rng(13);
                    long double wrong = 0;
                    for (const Window& window : kWindows) {
                      const auto renderer = make(
                          {.width = window.width, .height = window.height, .depth = DepthFormat::float32});
                      for (int n = 0; n < cases_of(window, is_tessera, 4); ++n) {
                        // Depths in units of 2^-24: a step is the smallest difference at 1/2 and above.
                        const std::int64_t spread = std::int64_t{1} << rng.between(0, 23);
                        const std::int64_t middle = rng.between(0, 1 << 24);
                        const CaseDraw mesh = mesh_in(rng, window, [&] {
                          return static_cast<double>(std::clamp<std::int64_t>(
                              middle + rng.between(-spread, spread), 1 << 10, (1 << 24) - 3));
                        });
                        wrong += wrong_pixels(*renderer, mesh, depth_transform(0x1p-24, 0),
                                              depth_transform(0x1p-24, floats * 0x1p-24),
                                              {floats == 1 ? Compare::lequal : Compare::less, Compare::less});
                      }
                    }
                    return wrong;
                  });
}

// Pixels of a decal that are hidden by the plane it lies in. Adds the pixels of the decal on the plane to
// `visible_pixels`.
long double hidden_pixels(CaseRenderer& renderer, const CaseDraw& base, CaseDraw decal, const Matrix& plane,
                          const PolygonOffset& offset, long& visible_pixels) {
  CaseDraw below = base;
  below.color = kFar;
  decal.color = kNear;
  decal.test_depth = false;
  below.transform = decal.transform = plane;
  const std::vector<std::array<float, 3>> alone = renderer.draw({decal}).colors;
  const std::vector<std::array<float, 3>> covered = renderer.draw({below}).colors;
  decal.test_depth = true;
  decal.offset = offset;
  const std::vector<std::array<float, 3>>& both = renderer.draw({below, decal}).colors;
  long double hidden = 0;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    visible_pixels += alone[i][1] > 0 && covered[i][0] > 0;
    hidden += alone[i][1] > 0 && both[i][0] > 0;
  }
  return hidden;
}

// The same triangles again, and other triangles in the same plane. The latter snap to other positions, for
// which the slope term compensates, and their levels are rounded down from finer depths. On nearly level
// planes this may cost one unit.
TEST(DepthSeparation, OffsetByOneUnitSeparatesCoplanarSurfaces) {
  for (const bool same : {true, false})
    for (const DepthCase& depth : kDepthCases)
      expect_figure(
          "depth, " + std::string(depth.name) + ", offset by a " +
              (same ? "unit, the same triangles" : "slope and two units, another in the same plane"),
          0, "pixels", [&](const MakeRenderer& make, bool is_tessera) {
            Rng rng(14);
            long double hidden = 0;
            long visible_pixels = 0;
            const int size = 64;
            const auto renderer = make({.width = size, .height = size, .depth = depth.format});
            for (int n = 0; n < (is_tessera && long_tests() ? 3000 : 200); ++n) {
              const auto flat = [] { return 0.0; };
              const CaseDraw decal = mesh_in(rng, {size, size}, flat);
              CaseDraw base{.test_depth = true};
              for (const double c : {-1.5, -1.5, 4.5, -1.5, -1.5, 4.5}) {
                base.positions.push_back(static_cast<float>(c));
                if (base.positions.size() % 4 == 2) base.positions.insert(base.positions.end(), {0, 1});
              }
              // Depth is linear in x and y: within 0.1 .. 0.9 over the window and its surroundings.
              const double slope = n % 8 == 0 ? 0 : std::exp2(-24 * rng.unit()) * 0.05;
              const double turn = 6.28318530718 * rng.unit();
              Matrix plane = depth_transform(0, 0.5);
              plane.m[8] = slope * std::cos(turn);
              plane.m[9] = slope * std::sin(turn);
              // Steps per pixel: below one, the rounding to float between the vertices exceeds the slope.
              const double rounding = depth.is_float() ? std::abs(slope) / 32 * 0x1p24 : 1;
              if (same) hidden += hidden_pixels(*renderer, decal, decal, plane, {0, -1}, visible_pixels);
              else if (slope == 0 || rounding >= 1)
                hidden += hidden_pixels(*renderer, base, decal, plane, {-1, slope == 0 ? -1.0f : -2.0f},
                                        visible_pixels);
            }
            EXPECT_GT(visible_pixels, 10000);
            return hidden;
          });
}

}  // namespace
}  // namespace tessera::test::depth_test
