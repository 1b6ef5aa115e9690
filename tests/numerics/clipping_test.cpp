// Clipped triangles: at and around w = 0, behind the eye, through and along the near plane, 10^30 in size,
// far beyond the guard band. Pixels are compared with the exact projection of the inside part, by rational
// arithmetic on whole numbers (exact_region.h).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/numerics/counted_mesh.h"
#include "tests/numerics/exact_region.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::clipping_test {
namespace {

constexpr SquareViewport kView{0, 0, 64};

/// The exact triangle and its float version that is drawn. The float `w` may differ slightly from an exact 0,
/// which moves nothing by even 10^-20 pixels.
struct DrawnTriangle {
  std::array<ClipPoint, 3> exact;
  std::array<float, 3> extra_w{};
  float scale = 1;
  bool reversed = false;

  CaseDraw draw() const {
    CaseDraw d{.color = {0, 0, 1 / 255.0f, 1}, .add = true};
    for (std::size_t k = 0; k < 3; ++k) {
      const ClipPoint& p = exact[k];
      for (const std::int64_t c : {p.x, p.y, p.z}) d.positions.push_back(scale * static_cast<float>(c));
      d.positions.push_back(scale * static_cast<float>(p.w) + extra_w[k]);
    }
    return d;
  }
  /// Empty if the triangle is edge-on.
  std::optional<std::vector<Cover>> expected() const {
    const std::optional<VisiblePlane> visible = visible_plane(exact, kView);
    if (!visible) return std::nullopt;
    const auto of_vertices = [&](const auto& value) {
      return visible->mix(value(exact[0]), value(exact[1]), value(exact[2]));
    };
    ExactRegion region;
    region.inside = {visible->coordinates.begin(), visible->coordinates.end()};
    region.inside.push_back(
        of_vertices([&](const ClipPoint& p) { return reversed ? p.w - p.z : p.w + p.z; }));
    region.inside.push_back(of_vertices([&](const ClipPoint& p) { return reversed ? p.z : p.w - p.z; }));
    region.outside = region.inside;
    return covers_of(region, kView.side, kView.side, kView);
  }
};

std::int64_t any(MeshRandom& random) { return random.between(-63, 63); }
DrawnTriangle any_triangle(MeshRandom& random) {
  DrawnTriangle t;
  for (ClipPoint& p : t.exact) p = {any(random), any(random), any(random), any(random)};
  return t;
}

// Counts pixels left out, covered twice, and covered beyond the edge.
void expect_exact(const std::string& what, DrawnTriangle (*make)(MeshRandom&), bool reversed = false) {
  expect_coverage(what, {.width = kView.side, .height = kView.side, .reversed = reversed},
                  [make, reversed](const Count& count, bool is_tessera) {
                    for (int n = 0; n < (is_tessera && long_tests() ? 200000 : 2000); ++n) {
                      MeshRandom random(n);
                      DrawnTriangle triangle = make(random);
                      triangle.reversed = reversed;
                      if (const auto expected = triangle.expected())
                        count({triangle.draw()}, "triangle " + std::to_string(n), {*expected});
                    }
                  });
}

TEST(Clipping, MatchesTheExactProjection) {
  expect_exact("clipped triangles", any_triangle);
  expect_exact("clipped triangles, reversed depth", any_triangle, true);
}

TEST(Clipping, IsExactAtAndAroundWZero) {
  expect_exact("triangles with w = 0, 2^-149, 1e-30, -1e-30", [](MeshRandom& random) {
    DrawnTriangle t = any_triangle(random);
    for (int k = random.between(0, 2); k < 3; ++k) {
      t.exact[static_cast<std::size_t>(k)].w = 0;
      t.exact[static_cast<std::size_t>(k)].z *= random.between(0, 1);  // on the near and on the far plane
      t.extra_w[static_cast<std::size_t>(k)] =
          random.one_of({0.0f, -0.0f, 0x1p-149f, -0x1p-149f, 1e-30f, -1e-30f});
    }
    return t;
  });
}

TEST(Clipping, IsExactThroughAVertexOrAlongAnEdge) {
  expect_exact("near or far plane through one, two or three vertices", [](MeshRandom& random) {
    DrawnTriangle t = any_triangle(random);
    const int sign = random.coin() ? 1 : -1;
    for (int k = random.between(0, 2); k < 3; ++k)
      t.exact[static_cast<std::size_t>(k)].z = sign * t.exact[static_cast<std::size_t>(k)].w;
    return t;
  });
}

TEST(Clipping, IsExactForHugeTriangles) {
  expect_exact("triangles of 10^30, and w", [](MeshRandom& random) {
    DrawnTriangle t = any_triangle(random);
    t.scale = 0x1p100f;
    return t;
  });
  expect_exact("triangles of 10^-30, and w", [](MeshRandom& random) {
    DrawnTriangle t = any_triangle(random);
    t.scale = 0x1p-100f;
    return t;
  });
  expect_exact("vertices far beyond the guard band", [](MeshRandom& random) {
    DrawnTriangle t = any_triangle(random);
    for (int k = random.between(0, 2); k < 3; ++k) {
      ClipPoint& p = t.exact[static_cast<std::size_t>(k)];
      p.x *= std::int64_t{1} << random.between(0, 20);
      p.y *= std::int64_t{1} << random.between(0, 20);
    }
    return t;
  });
}

// z = 1 everywhere, so depth is 1/w and the infinite far plane cuts nothing: from w = 1 to points at
// infinity.
TEST(Clipping, IsExactUnderReversedInfiniteDepth) {
  expect_exact(
      "near plane, reversed, far at infinity",
      [](MeshRandom& random) {
        DrawnTriangle t = any_triangle(random);
        for (ClipPoint& p : t.exact) p.z = random.between(0, 7) != 0 ? 1 : 0;
        return t;
      },
      true);
}

// No tolerance: not a single pixel.
TEST(Clipping, ShowsNothingBehindTheEye) {
  expect_coverage(
      "triangles behind the eye", {.width = kView.side, .height = kView.side},
      [](const Count& count, bool is_tessera) {
        const std::vector<Cover> nothing(std::size_t{kView.side} * std::size_t{kView.side}, Cover::never);
        for (int n = 0; n < (is_tessera && long_tests() ? 200000 : 2000); ++n) {
          MeshRandom random(n);
          CaseDraw draw{.color = {0, 0, 1 / 255.0f, 1}, .add = true};
          for (int k = 0; k < 3; ++k) {
            const float scale = random.one_of({1.0f, 1e-30f, 1e30f});
            for (int c = 0; c < 3; ++c) draw.positions.push_back(scale * static_cast<float>(any(random)));
            draw.positions.push_back(random.one_of({0.0f, -0.0f, -0x1p-149f, -1e-30f, -1.0f, -1e30f}));
          }
          count({draw}, "triangle " + std::to_string(n), {nothing});
        }
      });
}

}  // namespace
}  // namespace tessera::test::clipping_test
