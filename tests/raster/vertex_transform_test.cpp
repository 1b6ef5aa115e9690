// The vertex transform: the kernel against its scalar twins bit for bit, both against long double, and the
// limits of the outcodes.
#include "raster/vertex_transform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/raster/depth_cases.h"
#include "tests/raster/tile_harness.h"

namespace tessera::test::vertex_transform_test {
using namespace detail;
namespace {

class RandomTransforms {
 public:
  explicit RandomTransforms(std::uint32_t seed) : random_(seed) {}
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool one_in(int n) { return std::uniform_int_distribution<int>(1, n)(random_) == 1; }
  VertexTransform next(int round) {
    VertexTransform t;
    const double near = 0.1, far = 50;
    // A perspective projection after a random affine map; sometimes a random matrix.
    double affine[12];
    for (double& m : affine) m = in(-1, 1);
    for (int c = 0; c < 4; ++c) {
      t.clip_from_object[c] = 1.5 * affine[c];
      t.clip_from_object[4 + c] = 2 * affine[4 + c];
      t.clip_from_object[8 + c] = -(far + near) / (far - near) * (affine[8 + c] - (c == 3 ? 3 : 0)) -
                                  (c == 3 ? 2 * far * near / (far - near) : 0);
      t.clip_from_object[12 + c] = -(affine[8 + c] - (c == 3 ? 3 : 0));
    }
    if (round % 3 == 0)
      for (double& m : t.clip_from_object) m = in(-2, 2) * (one_in(8) ? 1e6 : 1);
    if (is_cancelling(round))
      for (double& m : t.clip_from_object) m = std::round(in(-3, 3));
    const int width = 1 + static_cast<int>(in(0, 16384)), height = 1 + static_cast<int>(in(0, 16384));
    t.half_width = width / 2.0;
    t.half_height = height / 2.0;
    t.guard_x = kGuardBandPixels / t.half_width;
    t.guard_y = kGuardBandPixels / t.half_height;
    t.center_x = static_cast<std::int32_t>(in(-100, 100)) * 256 + 128 * width;
    t.center_y = static_cast<std::int32_t>(in(-100, 100)) * 256 + 128 * height;
    t.reversed = one_in(2);
    if (one_in(3)) t.depth_near = in(0, 1), t.depth_far = in(0, 1);
    t.depth = static_cast<DepthFormat>(round % 5);
    t.set_error_bounds();
    return t;
  }
  /// Rounds in which sums of large numbers cancel to small ones or to 0.
  static bool is_cancelling(int round) { return round % 7 == 0; }
  float large_coordinate() {
    return std::ldexp(std::round(static_cast<float>(in(-3, 3))), one_in(2) ? 60 : 0);
  }
  float coordinate() {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kOdd[] = {0.0f,      -0.0f,      1e-40f,
                              1e30f,     -1e30f,     3e38f,
                              kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()};
    if (one_in(60)) return kOdd[std::uniform_int_distribution<std::size_t>(0, std::size(kOdd) - 1)(random_)];
    return static_cast<float>(in(-2, 2));
  }

