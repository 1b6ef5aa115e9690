// Neither coverage nor depth depends on the order of a triangle's vertices or on its winding: whole and
// clipped triangles in all six orders.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/numerics/counted_mesh.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::vertex_order_test {
namespace {

// Each triangle has its own viewport in a large buffer, so that tile borders cross each one at a different
// place.
constexpr int kView = 32;
constexpr int kPitch = 37;
constexpr int kRow = 13;
constexpr int kBuffer = kRow * kPitch;
constexpr int kBatch = kRow * kRow;

using Corners = std::array<std::array<float, 4>, 3>;

Corners random_corners(RandomTriangles& source, bool clipped) {
  Corners corners;
  const Triangle shape = source.next();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto any = [&] { return static_cast<float>(source.between(-63, 63)); };
    const auto centered = [](std::int32_t c) {
      return static_cast<float>(std::clamp(c - 128 * kView, -16382 * 256, 16382 * 256) / (128.0 * kView));
    };
    if (clipped) corners[k] = {any(), any(), any(), any()};
    else
      corners[k] = {centered(shape[k].x), centered(shape[k].y), static_cast<float>(2 * source.unit() - 1), 1};
  }
  return corners;
}

std::vector<CaseDraw> draws_of(const std::vector<Corners>& triangles,
                               const std::array<std::uint32_t, 3>& order) {
  std::vector<CaseDraw> draws;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const int place = static_cast<int>(i);
    CaseDraw& draw = draws.emplace_back();
    for (const std::array<float, 4>& corner : triangles[i])
      draw.positions.insert(draw.positions.end(), corner.begin(), corner.end());
    draw.indices.assign(order.begin(), order.end());
    draw.test_depth = true;
    draw.depth_func = Compare::always;
    draw.viewport = Rect{place % kRow * kPitch, place / kRow * kPitch, kView, kView};
  }
  return draws;
}

// Number of pixels whose coverage or depth under any other order differs from the first.
long double changed_pixels(const MakeRenderer& make, bool is_tessera, DepthFormat depth, bool clipped,
                           bool coverage) {
  const std::unique_ptr<CaseRenderer> renderer = make({.width = kBuffer, .height = kBuffer, .depth = depth});
  RandomTriangles source(clipped ? 2 : 1, kView);
  long double changed = 0;
  std::size_t visible_pixels = 0;
  for (int batch = 0; batch < (is_tessera && long_tests() ? 600 : 6); ++batch) {
    std::vector<Corners> triangles(kBatch);
    for (Corners& corners : triangles) corners = random_corners(source, clipped);
    std::array<std::uint32_t, 3> order{0, 1, 2};
    const CasePicture first = renderer->draw(draws_of(triangles, order));
    for (const std::array<float, 3>& color : first.colors) visible_pixels += color[0] > 0;
    while (std::next_permutation(order.begin(), order.end())) {
      const CasePicture& other = renderer->draw(draws_of(triangles, order));
      for (std::size_t i = 0; i < first.colors.size(); ++i) {
        const bool differs = coverage ? first.colors[i] != other.colors[i] : first.depth[i] != other.depth[i];
        if (differs && is_tessera && changed == 0)
          ADD_FAILURE() << "batch " << batch << ", pixel " << i % kBuffer << ", " << i / kBuffer << ", order "
                        << order[0] << order[1] << order[2] << ": depth " << other.depth[i] << ", not "
                        << first.depth[i];
        changed += differs;
      }
    }
  }
  EXPECT_GT(visible_pixels, 10000u);
  return changed;
}

TEST(VertexOrder, AffectsNeitherCoverageNorDepth) {
  const std::pair<DepthFormat, std::string> formats[] = {{DepthFormat::unorm16, "unorm16"},
                                                         {DepthFormat::unorm24, "unorm24"},
                                                         {DepthFormat::unorm32, "unorm32"},
                                                         {DepthFormat::float32, "float32"}};
  for (const bool clipped : {false, true}) {
    const auto expect_none = [clipped](const std::string& what, DepthFormat format, bool coverage) {
      expect_figure((clipped ? "order of vertices, clipped: " : "order of vertices: ") + what + " changes", 0,
                    "pixels", [&](const MakeRenderer& make, bool is_tessera) {
                      return changed_pixels(make, is_tessera, format, clipped, coverage);
                    });
    };
    expect_none("coverage", DepthFormat::unorm24, true);
    for (const auto& [format, name] : formats) expect_none(name, format, false);
  }
}

}  // namespace
}  // namespace tessera::test::vertex_order_test
