// Colours and texture coordinates are continuous across a cut, as if nothing had been clipped. Planes have
// attributes that are linear in clip space. Each pixel is compared in long double with the attribute of the
// plane at that pixel, from whole numbers, without clipping or triangles. Neighbours that are clipped
// differently are compared with the same function, so they cannot differ by more than twice the bound.
//
// The bound: a vertex is drawn up to kReach from its exact position, with the attributes of the exact
// position. Inside a triangle a point therefore moves by the weighted mean of the vertex moves, with the
// attribute weights, in numerator and denominator alike. So it shows exactly the attribute of some point
// within kReach in x and y. A quotient of linear functions takes its extremes over that square at the
// corners. Float roundings add, each relative to a weight or an attribute in 0 .. 1, less than 16 * 2^-24 in
// total, which is 2^-10 of a level. Storing rounds by half a level.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/plane_mesh.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::clipped_colors_test {
namespace {

constexpr int kSide = 64;
constexpr std::int64_t kSize = 64;  // extent of the plane in u and v
constexpr long double kBound = 0.5L + 0x1p-10L;

/// An attribute in 0 .. 1: one + u by_u + v by_v, in 1/256.
struct Attribute {
  std::int64_t one = 128;
  std::int64_t by_u = 0;
  std::int64_t by_v = 0;
  float at(const WindowPoint& p) const { return static_cast<float>(one + p.x * by_u + p.y * by_v) / 256.0f; }
};

struct Range {
  long double low = 1, high = 0;
};
// Range of the attribute within kReach of a point of the window.
Range range_around(const VisiblePlane& visible, const Attribute& attribute, Wide x, Wide y) {
  const Linear numerator = visible.mix(attribute.one, attribute.by_u, attribute.by_v);
  Range range;
  for (const int dx : {-kReach, kReach})
    for (const int dy : {-kReach, kReach}) {
      const long double at_x = static_cast<long double>(x) + dx / static_cast<long double>(kReachScale);
      const long double at_y = static_cast<long double>(y) + dy / static_cast<long double>(kReachScale);
      const long double value = numerator.at(at_x, at_y) / visible.coordinates[0].at(at_x, at_y) / 256;
      range.low = std::min(range.low, value);
      range.high = std::max(range.high, value);
    }
  return range;
}

// Largest distance from the expected range, in levels of 255, over all pixels that are certain to show the
// plane. `level_of` maps an attribute to a level.
template <class LevelOf>
long double worst_of(const CasePicture& picture, const VisiblePlane& visible, const ExactRegion& region,
                     const SquareViewport& view, const std::vector<Attribute>& attributes,
                     const LevelOf& level_of, long& pixels) {
  long double worst = 0;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const auto [x, y] = center_of(column, row, kSide, view);
      if (region.side(x, y) != ExactRegion::Side::in) continue;
      ++pixels;
      for (std::size_t a = 0; a < attributes.size(); ++a) {
        const Range range = range_around(visible, attributes[a], x, y);
        const long double level =
            255 * static_cast<long double>(picture.colors[static_cast<std::size_t>(row * kSide + column)][a]);
        update_worst(worst, level - level_of(range.high), level_of(range.low) - level);
      }
    }
  return worst;
}

template <class LevelOf>
long double worst_of_planes(const MakeRenderer& make, bool is_tessera, bool textured, bool reversed,
                            long double bound, const LevelOf& level_of) {
  CaseFormat format{.width = kSide, .height = kSide, .reversed = reversed};
  if (textured) {
    // The level of each texel is its index, so halfway between two centres the result is their mean.
    format.texture_width = 256;
    format.texture_height = 1;
    for (int i = 0; i < 256; ++i) format.texture.push_back(static_cast<std::uint8_t>(i));
  }
  const std::unique_ptr<CaseRenderer> renderer = make(format);
  long double worst = 0;
  long pixels = 0;
  long clipped = 0;
  for (int n = 0; n < (is_tessera && long_tests() ? 200000 : 1000); ++n) {
    MeshRandom random(n);
    ClipPlane plane = random_plane(random);
    if (reversed) {  // The far plane is at infinity.
      plane.origin.z = 1;
      plane.to_u.z = plane.to_v.z = 0;
    }
    const int side = random.one_of({kSide, 2048, 16384});
    const SquareViewport view{-random.between(0, side - kSide), -random.between(0, side - kSide), side};
    const std::optional<VisiblePlane> visible = plane.visible(view);
    if (!visible) continue;
    const Grid grid = random_plane_grid(random, kSize, 12);
    CountedMesh mesh = plane.mesh_at(grid.points, random.one_of({1.0, 0x1p100, 0x1p-100}));
    grid.cut_into(mesh, random);
    std::vector<Attribute> attributes;
    for (int c = 0; c < (textured ? 1 : 3); ++c)
      attributes.push_back({128, random.one_of({-1, 0, 1}), random.one_of({-1, 0, 1})});
    if (textured) attributes[0].by_v = 0;  // s runs from 1/4 to 3/4, where wrapping has no effect.
    CaseDraw draw{.positions = mesh.positions,
                  .indices = mesh.indices,
                  .viewport = Rect{view.x, view.y, view.side, view.side},
                  .textured = textured};
    for (const WindowPoint& p : grid.points) {
      if (textured) draw.texcoords.insert(draw.texcoords.end(), {attributes[0].at(p), 0});
      else
        draw.colors.insert(draw.colors.end(),
                           {attributes[0].at(p), attributes[1].at(p), attributes[2].at(p), 1});
    }
    const long before = pixels;
    const long double here =
        worst_of(renderer->draw({draw}), *visible, plane.region(*visible, kSize, reversed), view, attributes,
                 level_of, pixels);
    clipped +=
        pixels != before && std::any_of(grid.points.begin(), grid.points.end(),
                                        [&](const WindowPoint& p) { return plane.at(p.x, p.y).w <= 0; });
    if (is_tessera && here > bound && worst <= bound)
      ADD_FAILURE() << "plane " << n << " is off by " << static_cast<double>(here) << " levels";
    update_worst(worst, here);
  }
  EXPECT_GT(pixels, 100000);
  EXPECT_GT(clipped, 200);  // planes that are visible and reach behind the eye
  return worst;
}

TEST(ClippedColors, AreContinuousAcrossTheCut) {
  const auto level_of = [](long double color) { return 255 * color; };
  expect_figure("colours across cuts, off the exact ones within the reach of snapping", kBound,
                "levels of 255", [&](const MakeRenderer& make, bool is_tessera) {
                  return worst_of_planes(make, is_tessera, false, false, kBound, level_of);
                });
  expect_figure("colours across cuts, reversed, far at infinity", kBound, "levels of 255",
                [&](const MakeRenderer& make, bool is_tessera) {
                  return worst_of_planes(make, is_tessera, false, true, kBound, level_of);
                });
}

// Linear filtering blends two neighbours with 8 fraction bits of a level. Both the subtracted and the added
// share are rounded down: at most 2^-8 of a level.
TEST(ClippedColors, TexturesAreContinuousAcrossTheCut) {
  constexpr long double kWithFilter = kBound + 0x1p-8L;
  expect_figure("textures across cuts, off the exact level within the reach of snapping", kWithFilter,
                "levels of 255", [](const MakeRenderer& make, bool is_tessera) {
                  return worst_of_planes(make, is_tessera, true, false, kWithFilter,
                                         [](long double s) { return 256 * s - 0.5L; });
                });
}

}  // namespace
}  // namespace tessera::test::clipped_colors_test