 private:
  std::mt19937 random_;
};

TEST(VertexTransform, MatchesScalarTwinsBitForBit) {
  RandomTransforms random(1);
  std::size_t usable = 0, coded = 0, odd = 0, inexact = 0, packed = 0;
  for (int round = 0; round < (long_tests() ? 60000 : 2000); ++round) {
    const VertexTransform t = random.next(round);
    const int components = 3 + round / kVertexBatch % 2;
    const auto count = static_cast<std::size_t>(1 + round % kVertexBatch);
    packed += components == 3 && count == kVertexBatch ? 1 : 0;  // rows that are loaded as vectors
    std::vector<float> positions(count * static_cast<std::size_t>(components));
    for (float& p : positions)
      p = random.is_cancelling(round) ? random.large_coordinate() : random.coordinate();
    for (const InstructionSet isa : available_isas()) {
      std::vector<WindowVertex> vertices(count);
      std::vector<std::uint8_t> outcodes(count);
      const std::uint8_t all =
          transform_vertices(isa)(t, {positions.data(), static_cast<std::size_t>(components)}, components,
                                  count, vertices.data(), outcodes.data());
      std::uint8_t expected_all = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const float* p = positions.data() + i * static_cast<std::size_t>(components);
        const auto [clip, outcode, needs_exact] =
            transform_vertex(t, {p[0], p[1], p[2], components == 4 ? p[3] : 1.0f});
        inexact += needs_exact ? 1 : 0;
        expected_all |= outcodes[i];
        if ((outcode & kNonFinite) != 0) {
          ++odd;
          ASSERT_NE(outcodes[i] & kNonFinite, 0);  // the other bits are unspecified
        } else {
          ASSERT_EQ(outcodes[i], outcode) << name_of(isa);
        }
        if (outcodes[i] != 0) {
          ++coded;
          ASSERT_EQ(vertices[i].x, t.center_x);
          ASSERT_EQ(vertices[i].y, t.center_y);
          continue;
        }
        ++usable;
        const WindowVertex v = project(t, clip);
        ASSERT_EQ(vertices[i].x, v.x) << name_of(isa);
        ASSERT_EQ(vertices[i].y, v.y) << name_of(isa);
        ASSERT_EQ(vertices[i].z, v.z) << name_of(isa) << " " << name_of(t.depth);
        ASSERT_EQ(std::bit_cast<std::uint32_t>(vertices[i].rw), std::bit_cast<std::uint32_t>(v.rw))
            << name_of(isa);
      }
      ASSERT_EQ(all, expected_all);
    }
  }
  EXPECT_GT(packed, 0u);
  EXPECT_GT(usable, coded / 20);
  EXPECT_GT(odd, 100u);
  EXPECT_GT(inexact, 1000u);
}

VertexTransform transform_of(const std::array<double, 16>& rows, bool reversed) {
  VertexTransform t;
  std::copy(rows.begin(), rows.end(), t.clip_from_object);
  t.half_width = t.half_height = 512;
  t.guard_x = t.guard_y = kGuardBandPixels / t.half_width;
  t.reversed = reversed;
  t.depth = DepthFormat::float32;
  t.set_error_bounds();
  return t;
}

// Exact sums are slow: ordinary scenes must not need them, even for vertices on a plane.
TEST(VertexTransform, OrdinaryVerticesNeedNoExactSums) {
  struct Case {
    const char* what;
    std::array<double, 16> rows;
    bool reversed;
    float at, spread, z;  // if `at` is 0, z is the depth of all vertices, else the centre of z
  };
  constexpr double kFar = 4e6;
  const Case cases[] = {
      {"on the far plane", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, false, 0, 1, 1},
      {"on the near plane", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, false, 0, 1, -1},
      {"on the far plane, reversed", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, true, 0, 1, 0},
      {"a sky, as far as its w",
       {1, 0, 0.3, 0, 0, 1, 0.1, 0, 0.6, 0.8, 0.7, 3, 0.6, 0.8, 0.7, 3},
       false,
       0,
       1,
       1},
      // Rotated about an origin 4 * 10^6 away: terms of 10^7 cancel to about 1,000.
      {"a world far from its origin",
       {0.6, 0.8, 0, -1.4 * kFar, -0.48, 0.36, 0.8, -0.68 * kFar, 0, 0, 0, 0.1, -0.64, 0.48, -0.6,
        0.76 * kFar + 2000},
       true,
       static_cast<float>(kFar),
       1000,
       static_cast<float>(kFar)}};
  std::mt19937 random(3);
  const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-23f - 1; };
  for (const Case& c : cases) {
    const VertexTransform t = transform_of(c.rows, c.reversed);
    for (int n = 0; n < 1000; ++n) {
      const float z = c.at == 0 ? c.z : c.z + c.spread * unit();
      ASSERT_FALSE(
          transform_vertex(t, {c.at + c.spread * unit(), c.at + c.spread * unit(), z, 1}).needs_exact)
          << c.what << ", vertex " << n;
    }
  }
}

// If exact coordinates or their terms leave the range of doubles, vertices keep the ordinary four roundings.
TEST(VertexTransform, RoundsWhereDoublesEnd) {
  constexpr double kTiny = 0x1p-1000, kBig = 0x1p700, kLargest = std::numeric_limits<double>::max();
  struct Case {
    std::array<double, 16> rows;
    std::array<float, 4> object;
  };
  const Case cases[] = {
      {{kTiny, 0, 0, 0, 0, kTiny, 0, 0, 0, 0, kTiny, 0, 0, 0, 0, kTiny}, {0x1p-74f, 0, 0, 0.3f * 0x1p-74f}},
      {{kTiny, 0, 0, 0, 0, kTiny, 0, 0, 0, 0, kTiny, 0, 0, 0, 0, kTiny}, {0x1p-74f, 0, 0, 1.4f * 0x1p-74f}},
      {{kLargest, -0x1p1023, 0x1p970, 0x1p1023, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x1p1023}, {1, 1, 1, 1}},
      {{0, 0x1p-400, kBig, -kBig, 0, 0, kBig, -kBig, 0, 0, kBig, -kBig, 0x1p-400, 0, kBig, -kBig},
       {1, 0.5f, 1, 1}}};
  for (const Case& c : cases) {
    const VertexTransform t = transform_of(c.rows, false);
    const ClipPosition rounded = clip_position(t, c.object[0], c.object[1], c.object[2], c.object[3]);
    const TransformedVertex v = transform_vertex(t, c.object);
    EXPECT_FALSE(v.needs_exact);
    EXPECT_EQ(v.outcode, compute_outcode(t, rounded));
    EXPECT_EQ(v.position.x, rounded.x);
    EXPECT_EQ(v.position.w, rounded.w);
    for (const InstructionSet isa : available_isas()) {
      WindowVertex vertex;
      std::uint8_t outcode = 0;
      transform_vertices(isa)(t, {c.object.data(), 4}, 4, 1, &vertex, &outcode);
      EXPECT_EQ(outcode, v.outcode) << name_of(isa);
      EXPECT_LE(std::abs(vertex.x), kGuardBandPixels * kSubpixelScale) << name_of(isa);
    }
  }
  // The last vertex is visible.
  EXPECT_EQ(transform_vertex(transform_of(cases[3].rows, false), cases[3].object).outcode, 0);
}

