// The vertex stage's sums in double against their exact values: products of matrices, positions in clip space
// and in eye space, 1/w, and the outcodes of vertices next to a clip plane. Elements of all magnitudes
// together, and some that cancel out.
//
// w = 2^-53, u = 2^-24. Exact values are __float128 with 113 bits: a product of two doubles is exact, and
// sums round 2^-60 times as finely as in double. For sums that nearly cancel, exact values are fractions.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/tessera/tessera.hpp"
#include "raster/eye_transform.h"
#include "raster/vertex_transform.h"
#include "tests/numerics/bounds.h"
#include "tests/numerics/window_triangle.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::transform_rounding_test {
using namespace detail;
namespace {

__extension__ typedef __float128 Quad;

constexpr long double kDouble = 0x1p-53L, kFloat = 0x1p-24L;

/// The sum of four products, and the sum of their magnitudes.
struct Sum {
  Quad exact = 0;
  Quad sizes = 0;
  template <class A, class B>
  Sum(const A& a, const B& b) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Quad product = Quad{a(k)} * Quad{b(k)};
      exact += product;
      sizes += product < 0 ? -product : product;
    }
  }
  /// Error of `found` relative to the sum of the magnitudes. If that is 0, `found` must be 0.
  long double error(double found) const {
    if (sizes == 0) return found == 0 ? 0 : HUGE_VALL;
    return std::abs(static_cast<long double>((Quad{found} - exact) / sizes));
  }
};

double any_number(Rng& rng, int octaves) {
  const double size = std::exp2(octaves * (2 * rng.unit() - 1));
  if (rng.between(0, 9) == 0) return 0;
  return rng.maybe() ? size : -size;
}

/// Elements within 2^20 of each other, of equal magnitude, or integers.
std::array<double, 16> any_matrix(Rng& rng) {
  std::array<double, 16> m;
  const int octaves = static_cast<int>(rng.between(0, 2)) * 10;
  for (double& element : m) element = any_number(rng, octaves) * (octaves == 0 ? rng.unit() : 1);
  return m;
}

/// Some points make the products of a row cancel out up to the rounding to float.
std::array<float, 4> any_point(Rng& rng, const std::array<double, 16>& m) {
  std::array<float, 4> p;
  for (float& c : p) c = static_cast<float>(any_number(rng, 10));
  const double* row = m.data() + 4 * rng.between(0, 3);
  if (rng.maybe() && row[0] != 0)
    p[0] = static_cast<float>(-(row[1] * p[1] + row[2] * p[2] + row[3] * p[3]) / row[0]);
  return p;
}

Sum row_times(const std::array<double, 16>& m, std::size_t row, const std::array<float, 4>& p) {
  return {[&](std::size_t k) { return m[4 * row + k]; }, [&](std::size_t k) { return double{p[k]}; }};
}

int rounds(int usual) { return long_tests() ? 100 * usual : usual; }

TEST(TransformRounding, ProductsOfMatrices) {
  Rng rng(71);
  long double worst = 0;
  for (int n = 0; n < rounds(20000); ++n) {
    Matrix a{any_matrix(rng)};
    Matrix b{any_matrix(rng)};
    // Cancels out in element 0.
    if (rng.maybe() && a.m[1] != 0) b.m[4] = -(a.m[0] * b.m[0] + a.m[2] * b.m[8] + a.m[3] * b.m[12]) / a.m[1];
    const Matrix product = a * b;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k)
        update_worst(worst, Sum([&](std::size_t j) { return a.m[4 * i + j]; },
                                [&](std::size_t j) { return b.m[4 * j + k]; })
                                .error(product.m[4 * i + k]));
  }
  expect_within("product of matrices, of the sum of sizes", worst / kDouble, 4, "2^-53");
}

mpq_class exact_row_times(const std::array<double, 16>& m, std::size_t row, const std::array<float, 4>& p) {
  mpq_class sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += mpq_class(m[4 * row + k]) * mpq_class(p[k]);
  return sum;
}

/// Relative error of `found`.
long double relative_error(double found, const mpq_class& exact) {
  if (!std::isfinite(found)) return HUGE_VALL;
  if (exact == 0) return found == 0 ? 0 : HUGE_VALL;
  return mpq_class(abs(mpq_class(found) / exact - 1)).get_d();
}

/// Changes the matrix so that one of the sums for the point nearly cancels: w, the distance from the near or
/// far plane, or the distance from the guard band.
void cancel(Rng& rng, std::array<double, 16>& m, const std::array<float, 4>& p, double guard) {
  if (p[0] == 0) return;
  const auto any_sign = [&](double size) { return rng.maybe() ? size : -size; };
  const auto last_digit = [&](double d) {
    return d == 0 || rng.maybe() ? d : std::nextafter(d, any_sign(HUGE_VAL));
  };
  const auto row = [&](std::size_t n) { return m.data() + 4 * n; };
  const std::int64_t kind = rng.between(0, 2);
  if (kind == 0) {
    row(3)[0] = last_digit(-(row(3)[1] * p[1] + row(3)[2] * p[2] + row(3)[3] * p[3]) / p[0]);
  } else {
    const std::size_t beside_w = kind == 1 ? 2 : static_cast<std::size_t>(rng.between(0, 1));
    const double factor = any_sign(kind == 1 ? 1 : guard);
    for (std::size_t k = 0; k < 4; ++k) row(beside_w)[k] = last_digit(factor * row(3)[k]);
  }
}

