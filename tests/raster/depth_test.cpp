// Stored depths against exact rational arithmetic, and their consistency over paths and instruction sets.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "tests/raster/depth_cases.h"
#include "tests/raster/tile_harness.h"

namespace tessera::test::depth_test {
namespace {

constexpr int kTile = 64;

// Renders one triangle that passes the depth test and writes depth only.
struct DepthStage : TileHarness {
  explicit DepthStage(DepthFormat kind) : TileHarness(kTile, kTile, kTile, kind) {}
  TileDraw& set(const DepthTriangle& t, Compare test = Compare::always) {
    clear_draws();
    TileDraw& draw = add_draw(t.corners.data());
    draw.uses_depth = true;
    draw.depth_test = test;
    draw.source = ColorSource::none;
    push(0, 0, 0);
    return draw;
  }
};

int rounds(int normal) { return long_tests() ? normal * 30 : normal; }

float float_of(std::int32_t key) {
  float f;
  std::memcpy(&f, &key, sizeof f);
  return f;
}

/// A covered pixel and the exact depth at its centre, in levels.
struct ExactLevel {
  int x, y;
  std::int64_t level;
};

// The specified accuracy, for every shape and slope: within 1 level at 16 and 24 bits, within 4 at 32 bits.
void expect_levels(DepthFormat kind, Shape shape, std::uint32_t seed, int count) {
  const std::int64_t tolerance = kind == DepthFormat::unorm32 ? 4 : 1;
  RandomTriangles source(seed, kTile);
  DepthStage stage(kind);
  std::vector<ExactLevel> exact_levels;
  std::int64_t worst = 0;
  for (int i = 0; i < count; ++i) {
    DepthTriangle t = with_random_depths(source, source.next(shape));
    set_words(t, kind);
    const TriangleReference reference = reference_of(t.corners);
    if (reference.area == 0) continue;
    stage.set(t);
    exact_levels.clear();
    reference.for_each_covered(0, 0, kTile, kTile, [&](int x, int y) {
      exact_levels.push_back({x, y, exact_level(reference, t, kind, x, y)});
    });
    for (const InstructionSet isa : available_isas()) {
      stage.render(isa, 0);
      for (const auto& [x, y, exact] : exact_levels) {
        const std::int64_t level = stored_depth_from_key(kind, stage.depth(x, y));
        worst = std::max(worst, std::abs(level - exact));
        ASSERT_LE(std::abs(level - exact), tolerance)
            << name_of(kind) << " " << name_of(isa) << ": level " << level << " for " << exact << " at " << x
            << " " << y << ", depths " << t.depth(0) << " " << t.depth(1) << " " << t.depth(2) << ": "
            << Describe{t.corners};
      }
    }
  }
  ::testing::Test::RecordProperty(name_of(kind), static_cast<int>(worst));
}

TEST(RasterDepth, OrdinaryTrianglesAreWithinSpecifiedLevels) {
  for (const DepthFormat kind : kUnormKinds)
    for (const Shape shape : {Shape::tiny, Shape::medium, Shape::large, Shape::on_centers, Shape::on_borders,
                              Shape::axis_aligned})
      expect_levels(kind, shape, 11, rounds(300));
}
TEST(RasterDepth, VeryLargeTrianglesAreWithinSpecifiedLevels) {
  for (const DepthFormat kind : kUnormKinds)
    for (const Shape shape : {Shape::widest_edges32, Shape::edges64})
      expect_levels(kind, shape, 12, rounds(100));
}
TEST(RasterDepth, SliversAreWithinSpecifiedLevels) {
  for (const DepthFormat kind : kUnormKinds) expect_levels(kind, Shape::sliver, 13, rounds(20000));
}
TEST(RasterDepth, NeedlesAreWithinSpecifiedLevels) {
  for (const DepthFormat kind : kUnormKinds) expect_levels(kind, Shape::needle, 14, rounds(20000));
}

// Error bound of a float32 plane evaluated with float gradients gx, gy: each gradient has a relative error of
// 2^-24 (plus 2^-52 of its terms, which matters for needles only); the inner multiply-add rounds to 2^-24 of
// |z0 + gy Y|, the outer one to 2^-24 of the sum. Total: 2^-24 (2 |z0| + 2 |gx X| + 3 |gy Y|), and at most
// the range of the vertices, to which depth is clamped. X and Y count from the anchor, the topmost and then
// leftmost vertex, whose depth is z0. The plane is evaluated in double and rounded once, so it is well within
// this bound.
TEST(RasterDepth, Float32StaysWithinTheProvenBound) {
  for (int s = 0; s < static_cast<int>(Shape::kCount); ++s) {
    RandomTriangles source(static_cast<std::uint32_t>(100 + s), kTile);
    DepthStage stage(DepthFormat::float32);
    for (int i = 0; i < rounds(300); ++i) {
      DepthTriangle t = with_random_depths(source, source.next(static_cast<Shape>(s)));
      for (std::int64_t& z : t.z) z &= ~((std::int64_t{1} << 20) - 1);  // exact in a float
      set_words(t, DepthFormat::float32);
      const TriangleReference reference = reference_of(t.corners);
      if (reference.area == 0) continue;
      stage.set(t);
      const double area = static_cast<double>(reference.area);
      const double dz1 = t.depth(1) - t.depth(0), dz2 = t.depth(2) - t.depth(0);
      const auto gradient = [&](Exact e1, Exact e2) {
        return (static_cast<double>(e1) * dz1 + static_cast<double>(e2) * dz2) / area;
      };
      const auto terms = [&](Exact e1, Exact e2) {
        return (std::abs(static_cast<double>(e1) * dz1) + std::abs(static_cast<double>(e2) * dz2)) / area;
      };
      const double gx = gradient(reference.edge[1].dx, reference.edge[2].dx);
      const double gy = gradient(reference.edge[1].dy, reference.edge[2].dy);
      const double tx = terms(reference.edge[1].dx, reference.edge[2].dx);
      const double ty = terms(reference.edge[1].dy, reference.edge[2].dy);
      const auto [low, high] = std::minmax({t.depth(0), t.depth(1), t.depth(2)});
      const auto is_before = [](const WindowVertex& a, const WindowVertex& b) {
        return a.y < b.y || (a.y == b.y && a.x < b.x);
      };
      const auto anchor = static_cast<int>(std::min_element(t.corners.begin(), t.corners.end(), is_before) -
                                           t.corners.begin());
      const WindowVertex& at = t.corners[static_cast<std::size_t>(anchor)];
      for (const InstructionSet isa : available_isas()) {
        stage.render(isa, 0);
        reference.for_each_covered(0, 0, kTile, kTile, [&](int x, int y) {
          const double stored = float_of(stage.depth(x, y));
          const double exact = static_cast<double>(exact_depth(reference, t, x, y));
          const double across = std::abs(x + 0.5 - at.x / 256.0), down = std::abs(y + 0.5 - at.y / 256.0);
          const double bound =
              1.01 * 0x1p-24 * (2 * t.depth(anchor) + 2 * std::abs(gx) * across + 3 * std::abs(gy) * down) +
              0x1p-50 * (tx * across + ty * down);
          ASSERT_LE(std::abs(stored - exact), std::min(bound, high - low))
              << name_of(isa) << ": " << stored << " for " << exact << ": " << Describe{t.corners};
          ASSERT_GE(stored, low);
          ASSERT_LE(stored, high);
        });
      }
    }
  }
}

TEST(RasterDepth, ScreenParallelTrianglesAreExact) {
  for (const DepthFormat kind : kDepthKinds) {
    RandomTriangles source(15, kTile);
    DepthStage stage(kind);
    for (int i = 0; i < rounds(2000); ++i) {
      DepthTriangle t = with_random_depths(source, source.next());
      t.z[1] = t.z[2] = t.z[0];
      set_words(t, kind);
      const TriangleReference reference = reference_of(t.corners);
      if (reference.area == 0) continue;
      stage.set(t);
      for (const InstructionSet isa : available_isas()) {
        stage.render(isa, 0);
        reference.for_each_covered(0, 0, kTile, kTile, [&](int x, int y) {
          ASSERT_EQ(stored_depth_from_key(kind, stage.depth(x, y)), quantize_depth(kind, t.depth(0)))
              << name_of(kind) << " " << name_of(isa) << " " << Describe{t.corners};
        });
      }
    }
  }
}

// Redraws a triangle in small rectangles, which select other pixel paths: Compare::equal passes on each of
// its pixels, less and greater on none.
TEST(RasterDepth, RedrawnTriangleHasEqualDepthOnEveryPath) {
  for (const DepthFormat kind : kDepthKinds) {
    RandomTriangles source(16, kTile);
    TileHarness stage(kTile, kTile, kTile, kind);
    for (int i = 0; i < rounds(300); ++i) {
      DepthTriangle t = with_random_depths(source, source.next());
      set_words(t, kind);
      const TriangleReference reference = reference_of(t.corners);
      if (reference.area == 0) continue;
      stage.clear_draws();
      const auto add = [&](PixelRect rect, Compare test, std::uint32_t packed_color) {
        TileDraw& draw = stage.add_draw(t.corners.data());
        draw.rect = rect;
        draw.uses_depth = true;
        draw.depth_test = test;
        draw.packed_color = packed_color;
        stage.push(0, stage.draw_count() - 1, 0);
      };
      add({0, 0, kTile, kTile}, Compare::always, 1);
      // Rectangles of 1 to 7 pixels: up to 4, the triangle takes the path of small triangles.
      const int step = source.between(1, 7);
      for (int y = 0; y < kTile; y += step)
        for (int x = 0; x < kTile; x += step)
          add({x, y, std::min(x + step, kTile), std::min(y + step, kTile)}, Compare::equal, 2);
      add({0, 0, kTile, kTile}, Compare::less, 3);
      add({0, 0, kTile, kTile}, Compare::greater, 4);
      for (const InstructionSet isa : available_isas()) {
        stage.render(isa, 0);
        for (int y = 0; y < kTile; ++y)
          for (int x = 0; x < kTile; ++x)
            ASSERT_EQ(stage.color(x, y), reference.covers(x, y) ? 2u : 0u)
                << name_of(kind) << " " << name_of(isa) << ", windows of " << step << ": "
                << Describe{t.corners};
      }
    }
  }
}

TEST(RasterDepth, KeysAreEqualOnEveryInstructionSet) {
  for (const DepthFormat kind : kDepthKinds) {
    RandomTriangles source(17, kTile);
    DepthStage stage(kind);
    for (int i = 0; i < rounds(1000); ++i) {
      DepthTriangle t = with_random_depths(source, source.next());
      set_words(t, kind);
      if (reference_of(t.corners).area == 0) continue;
      stage.set(t);
      stage.render(InstructionSet::scalar, 0);
      const std::vector<std::int32_t> scalar = stage.depths();
      for (const InstructionSet isa : available_isas()) {
        stage.render(isa, 0);
        ASSERT_EQ(stage.depths(), scalar)
            << name_of(kind) << " " << name_of(isa) << " " << Describe{t.corners};
      }
    }
  }
}

// All eight comparison functions with incoming depths that are nearer, equal and farther than the stored one.
TEST(RasterDepth, ComparisonFunctionsPassAsNamed) {
  const std::uint32_t stored_words[] = {0, 1, 32768, 65534, 65535};
  for (const DepthFormat kind : kDepthKinds) {
    for (const std::uint32_t stored_16 : stored_words) {
      for (const std::uint32_t incoming_16 : stored_words) {
        const std::int32_t stored = depth_key_from_stored(kind, quantize_depth(kind, stored_16 / 65535.0));
        const double incoming = incoming_16 / 65535.0;
        for (int test = 0; test < 8; ++test) {
          const int not_less = incoming_16 == stored_16 ? 2 : 4;
          const int order = incoming_16 < stored_16 ? 1 : not_less;  // bits of less, equal, greater
          const bool passes = (test & order) != 0;
          // A triangle over half of the tile, and one of 2x2 pixels, which takes the path of small triangles.
          for (const std::int32_t size : {80 * 256, 3 * 256}) {
            Triangle t{WindowVertex{0, 0, 0, 1}, WindowVertex{size, 0, 0, 1}, WindowVertex{0, size, 0, 1}};
            for (WindowVertex& v : t) v.z = vertex_depth_word(kind, incoming);
            for (const bool write : {false, true}) {
              for (const InstructionSet isa : available_isas()) {
                TileHarness stage(kTile, kTile, kTile, kind);
                TileDraw& draw = stage.add_draw(t.data());
                draw.uses_depth = true;
                draw.depth_test = static_cast<Compare>(test);
                draw.depth_write = write;
                draw.packed_color = 7;
                stage.push(0, 0, 0);
                stage.render(isa, 0, 1, stored);
                EXPECT_EQ(stage.color(0, 0), passes ? 7u : 1u)
                    << "function " << test << " " << name_of(kind) << " " << name_of(isa);
                EXPECT_EQ(stored_depth_from_key(kind, stage.depth(0, 0)),
                          quantize_depth(kind, passes && write ? incoming : stored_16 / 65535.0));
                EXPECT_EQ(stage.color(63, 63), 1u);
                EXPECT_EQ(stage.depth(63, 63), stored);
              }
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace tessera::test::depth_test