// Small integers next to integers 2^58 times as large, which often cancel and leave only the small ones.
TEST(VertexTransform, CodesAreExactWhereLargeNumbersCancel) {
  __extension__ using Whole = __int128;
  std::mt19937 random(5);
  const auto small = [&] { return static_cast<std::int64_t>(random() % 7) - 3; };
  const auto sum = [](const std::int64_t(&m)[4], const std::int64_t(&p)[4]) {
    return Whole{m[0]} * p[0] + Whole{m[1]} * p[1] + Whole{m[2]} * p[2] + Whole{m[3]} * p[3];
  };
  std::size_t misjudged = 0;
  for (int n = 0; n < 100000; ++n) {
    VertexTransform t;
    t.half_width = t.half_height = 32;
    t.guard_x = t.guard_y = 512;  // an integer, like the sums
    t.reversed = n % 2 == 0;
    std::int64_t matrix[4][4], point[4];
    for (std::int64_t& p : point) p = small() * (random() % 2 == 0 ? std::int64_t{1} << 58 : 1);
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t column = 0; column < 4; ++column)
        t.clip_from_object[4 * row + column] = static_cast<double>(matrix[row][column] = small());
    t.set_error_bounds();
    const Whole x = sum(matrix[0], point);
    const Whole y = sum(matrix[1], point);
    const Whole z = sum(matrix[2], point);
    const Whole w = sum(matrix[3], point);
    const auto bit = [](bool is_outside, Outcode outcode) { return is_outside ? int{outcode} : 0; };
    const int expected = bit(x + 512 * w < 0, kLeftOfGuardBand) | bit(512 * w - x < 0, kRightOfGuardBand) |
                         bit(y + 512 * w < 0, kBelowGuardBand) | bit(512 * w - y < 0, kAboveGuardBand) |
                         bit((t.reversed ? w - z : z + w) < 0, kBeforeNear) |
                         bit((t.reversed ? z : w - z) < 0, kBehindFar) | bit(w <= 0, kNonPositiveW);
    const float p[4] = {static_cast<float>(point[0]), static_cast<float>(point[1]),
                        static_cast<float>(point[2]), static_cast<float>(point[3])};
    for (const InstructionSet isa : available_isas()) {
      WindowVertex vertex;
      std::uint8_t outcode = 0;
      transform_vertices(isa)(t, {p, 4}, 4, 1, &vertex, &outcode);
      ASSERT_EQ(outcode, expected) << name_of(isa) << ", case " << n;
    }
    misjudged += compute_outcode(t, clip_position(t, p[0], p[1], p[2], p[3])) != expected ? 1 : 0;
  }
  EXPECT_GT(misjudged, 100u);  // outcodes from rounded coordinates
}