TEST(TransformRounding, PositionsInClipSpace) {
  Rng rng(72);
  long double worst = 0;
  long double worst_w = 0;
  long double worst_rough = 0;
  int inexact = 0;
  int smooth = 0;
  for (int n = 0; n < rounds(50000); ++n) {
    std::array<double, 16> m = any_matrix(rng);
    const std::array<float, 4> p = any_point(rng, m);
    VertexTransform t;
    t.half_width = t.half_height = static_cast<double>(rng.between(1, 16384)) / 2;
    t.guard_x = t.guard_y = kGuardBandPixels / t.half_width;
    t.reversed = rng.maybe();
    if (n % 4 == 0) cancel(rng, m, p, t.guard_x);
    std::copy(m.begin(), m.end(), t.clip_from_object);
    t.set_error_bounds();
    const auto coordinates = [](const ClipPosition& position) {
      return std::array{position.x, position.y, position.z, position.w};
    };
    const std::array<double, 4> rounded = coordinates(clip_position(t, p[0], p[1], p[2], p[3]));
    for (std::size_t row = 0; row < 4; ++row) update_worst(worst, row_times(m, row, p).error(rounded[row]));
    const TransformedVertex v = transform_vertex(t, p);
    (v.needs_exact ? inexact : smooth) += 1;
    const std::array<double, 4> found = coordinates(v.position);
    if (v.needs_exact)
      for (std::size_t row = 0; row < 4; ++row)
        update_worst(worst_rough, relative_error(found[row], exact_row_times(m, row, p)));
    else update_worst(worst_w, relative_error(found[3], exact_row_times(m, 3, p)));
  }
  EXPECT_GT(inexact, rounds(5000));
  EXPECT_GT(smooth, rounds(30000));
  expect_within("clip coordinates, of the sum of sizes", worst / kDouble, 4, "2^-53");
  expect_within("w of vertices that are rounded four times, relative", worst_w * 0x1p20L, 1, "2^-20");
  expect_within("clip coordinates of those whose sums are exact, relative", worst_rough * 0x1p52L, 1,
                "2^-52");
}

// w is a single product, rounded once, by 2^-53 of itself.
TEST(TransformRounding, ReciprocalsOfW) {
  Rng rng(75);
  long double worst = 0;
  const auto any_size = [&] {
    return (1 + rng.unit()) * std::exp2(static_cast<double>(rng.between(-59, 58)));
  };
  for (int n = 0; n < rounds(1500); ++n) {
    VertexTransform t;
    t.half_width = t.half_height = 32;
    t.guard_x = t.guard_y = kGuardBandPixels / t.half_width;
    t.clip_from_object[15] = any_size();
    t.set_error_bounds();
    float positions[kVertexBatch][4] = {};
    for (auto& [x, y, z, w] : positions) w = static_cast<float>(any_size());
    for (const InstructionSet isa : available_isas()) {
      WindowVertex found[kVertexBatch];
      std::uint8_t codes[kVertexBatch];
      EXPECT_EQ(transform_vertices(isa)(t, {positions[0], 4}, 4, kVertexBatch, found, codes), 0);
      for (std::size_t i = 0; i < kVertexBatch; ++i)
        update_worst(worst,
                     std::abs(static_cast<long double>(
                         Quad{found[i].rw} * Quad{t.clip_from_object[15]} * Quad{positions[i][3]} - 1)));
    }
  }
  expect_within("1/w, relative", worst / kFloat, 1 + 0x1p-20L, "2^-24");
}

TEST(TransformRounding, PositionsInEyeSpace) {
  Rng rng(73);
  long double worst = 0;
  int divided = 0;
  for (int n = 0; n < rounds(1500); ++n) {
    std::array<double, 16> m = any_matrix(rng);
    for (std::size_t k = 0; k < 4 && n % 4 < 2; ++k) m[12 + k] = k == 3;  // w is 1
    EyeTransform t;
    std::copy(m.begin(), m.end(), t.eye_from_object);
    std::vector<std::array<float, 4>> points(kVertexBatch);
    for (std::array<float, 4>& p : points) {
      p = any_point(rng, m);
      if (n % 2 == 0) p[3] = 1;
    }
    for (const InstructionSet isa : available_isas()) {
      float found[3][kVertexBatch];
      eye_positions(isa)(t, {points[0].data(), 4}, 3 + n % 2, kVertexBatch, found[0], found[1], found[2]);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Sum w = row_times(m, 3, points[i]);
        const Quad size = w.exact < 0 ? -w.exact : w.exact;
        if (size * 0x1p20L <= w.sizes) continue;  // no digit of a float would remain
        divided += w.exact != 1;
        for (std::size_t row = 0; row < 3; ++row) {
          const Sum sum = row_times(m, row, points[i]);
          const auto exact = static_cast<long double>(sum.exact / w.exact);
          const auto of_sum = static_cast<long double>(sum.sizes / size);
          const auto of_w = std::abs(exact) * static_cast<long double>(w.sizes / size);
          const long double bound = kFloat * std::abs(exact) + 5 * kDouble * (of_sum + of_w) + 0x1p-149L;
          update_worst(worst, std::abs(found[row][i] - exact) / bound);
        }
      }
    }
  }
  EXPECT_GT(divided, rounds(1500) * kVertexBatch / 4);
  expect_within("eye-space positions, of u of each and 5 w of the sums of sizes over w", worst, 1, "");
}

