// Surfaces that are as near to each other as a depth format can tell: one level, one float, one unit of
// polygon offset apart. The nearer one shows at every pixel, whichever is drawn first. No tolerance: figures
// are numbers of wrong pixels.
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

namespace tessera::test {
namespace {

constexpr Color kNear{0, 1, 0, 1}, kFar{1, 0, 0, 1}, kBehind{0, 0, 1, 1};

struct Window {
  int width, height;
};
constexpr Window kWindows[] = {{64, 64}, {16384, 8}, {8, 16384}};

// Big and small, to the far corner. Depths are in units that the transform makes something of.
CaseDraw mesh_in(Rng& rng, const Window& window, const std::function<double()>& depth) {
  CaseDraw draw{.test_depth = true};
  for (const WindowShape shape : kWindowShapes)
    for (int n = 0; n < 8; ++n)
      for (const GridPoint& p : random_triangle(rng, shape, window.width, window.height).at)
        for (const double c : {clip_x(p.x, window.width), clip_y(p.y, window.height), depth(), 1.0})
          draw.positions.push_back(static_cast<float>(c));
  return draw;
}

// From `scale` z + `start`, a depth within 0 .. 1, to clip space.
Matrix depth_transform(double scale, double start) {
  return {.m = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2 * scale, 2 * start - 1, 0, 0, 0, 1}};
}

/// How draws are tested: the nearer one after the farther one, and all others.
struct Tests {
  Compare nearer = Compare::less, others = Compare::less;
};

// Of the pixels that the mesh covers, those that do not show the nearer one.
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
  long double wrong = 0, seen = 0;
  for (const bool near_first : {false, true}) {
    const CaseDraw first =
        near_first ? colored(kNear, nearer, tests.others) : colored(kFar, farther, tests.others);
    const CaseDraw second =
        near_first ? colored(kFar, farther, tests.others) : colored(kNear, nearer, tests.nearer);
    for (const std::array<float, 3>& color : renderer.draw({behind, first, second}).colors) {
      wrong += color[0] > 0 || color[2] > 0;
      seen += color[0] > 0 || color[1] > 0 || color[2] > 0;
    }
  }
  EXPECT_GT(seen, 100);
  return wrong;
}

// A depth that is stored as this number, whichever way it is computed: levels by their middle.
double depth_of(const DepthCase& depth, std::int64_t stored) {
  return depth.is_float() ? float_of(static_cast<std::uint32_t>(stored))
                          : static_cast<double>(stored) / static_cast<double>(depth.levels());
}

TEST(Depth, ParallelSurfacesOneStepApartStayApart) {
  for (const DepthCase& depth : kDepthCases)
    expect_figure(
        "depth, " + std::string(depth.name) + ", one step apart, facing the viewer", 0, "pixels",
        [&](const MakeRenderer& make, bool is_tessera) {
          Rng rng(11);
          long double wrong = 0;
          // Doubles of -1 .. 1 hold twice a float less one exactly from 2^-31 on.
          const std::int64_t first = depth.is_float() ? 0x30000000 : 0,
                             last = depth.is_float()
                                        ? 0x3f800000
                                        : depth.levels();  // the far end is never less than what is cleared
          for (const Window& window : kWindows) {
            const auto renderer =
                make({.width = window.width, .height = window.height, .depth = depth.format});
            std::vector<std::int64_t> nearer{first, first + 1, (first + last) / 2, last - 2};
            for (int n = 0; n < (is_tessera && long_tests() ? 500 : window.width == 64 ? 40 : 2); ++n)
              nearer.push_back(rng.between(first, last - 2));
            for (const std::int64_t stored : nearer)
              wrong += wrong_pixels(*renderer, mesh_in(rng, window, [] { return 0.0; }),
                                    depth_transform(0, depth_of(depth, stored)),
                                    depth_transform(0, depth_of(depth, stored + 1)));
          }
          return wrong;
        });
}

