// Attributes at the point where a plane cuts an edge, against exact fractions. Triangles have one vertex
// beyond the near or far plane. The edge is up to 2^40 times as long as its visible part, also measured along
// the plane.
//
// u = 2^-24, w = 2^-53. The cut is at t = first / (first - second). The roundings are: w of each distance,
// which contribute 1 - t times to t; the difference of the distances; the quotient; the difference of the
// attributes. t (2 (1 - t) + 3) w is at most 3 w. The sum is then rounded to double and to float.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "raster/clip.h"
#include "tests/numerics/bounds.h"
#include "tests/numerics/window_triangle.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::clipped_attributes_test {
using namespace detail;
namespace {

/// Clipping parameters with w above 0, so that no other plane cuts the triangle.
struct Cut {
  bool reversed;
  bool far;
  mpq_class distance(const ClipPosition& p) const {
    const mpq_class z(p.z), w(p.w);
    if (far) return reversed ? z : mpq_class(w - z);
    return reversed ? mpq_class(w - z) : mpq_class(z + w);
  }
  /// Approximate z of a point at signed distance `distance` inside the plane.
  double z_at(double distance, double w) const {
    if (far) return reversed ? distance : w - distance;
    return reversed ? w - distance : distance - w;
  }
};

enum Attribute { kMeasured, kIsNext, kIsLast, kAttributes };

class AnyTriangle {
 public:
  explicit AnyTriangle(std::uint32_t seed) : dice_(seed) {}
  Cut next(ClipVertex (&v)[3]) {
    const Cut cut{dice_.maybe(), dice_.maybe()};
    const bool along = dice_.maybe();
    const int octaves = dice_.maybe() ? 40 : 2;
    for (std::size_t k = 0; k < 3; ++k) {
      const double w = size(octaves);
      const double depth = along ? 1 : dice_.unit() * w;
      const auto distance = [&] {
        if (k > 0) return depth;
        return -depth * (dice_.maybe() ? size(octaves) : 1);
      };
      v[k].position = {(dice_.unit() - 0.5) * w, (dice_.unit() - 0.5) * w, cut.z_at(distance(), w), w};
      v[k].attributes[kMeasured] = attribute();
    }
    v[1].attributes[kIsNext] = v[2].attributes[kIsLast] = 1;
    const float first = v[0].attributes[kMeasured];
    float& second = v[1].attributes[kMeasured];
    switch (dice_.between(0, 2)) {
      case 0: second = std::nextafter(first, 1.0f); break;
      case 1:  // The attributes nearly cancel.
        second = std::copysign(second, -first);
        v[1].position.z = cut.z_at(cut.distance(v[0].position).get_d() * second / first, v[1].position.w);
        break;
      default: break;
    }
    return cut;
  }

 private:
  double size(int octaves) {
    return (1 + dice_.unit()) * std::exp2(static_cast<double>(dice_.between(0, octaves)));
  }
  float attribute() { return static_cast<float>((dice_.maybe() ? 1 : -1) * size(20) * 0x1p-10); }
  Rng dice_;
};

TEST(ClippedAttributes, RoundOnceAtTheCut) {
  AnyTriangle any(81);
  long double worst = 0;
  int cuts = 0;
  int far_from_ends = 0;
  int cancelled = 0;
  for (int n = 0; n < (long_tests() ? 1000000 : 20000); ++n) {
    ClipVertex v[3];
    const Cut cut = any.next(v);
    VertexTransform t;
    t.half_width = t.half_height = 0.5;
    t.guard_x = t.guard_y = kGuardBandPixels / t.half_width;
    t.reversed = cut.reversed;
    const mpq_class distances[3] = {cut.distance(v[0].position), cut.distance(v[1].position),
                                    cut.distance(v[2].position)};
    // Skip if rounding moved a vertex onto the plane, or if another plane cuts the triangle.
    if (distances[0] >= 0 || distances[1] <= 0 || distances[2] <= 0) continue;
    const std::uint8_t outcodes = compute_outcode(t, v[0].position) | compute_outcode(t, v[1].position) |
                                  compute_outcode(t, v[2].position);
    if (outcodes != (cut.far ? kBehindFar : kBeforeNear)) continue;
    const ClippedPolygon polygon = clip_triangle(t, v, outcodes, kAttributes);
    ASSERT_EQ(polygon.count, 4) << "triangle " << n;
    for (const std::size_t end : {1, 2}) {
      const auto is_end = end == 1 ? kIsNext : kIsLast;
      const auto is_other_end = end == 1 ? kIsLast : kIsNext;
      const auto is_cut = [&](const ClipVertex& c) {
        return c.attributes[is_other_end] == 0 && c.attributes[is_end] < 1;
      };
      const ClipVertex* const found =
          std::find_if(polygon.vertices, polygon.vertices + polygon.count, is_cut);
      // The cut is closer to the end point than float resolution.
      if (found == polygon.vertices + polygon.count) continue;
      const mpq_class a(v[0].attributes[kMeasured]);
      const mpq_class b(v[end].attributes[kMeasured]);
      const mpq_class along = distances[0] / (distances[0] - distances[end]);
      const mpq_class exact = a + along * (b - a);
      const float at = found->attributes[kMeasured];
      if (a == b) {
        EXPECT_EQ(at, v[0].attributes[kMeasured]);
        continue;
      }
      const mpq_class off = std::isfinite(at) ? abs(mpq_class(at) - exact) : abs(b - a);
      const mpq_class allowed = abs(exact) * mpq_class(0x1p-24 * (1 + 0x1p-20));
      update_worst(worst, mpq_class((off - allowed) / abs(b - a)).get_d());
      ++cuts;
      cancelled += abs(exact) < abs(b - a) * mpq_class(0x1p-40) ? 1 : 0;
      far_from_ends += along > 0.25 && along < 0.75 ? 1 : 0;
    }
  }
  EXPECT_GT(cuts, long_tests() ? 500000 : 10000);
  EXPECT_GT(far_from_ends, long_tests() ? 50000 : 1000);
  EXPECT_GT(cancelled, long_tests() ? 50000 : 1000);
  expect_within("attributes where near and far planes cut, beyond u of each", worst / 0x1p-53L,
                3 * (1 + 0x1p-20L), "2^-53 of the ends' difference");
}

}  // namespace
}  // namespace tessera::test::clipped_attributes_test
