// Range of a depth buffer: a reversed projection into float, and projections without a far plane.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/case_renderer.h"
#include "tests/numerics/depth_formats.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::depth_distance_test {
namespace {

constexpr int kSide = 64;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Two triangles that cover the window and more; their corners are 1 to `tilt` units away.
CaseDraw sheet(Rng& rng, double tilt) {
  CaseDraw draw{.test_depth = true, .depth_func = Compare::greater};
  std::array<std::array<float, 4>, 4> corners{};
  for (std::size_t k = 0; k < 4; ++k) {
    const double away = 1 + (tilt - 1) * rng.unit();
    corners[k] = {static_cast<float>((k == 1 || k == 2 ? 1.25 : -1.25) * away),
                  static_cast<float>((k >= 2 ? 1.25 : -1.25) * away), static_cast<float>(-away), 1};
  }
  for (const std::size_t k : {0, 1, 2, 0, 2, 3})
    draw.positions.insert(draw.positions.end(), corners[k].begin(), corners[k].end());
  return draw;
}

// Whether the nearer surface shows at every covered pixel, in either drawing order.
bool is_apart(CaseRenderer& renderer, CaseDraw nearer, CaseDraw farther, const Matrix& turn, double distance,
              double part) {
  const Matrix projection = perspective(90, 1, 0.1, kInfinity, true) * turn;
  nearer.transform = projection * scale(distance * (1 - part), distance * (1 - part), distance * (1 - part));
  farther.transform = projection * scale(distance, distance, distance);
  nearer.color = {0, 1, 0, 1};
  farther.color = {1, 0, 0, 1};
  int visible_pixels = 0;
  for (const bool near_first : {false, true})
    for (const std::array<float, 3>& color :
         renderer.draw(near_first ? std::vector{nearer, farther} : std::vector{farther, nearer}).colors) {
      if (color[0] > 0) return false;
      visible_pixels += color[1] > 0 ? 1 : 0;
    }
  return visible_pixels > kSide;
}

// A floor below the viewer, at `height` times the distance in `positions`, from straight below to 6 heights
// ahead and `sides` to the left and right.
CaseDraw floor(double sides) {
  CaseDraw draw{.test_depth = true, .depth_func = Compare::greater};
  for (const auto& [x, z] :
       {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, -6.0}, {-1.0, -1.0}, {1.0, -6.0}, {-1.0, -6.0}})
    for (const double c : {x * sides, -1.0, z, 1.0}) draw.positions.push_back(static_cast<float>(c));
  return draw;
}

// z = 0.1 / distance. A relative difference of eps = 2^-23 is at least the step between two floats. Each of
// the two depths has the roundings of the vertex depths, whose weights are positive and sum to 1, and its own
// rounding: 2^-23 of itself. Twice that plus one step is 3 eps. If all vertices are equally far away there is
// one rounding, and the sum is 2 eps. The vertex positions are snapped identically for both surfaces.
TEST(DepthDistance, ReversedFloatsSeparateSurfacesOutToFiveMillion) {
  constexpr int kMax = 1000;
  const auto figure = [](const auto& make_draw, const Matrix& turn, double farthest, int distances) {
    return [=](const MakeRenderer& make, bool is_tessera) {
      const auto renderer = make({.width = kSide,
                                  .height = kSide,
                                  .depth = DepthFormat::float32,
                                  .reversed = true,
                                  .cleared_depth = 0});
      int needed = 1;
      Rng rng(21);
      for (int n = 0; n < (is_tessera && long_tests() ? 20 * distances : distances); ++n) {
        const double distance = n == 0 ? farthest : 0.1 * std::pow(10 * farthest, rng.unit()) * 1.01;
        const CaseDraw draw = make_draw(rng);
        for (int k = needed; k <= 16; ++k)  // every k from the smallest required
          if (!is_apart(*renderer, draw, draw, turn, distance, k * 0x1p-23)) needed = k + 1;
        while (needed > 16 && needed < kMax &&
               !is_apart(*renderer, draw, draw, turn, distance, needed * 0x1p-23))
          ++needed;
      }
      return static_cast<long double>(needed);
    };
  };
  const auto sheets = [](double tilt) { return [tilt](Rng& rng) { return sheet(rng, tilt); }; };
  const auto floors = [](double sides) { return [sides](Rng&) { return floor(sides); }; };
  expect_figure("reversed depth, floats, 0.1 .. 5 million away, facing the viewer: apart by", 2, "2^-23",
                figure(sheets(1), Matrix(), 5e6, 150));
  expect_figure("reversed depth, floats, 0.1 .. 5 million away, tilted: apart by", 3, "2^-23",
                figure(sheets(1.5), Matrix(), 5e6, 150));
  for (const double roll : {0.0, 30.0, 45.0, 120.0})
    for (const double sides : {10.0, 1000.0, 100000.0})
      expect_figure("reversed depth, floats, floors 1:" + std::to_string(static_cast<int>(sides)) +
                        ", rolled by " + std::to_string(static_cast<int>(roll)) + ": apart by",
                    3, "2^-23", figure(floors(sides), rotate(roll, 0, 0, 1), 8e5, 30));
}