// Reversed depth is z itself: floats stay apart down to the smallest there is.
TEST(Depth, ParallelSurfacesOneFloatApartStayApartInReversedDepth) {
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
                         exponent += window.width == 64 ? 1 : 21) {  // of 2^-126 and less .. 1
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

// The same tilted triangles, moved by one level: with vertices anywhere between two levels, or in the middle
// of one.
TEST(Depth, TiltedSurfacesOneLevelApartStayApart) {
  for (const bool on_levels : {false, true})
    for (const DepthCase& depth : kUnorms)
      expect_figure(
          "depth, " + std::string(depth.name) + ", one step apart, tilted, vertices " +
              (on_levels ? "on levels" : "anywhere"),
          0, "pixels", [&](const MakeRenderer& make, bool is_tessera) {
            Rng rng(12);
            long double wrong = 0;
            const double level = 1 / static_cast<double>(depth.levels());
            for (const Window& window : kWindows) {
              const auto renderer =
                  make({.width = window.width, .height = window.height, .depth = depth.format});
              for (int n = 0; n < (is_tessera && long_tests() ? 500 : window.width == 64 ? 40 : 4); ++n) {
                const std::int64_t most = std::min<std::int64_t>(depth.levels(), (1 << 24) - 1);
                const std::int64_t spread = std::int64_t{1} << rng.between(0, 23),
                                   middle = rng.between(0, most);
                const CaseDraw mesh = mesh_in(rng, window, [&] {
                  return static_cast<double>(
                      std::clamp<std::int64_t>(middle + rng.between(-spread, spread), 2, most - 2));
                });
                const double scale =
                    level * (depth.bits == 32 ? 256 : 1) * (on_levels ? 1 : 0.99 * rng.unit());
                wrong +=
                    wrong_pixels(*renderer, mesh, depth_transform(scale, 0), depth_transform(scale, level));
              }
            }
            return wrong;
          });
}

// Between the vertices floats are rounded, so what is one float nearer at the vertices may be as near; it is
// never farther. (The steps of the depth are the same numbers for both, and every operation on the way to a
// pixel's depth is monotonic.) What is two floats nearer is nearer.
TEST(Depth, TiltedSurfacesOneFloatNearerNeverFallBehindAndTwoAreNearer) {
  for (const int floats : {1, 2})
    expect_figure(
        std::string("depth, floats, tilted, ") +
            (floats == 1 ? "one step apart, tested by lequal" : "two steps apart"),
        0, "pixels", [&](const MakeRenderer& make, bool is_tessera) {
          Rng rng(13);
          long double wrong = 0;
          for (const Window& window : kWindows) {
            const auto renderer =
                make({.width = window.width, .height = window.height, .depth = DepthFormat::float32});
            for (int n = 0; n < (is_tessera && long_tests() ? 500 : window.width == 64 ? 40 : 4); ++n) {
              // Depths in 2^-24: a step is the smallest difference at 1/2 and more.
              const std::int64_t spread = std::int64_t{1} << rng.between(0, 23),
                                 middle = rng.between(0, 1 << 24);
              const CaseDraw mesh = mesh_in(rng, window, [&] {
                return static_cast<double>(
                    std::clamp<std::int64_t>(middle + rng.between(-spread, spread), 1 << 10, (1 << 24) - 3));
              });
              wrong += wrong_pixels(*renderer, mesh, depth_transform(0x1p-24, 0),
                                    depth_transform(0x1p-24, floats * 0x1p-24),
                                    {floats == 1 ? Compare::lequal : Compare::less, Compare::less});
            }
          }
          return wrong;
        });
}

// Pixels of a decal that do not show on the plane that it lies in; `seen` counts those that it has on it.
long double hidden_pixels(CaseRenderer& renderer, const CaseDraw& base, CaseDraw decal, const Matrix& plane,
                          const PolygonOffset& offset, long& seen) {
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
    seen += alone[i][1] > 0 && covered[i][0] > 0;
    hidden += alone[i][1] > 0 && both[i][0] > 0;
  }
  return hidden;
}

// The same triangles again, and other triangles of the same plane. Those are snapped elsewhere, which a slope
// is enough for, and stored levels are rounded down from words that are: where the slope is next to nothing,
// this may cost a unit.
TEST(Depth, OffsetByAUnitSeparatesWhatLiesInOnePlane) {
  for (const bool same : {true, false})
    for (const DepthCase& depth : kDepthCases)
      expect_figure(
          "depth, " + std::string(depth.name) + ", offset by a " +
              (same ? "unit, the same triangles" : "slope and two units, another in the same plane"),
          0, "pixels", [&](const MakeRenderer& make, bool is_tessera) {
            Rng rng(14);
            long double hidden = 0;
            long seen = 0;
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
              // Depth is linear in x and y: within 0.1 .. 0.9 all over the window and what reaches beyond it.
              const double slope = n % 8 == 0 ? 0 : std::exp2(-24 * rng.unit()) * 0.05;
              const double turn = 6.28318530718 * rng.unit();
              Matrix plane = depth_transform(0, 0.5);
              plane.m[8] = slope * std::cos(turn);
              plane.m[9] = slope * std::sin(turn);
              const double rounding = depth.is_float()
                                          ? std::abs(slope) / 32 * 0x1p24
                                          : 1;  // steps a pixel: with fewer than one, floats between the
                                                // vertices are rounded farther than a slope goes
              if (same) hidden += hidden_pixels(*renderer, decal, decal, plane, {0, -1}, seen);
              else if (slope == 0 || rounding >= 1)
                hidden +=
                    hidden_pixels(*renderer, base, decal, plane, {-1, slope == 0 ? -1.0f : -2.0f}, seen);
            }
            EXPECT_GT(seen, 10000);
            return hidden;
          });
}

}  // namespace
}  // namespace tessera::test