/// Signed distance from a clip plane, positive inside, with the sum of the magnitudes of its terms.
struct PlaneDistance {
  std::uint8_t bit;
  Quad distance;
  Quad size;
};
std::array<PlaneDistance, 7> plane_distances(const VertexTransform& t, const ClipPosition& p) {
  const auto of = [](std::uint8_t bit, Quad a, Quad b) {
    return PlaneDistance{bit, a + b, (a < 0 ? -a : a) + (b < 0 ? -b : b)};
  };
  const Quad gx = Quad{t.guard_x} * p.w;
  const Quad gy = Quad{t.guard_y} * p.w;
  const Quad x = p.x;
  const Quad y = p.y;
  const Quad z = p.z;
  const Quad w = p.w;
  return {of(kLeftOfGuardBand, gx, x),
          of(kRightOfGuardBand, gx, -x),
          of(kBelowGuardBand, gy, y),
          of(kAboveGuardBand, gy, -y),
          t.reversed ? of(kBeforeNear, w, -z) : of(kBeforeNear, w, z),
          t.reversed ? of(kBehindFar, z, 0) : of(kBehindFar, w, -z),
          of(kNonPositiveW, w, 0)};
}

// Coordinates within 8 steps of the planes, set by the last column of a matrix for the vertex 0 0 0 1.
// Outcodes are exact where rounding might decide.
TEST(TransformRounding, Outcodes) {
  Rng rng(74);
  long double worst = 0;
  std::size_t right = 0;
  std::size_t wrong = 0;
  std::size_t on_planes = 0;
  for (int n = 0; n < rounds(40000); ++n) {
    VertexTransform t;
    const auto width = static_cast<double>(rng.between(1, 16384));
    const auto height = static_cast<double>(rng.between(1, 16384));
    t.half_width = width / 2;
    t.half_height = height / 2;
    t.guard_x = kGuardBandPixels / t.half_width;
    t.guard_y = kGuardBandPixels / t.half_height;
    t.reversed = rng.maybe();
    const double w = any_number(rng, 20);
    const auto beside = [&](double plane) {
      for (std::int64_t steps = rng.between(0, 8); steps > 0; --steps)
        plane = std::nextafter(plane, rng.maybe() ? HUGE_VAL : -HUGE_VAL);
      return plane;
    };
    const auto sign = [&] { return rng.maybe() ? 1.0 : -1.0; };
    const double at[4] = {beside(sign() * t.guard_x * w), beside(sign() * t.guard_y * w),
                          t.reversed && rng.maybe() ? 0 : beside(sign() * w), w};
    for (std::size_t row = 0; row < 4; ++row) t.clip_from_object[4 * row + 3] = at[row];
    const ClipPosition position{at[0], at[1], at[2], at[3]};
    t.set_error_bounds();
    const float vertex[4] = {0, 0, 0, 1};
    std::vector<std::uint8_t> codes{transform_vertex(t, {0, 0, 0, 1}).outcode};
    for (const InstructionSet isa : available_isas()) {
      WindowVertex window;
      std::uint8_t code = 0;
      transform_vertices(isa)(t, {vertex, 4}, 4, 1, &window, &code);
      codes.push_back(code);
    }
    for (const PlaneDistance& plane : plane_distances(t, position)) {
      const bool outside = plane.bit == kNonPositiveW ? !(plane.distance > 0) : plane.distance < 0;
      on_planes += plane.distance == 0 ? 1 : 0;
      for (const std::uint8_t code : codes) {
        if (outside == ((code & plane.bit) != 0)) {
          ++right;
          continue;
        }
        ++wrong;
        update_worst(worst, plane.size == 0
                                ? HUGE_VALL
                                : std::abs(static_cast<long double>(plane.distance / plane.size)));
      }
    }
  }
  EXPECT_GT(right, 100000u);
  EXPECT_GT(on_planes, 5000u);
  // Includes vertices exactly on a plane.
  expect_within("codes of vertices within 8 steps of a clip plane, wrong", static_cast<long double>(wrong), 0,
                "codes");
  expect_within("distance from a clip plane of vertices on its wrong side, of the sum of sizes",
                worst / kDouble, 0, "2^-53");
}

}  // namespace
}  // namespace tessera::test::transform_rounding_test