// depth = 1 - near / distance, exactly; at infinity, where w is 0 before projection, the far end. Checks the
// stored depth and that everything is drawn.
TEST(DepthDistance, WithoutAFarEndEverythingIsDrawn) {
  for (const DepthCase& depth : kDepthCases)
    expect_figure(
        "far = infinity, " + std::string(depth.name) + ", facing the viewer", 0, "levels",
        [&](const MakeRenderer& make, bool is_tessera) {
          const auto renderer =
              make({.width = kSide, .height = kSide, .depth = depth.format, .cleared_depth = 0});
          Rng rng(22);
          long double worst = 0;
          for (int n = 0; n < (is_tessera && long_tests() ? 3000 : 100); ++n) {
            const double distance = n == 0 ? kInfinity : std::pow(10.0, 30 * rng.unit());
            const double size = std::isinf(distance) ? 1 : distance;
            CaseDraw draw{.test_depth = true,
                          .depth_func = Compare::gequal,
                          .transform = perspective(90, 1, 1, kInfinity) * scale(size, size, size)};
            for (const double c : {-1.5, -1.5, 4.5, -1.5, -1.5, 4.5}) {
              draw.positions.push_back(static_cast<float>(c));
              if (draw.positions.size() % 4 == 2)
                draw.positions.insert(draw.positions.end(), {-1, std::isinf(distance) ? 0.0f : 1.0f});
            }
            const CasePicture& picture = renderer->draw({draw});
            const long double exact = 1 - 1.0L / static_cast<long double>(distance);
            const std::int64_t expected =
                depth.is_float() ? std::bit_cast<std::uint32_t>(static_cast<float>(exact))
                                 : static_cast<std::int64_t>(
                                       std::floor(exact * static_cast<long double>(depth.levels()) + 0.5L));
            for (std::size_t i = 0; i < picture.depth.size(); ++i)
              update_worst(worst,
                           picture.colors[i][0] > 0 ? std::abs(picture.depth[i] - expected) : depth.levels());
          }
          return worst;
        });
}

// A floor without end: every pixel up to the horizon shows it, none above does, and depth never decreases
// towards the horizon.
TEST(DepthDistance, AFloorReachesTheHorizon) {
  for (const bool reversed : {false, true})
    for (const DepthCase& depth : kDepthCases)
      expect_figure("far = infinity, " + std::string(depth.name) + (reversed ? ", reversed" : "") +
                        ", a floor up to its horizon",
                    0, "pixels", [&](const MakeRenderer& make, bool) {
                      const auto renderer = make({.width = kSide,
                                                  .height = kSide,
                                                  .depth = depth.format,
                                                  .reversed = reversed,
                                                  .cleared_depth = reversed ? 1.0 : 0.0});
                      CaseDraw draw{.test_depth = true,
                                    .depth_func = reversed ? Compare::lequal : Compare::gequal,
                                    .transform = perspective(90, 1, 0.5, kInfinity, reversed)};
                      // From below the window's lower edge to the points at infinity straight ahead.
                      draw.positions = {-8, -1, -0.5f, 1, 8, -1, -0.5f, 1, 4,  0, -1, 0,
                                        -8, -1, -0.5f, 1, 4, 0,  -1,    0, -4, 0, -1, 0};
                      const CasePicture& picture = renderer->draw({draw});
                      long double wrong = 0;
                      for (std::size_t y = 0; y < kSide; ++y)
                        for (std::size_t x = 0; x < kSide; ++x) {
                          const std::size_t at = y * kSide + x;
                          const bool is_floor = y >= kSide / 2;
                          const bool is_drawn = picture.colors[at][0] > 0;
                          const bool is_nearer = is_floor && y > kSide / 2 &&
                                                 (reversed ? picture.depth[at - kSide] > picture.depth[at]
                                                           : picture.depth[at - kSide] < picture.depth[at]);
                          wrong += is_drawn != is_floor || is_nearer;
                        }
                      return wrong;
                    });
}

}  // namespace
}  // namespace tessera::test::depth_distance_test
