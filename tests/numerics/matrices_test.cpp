// Degenerate transforms: singular, mirrored, stretched a million times along one axis. Normals under them
// against the inverse transpose in long double.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/random_lit_scenes.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::matrices_test {
namespace {

constexpr Real kFloat = 0x1p-24L;
constexpr Real kDouble = 0x1p-53L;

/// A 3x3 matrix for directions, by rows.
struct Real33 {
  std::array<Real3, 3> row{};
  Real3 operator*(const Real3& v) const { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
  Real3 column(std::size_t k) const { return {row[0][k], row[1][k], row[2][k]}; }
  Real33 operator*(const Real33& b) const {
    Real33 r;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) r.row[i][k] = dot(row[i], b.column(k));
    return r;
  }
};
Real33 real33(const Matrix& m, bool magnitudes = false) {
  Real33 r;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) r.row[i][k] = magnitudes ? std::abs(m.m[4 * i + k]) : m.m[4 * i + k];
  return r;
}
/// The cofactor matrix: products of two elements minus (`sign` -1) or plus two others.
Real33 cofactors(const Real33& m, Real sign) {
  Real33 r;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i1 = (i + 1) % 3;
      const std::size_t i2 = (i + 2) % 3;
      const std::size_t k1 = (k + 1) % 3;
      const std::size_t k2 = (k + 2) % 3;
      r.row[i][k] = m.row[i1][k1] * m.row[i2][k2] + sign * m.row[i1][k2] * m.row[i2][k1];
    }
  return r;
}

/// Transforms the normals of points in the engine: each point has its own transform and its own pixel; reads
/// the normals from a capture.
class NormalProbe {
 public:
  struct Case {
    Matrix view;
    Matrix transform;
    std::array<float, 3> normal;
    bool normalize = true;
    Shading shading = Shading::gouraud;
  };
  static constexpr int kSide = 16;

  std::vector<std::array<float, 3>> normals(const std::vector<Case>& cases) {
    const std::array<float, 3> origin{};
    Frame frame(buffer_);
    std::vector<float> captured(3 * kSide * kSide);
    frame.clear({.color = Color{0, 0, 0, 1}});
    for (std::size_t i = 0; i < cases.size(); ++i) {
      frame.set_camera({.view = cases[i].view, .projection = {}});
      frame.draw({.primitive = Primitive::points, .positions = origin, .normals = cases[i].normal},
                 {.transform = cases[i].transform,
                  .shading = cases[i].shading,
                  .normalize = cases[i].normalize,
                  .depth = {.enabled = false},
                  .viewport = Rect{static_cast<int>(i) % kSide, static_cast<int>(i) / kSide, 1, 1}});
    }
    frame.capture({.normals = captured});
    renderer_.finish(frame);
    std::vector<std::array<float, 3>> normals;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const std::size_t at = 3 * ((kSide - 1 - i / kSide) * kSide + i % kSide);
      normals.push_back({captured[at], captured[at + 1], captured[at + 2]});
    }
    return normals;
  }

 private:
  FrameBuffer buffer_{FrameBufferFormat{.width = kSide, .height = kSide}};
  Renderer renderer_{RendererOptions{.threads = 1}};
};

Matrix turn(LightingRng& rng) {
  const std::array<float, 3> axis = rng.direction();
  return rotate(rng.between(0, 360), axis[0], axis[1], axis[2]);
}
/// Scales each axis by up to 10^`decades` or 10^-`decades`; some axes are mirrored.
Matrix stretch(LightingRng& rng, double decades) {
  const auto any = [&] { return std::pow(10, rng.between(-decades, decades)) * (rng.one_in(2) ? -1 : 1); };
  const double x = any(), y = any();
  return scale(x, y, any());
}

// Error bound of the direction, and of the determinant whose sign selects its side. An element of view times
// transform sums three products: 3 roundings of each, relative to `sums`, the sum of the magnitudes. A
// cofactor is the difference of two products of such elements: two element errors and two roundings. The
// determinant sums three of them: 3 more.
struct NormalBound {
  Real direction;
  Real determinant;
  NormalBound(const Matrix& view, const Matrix& transform, const Real3& normal, const Real3& exact) {
    const Real33 sums = real33(view, true) * real33(transform, true);
    const Real33 most = cofactors(sums, 1);
    const Real3 magnitudes{std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2])};
    // The sum with the normal adds 3 roundings, the determinant one. The direction turns by error / length;
    // normalizing loses as much again. Then three floats are rounded at the vertex, and normalized once more
    // at the pixel (4.5).
    direction = 2 * length(most * magnitudes) * (2 * 3 + 2 + 4) * kDouble / length(exact) + 6 * kFloat;
    determinant = dot(sums.row[0], most.row[0]) * (3 * 3 + 2 + 3) * kDouble;
  }
};