// Snapping is floor(256 x + 1/2) of the true position unless rounding in double crosses the border between
// two grid steps. Depth is within one level at 32 bits.
TEST(VertexTransform, SnapsWithinOneStepOfTheTruePosition) {
  RandomTransforms random(2);
  std::size_t all = 0, moved = 0;
  for (int round = 0; round < 30000; ++round) {
    VertexTransform t = random.next(round);
    t.depth = DepthFormat::unorm32;
    const float p[3] = {static_cast<float>(random.in(-1, 1)), static_cast<float>(random.in(-1, 1)),
                        static_cast<float>(random.in(-1, 1))};
    const ClipPosition clip = clip_position(t, p[0], p[1], p[2], 1);
    if (compute_outcode(t, clip) != 0 || clip.w < 1e-3) continue;
    long double c[4];
    for (int r = 0; r < 4; ++r) {
      const double* m = t.clip_from_object + 4 * r;
      c[r] = static_cast<long double>(m[0]) * p[0] + static_cast<long double>(m[1]) * p[1] +
             static_cast<long double>(m[2]) * p[2] + m[3];
    }
    const WindowVertex v = project(t, clip);
    const auto x =
        t.center_x + static_cast<std::int64_t>(std::floor(c[0] / c[3] * t.half_width * 256 + 0.5L));
    const auto y =
        t.center_y - static_cast<std::int64_t>(std::floor(c[1] / c[3] * t.half_height * 256 + 0.5L));
    ASSERT_LE(std::abs(v.x - x), 1);
    ASSERT_LE(std::abs(v.y - y), 1);
    const long double unit = t.reversed ? c[2] / c[3] : (c[2] / c[3] + 1) / 2;
    const long double z = std::min(
        1.0L, std::max(0.0L, t.depth_near + unit * (static_cast<long double>(t.depth_far) - t.depth_near)));
    const auto word = static_cast<std::int64_t>(std::floor(z * 4294967295.0L + 0.5L));
    ASSERT_LE(std::abs(static_cast<std::int64_t>(v.z) - word), 1);
    ASSERT_NEAR(v.rw * static_cast<double>(c[3]), 1, 1e-7);
    ++all;
    moved += v.x != x || v.y != y ? 1 : 0;
  }
  EXPECT_GT(all, 3000u);
  EXPECT_LT(moved, all / 1000);
}

// A vertex on a plane is inside; the next float beyond it is outside.
TEST(VertexTransform, OutcodesStartJustBeyondThePlanes) {
  VertexTransform t;
  for (int i = 0; i < 4; ++i) t.clip_from_object[5 * i] = 1;
  t.half_width = t.half_height = 8191.5;  // the guard band ends at 2 w
  t.guard_x = kGuardBandPixels / t.half_width;
  t.guard_y = kGuardBandPixels / t.half_height;
  ASSERT_EQ(t.guard_x, 2);
  struct Edge {
    std::array<float, 4> position;
    int moving;
    float towards;
    std::uint8_t outcode;
    bool reversed = false;
  };
  const float w = 1.25f;
  for (const Edge& edge :
       {Edge{{2 * w, 0, 0, w}, 0, 9, kRightOfGuardBand}, Edge{{-2 * w, 0, 0, w}, 0, -9, kLeftOfGuardBand},
        Edge{{0, 2 * w, 0, w}, 1, 9, kAboveGuardBand}, Edge{{0, -2 * w, 0, w}, 1, -9, kBelowGuardBand},
        Edge{{0, 0, w, w}, 2, 9, kBehindFar}, Edge{{0, 0, -w, w}, 2, -9, kBeforeNear},
        Edge{{0, 0, w, w}, 2, 9, kBeforeNear, true}, Edge{{0, 0, 0, w}, 2, -9, kBehindFar, true}}) {
    t.reversed = edge.reversed;
    std::array<float, 8> positions{};
    std::copy(edge.position.begin(), edge.position.end(), positions.begin());
    std::copy(edge.position.begin(), edge.position.end(), positions.begin() + 4);
    float& moved = positions[static_cast<std::size_t>(4 + edge.moving)];
    moved = std::nextafter(moved, edge.towards);
    for (const InstructionSet isa : available_isas()) {
      WindowVertex vertices[2];
      std::uint8_t outcodes[2];
      EXPECT_EQ(transform_vertices(isa)(t, {positions.data(), 4}, 4, 2, vertices, outcodes), edge.outcode);
      EXPECT_EQ(outcodes[0], 0) << name_of(isa) << ": on the plane " << int{edge.outcode};
      EXPECT_EQ(outcodes[1], edge.outcode) << name_of(isa) << ": beyond it";
      // No vertex lies beyond the guard band.
      EXPECT_LE(std::abs(vertices[0].x), kGuardBandPixels * 256);
      EXPECT_LE(std::abs(vertices[0].y), kGuardBandPixels * 256);
    }
  }
}
TEST(VertexTransform, NonPositiveWHasOutcode) {
  VertexTransform t;
  for (int i = 0; i < 4; ++i) t.clip_from_object[5 * i] = 1;
  t.half_width = t.half_height = 100;
  t.guard_x = t.guard_y = kGuardBandPixels / 100.0;
  for (const float w : {0.0f, -0.0f, -1e-45f, -1.0f, -1e30f}) {
    const float position[4] = {0, 0, 0, w};
    for (const InstructionSet isa : available_isas()) {
      WindowVertex vertex;
      std::uint8_t outcode;
      transform_vertices(isa)(t, {position, 4}, 4, 1, &vertex, &outcode);
      EXPECT_NE(outcode & kNonPositiveW, 0) << name_of(isa) << " w = " << w;
    }
  }
}

}  // namespace
}  // namespace tessera::test::vertex_transform_test