/// Largest error of the directions in units of its bound.
Real worst_direction(NormalProbe& probe, const std::vector<NormalProbe::Case>& cases) {
  const std::vector<std::array<float, 3>> found = probe.normals(cases);
  Real worst = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const NormalProbe::Case& c = cases[i];
    const Real33 matrix = real33(c.view) * real33(c.transform);
    const Real33 inverse_transpose = cofactors(matrix, -1);
    const Real determinant = dot(matrix.row[0], inverse_transpose.row[0]);
    const Real3 exact = inverse_transpose * real3(c.normal) * (determinant < 0 ? -1 : 1);
    const Real3 got = real3(found[i]);
    const NormalBound bound(c.view, c.transform, real3(c.normal), exact);
    EXPECT_TRUE(std::isfinite(length(got)) && length(got) < 1.000001L);
    if (!(length(exact) > 0) || bound.direction > 1) continue;  // no direction is determined
    Real error = length(got - normalized(exact));
    // The side is undetermined.
    if (std::abs(determinant) <= bound.determinant) error = std::min(error, length(got + normalized(exact)));
    update_worst(worst, error / bound.direction);
  }
  return worst;
}

TEST(NormalTransforms, MatchTheInverseTranspose) {
  LightingRng rng{std::mt19937(41)};
  NormalProbe probe;
  for (const double decades : {0.0, 1.0, 6.0, 100.0}) {
    Real worst = 0;
    for (int n = 0; n < 8 * (long_tests() ? 100 : 1); ++n) {
      std::vector<NormalProbe::Case> cases;
      for (int i = 0; i < NormalProbe::kSide * NormalProbe::kSide; ++i) {
        // All axes together are scaled by up to 10^100: a factor of 10^200 between two axes would leave no
        // digits of the shorter one.
        const double all = decades > 6 ? std::pow(10, rng.between(-decades, decades)) : 1;
        const Matrix view = rng.one_in(2) ? turn(rng) : turn(rng) * scale(1e6, 1e6, 1e6);
        cases.push_back({view,
                         scale(all, all, all) * turn(rng) * stretch(rng, std::min(decades, 6.0)) * turn(rng),
                         rng.direction(), rng.one_in(2), rng.of({Shading::gouraud, Shading::phong})});
      }
      update_worst(worst, worst_direction(probe, cases));
    }
    expect_within("normals under scalings of 10^" + std::to_string(static_cast<int>(decades)) +
                      ", of (12 double eps of the condition + 6 * 2^-24)",
                  worst, 1, "");
  }
}

// Nearly, exactly up to rounding, or exactly linearly dependent: one row, two rows, all three.
TEST(NormalTransforms, AreWithinTheirBoundsUnderNearlySingularTransforms) {
  LightingRng rng{std::mt19937(42)};
  NormalProbe probe;
  Real worst = 0;
  for (int n = 0; n < 16 * (long_tests() ? 100 : 1); ++n) {
    std::vector<NormalProbe::Case> cases;
    for (int i = 0; i < NormalProbe::kSide * NormalProbe::kSide; ++i) {
      Matrix m;
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t r = 0; r < 3; ++r) m.m[4 * r + k] = rng.between(-1, 1);
      const double apart = rng.one_in(4) ? 0 : std::exp2(rng.between(-60, 0));
      const double of_a = rng.between(-1, 1);
      const double of_b = rng.one_in(8) ? 0 : rng.between(-1, 1);
      for (std::size_t k = 0; k < 3; ++k) {
        if (rng.one_in(16)) m.m[4 + k] = m.m[k];
        m.m[8 + k] = of_a * m.m[k] + of_b * m.m[4 + k] + apart * rng.between(-1, 1);
      }
      cases.push_back({rng.one_in(2) ? Matrix{} : turn(rng),
                       rng.one_in(20) ? scale(0, rng.between(-1, 1), 0) : m, rng.direction(), rng.one_in(2),
                       rng.of({Shading::gouraud, Shading::phong})});
    }
    update_worst(worst, worst_direction(probe, cases));
  }
  expect_within("normals under nearly singular transforms, of (12 double eps of the condition + 6 * 2^-24)",
                worst, 1, "");
}

// One axis scaled by 10^-6 to 10^-300, or by 0: normals of the remaining plane.
TEST(NormalTransforms, FlattenedMeshesHaveTheNormalOfTheirPlane) {
  NormalProbe probe;
  std::vector<NormalProbe::Case> cases;
  for (const double flat : {1e-6, 1e-100, 1e-170, 1e-300, -1e-300, 0.0})
    for (const bool normalize : {true, false})
      for (const Shading shading : {Shading::gouraud, Shading::phong})
        cases.push_back({{}, scale(1, 1, flat), {0.6f, 0.0f, 0.8f}, normalize, shading});
  const std::vector<std::array<float, 3>> found = probe.normals(cases);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double flat = cases[i].transform.m[10];
    // Longer than the largest float.
    if (!cases[i].normalize && cases[i].shading == Shading::gouraud && std::abs(flat) < 1e-6) continue;
    EXPECT_NEAR(found[i][0], std::abs(flat) > 1e-7 ? 0.75e-6 : 0, 1e-12) << flat;
    EXPECT_FLOAT_EQ(found[i][2], flat < 0 ? -1 : 1) << flat;
  }
}

}  // namespace
}  // namespace tessera::test::matrices_test
