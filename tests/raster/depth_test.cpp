// Stored depths against exact rational arithmetic, and all that depth tests must agree on with themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "tests/raster/depth_cases.h"
#include "tests/raster/tile_harness.h"

namespace tessera::test {
namespace {

constexpr int kTile = 64;

// A stage with one triangle that always passes and writes depth alone.
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

// The promise of the specification, for every shape, steep or not: 1 level at 16 and 24 bits, 4 at 32; and
// never a level outside of the vertices' own, give or take what rounding may do.
void expect_levels(DepthFormat kind, Shape shape, std::uint32_t seed, int count) {
  const std::int64_t tolerance = kind == DepthFormat::unorm32 ? 4 : 1;
  RandomTriangles source(seed, kTile);
  DepthStage stage(kind);
  std::int64_t worst = 0;
  for (int i = 0; i < count; ++i) {
    DepthTriangle t = with_random_depths(source, source.next(shape));
    set_words(t, kind);
    const TriangleReference reference = reference_of(t.corners);
    if (reference.area == 0) continue;
    stage.set(t);
    for (const InstructionSet isa : available_isas()) {
      stage.render(isa, 0);
      reference.for_each_covered(0, 0, kTile, kTile, [&](int x, int y) {
        const std::int64_t level = stored_depth_from_key(kind, stage.depth(x, y)),
                           exact = exact_level(reference, t, kind, x, y);
        worst = std::max(worst, std::abs(level - exact));
        ASSERT_LE(std::abs(level - exact), tolerance)
            << name_of(kind) << " " << name_of(isa) << ": level " << level << " for " << exact << " at " << x
            << " " << y << ", depths " << t.depth(0) << " " << t.depth(1) << " " << t.depth(2) << ": "
            << Describe{t.corners};
      });
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
  ::testing::Test::RecordProperty(name_of(kind), static_cast<int>(worst));
}

TEST(Depth, OfOrdinaryTrianglesIsWithinItsLevels) {
  for (const DepthFormat kind : kUnormKinds)
    for (const Shape shape : {Shape::tiny, Shape::medium, Shape::large, Shape::on_centers, Shape::on_borders,
                              Shape::axis_aligned})
      expect_levels(kind, shape, 11, rounds(300));
}
TEST(Depth, OfVeryLargeTrianglesIsWithinItsLevels) {
  for (const DepthFormat kind : kUnormKinds)
    for (const Shape shape : {Shape::widest_edges32, Shape::edges64})
      expect_levels(kind, shape, 12, rounds(100));
}
TEST(Depth, OfSliversIsWithinItsLevels) {
  for (const DepthFormat kind : kUnormKinds) expect_levels(kind, Shape::sliver, 13, rounds(20000));
}
TEST(Depth, OfNeedlesIsWithinItsLevels) {
  for (const DepthFormat kind : kUnormKinds) expect_levels(kind, Shape::needle, 14, rounds(20000));
}

// float32. The gradients are floats, each off by at most 2^-24 of itself (2^-52 of their terms come on top,
// which only needles feel); the inner multiply-add rounds to 2^-24 of |z0 + gy Y|, the outer to 2^-24 of the
// sum. So the error is at most 2^-24 (2 |z0| + 2 |gx X| + 3 |gy Y|) and a hair, and never more than the
// vertices' range, to which it is cut. X and Y count from the topmost vertex, the leftmost of those, whose
// depth is z0.
TEST(Depth, OfFloat32StaysWithinTheProvenBound) {
  for (int s = 0; s < static_cast<int>(Shape::kCount); ++s) {
    RandomTriangles source(static_cast<std::uint32_t>(100 + s), kTile);
    DepthStage stage(DepthFormat::float32);
    for (int i = 0; i < rounds(300); ++i) {
      DepthTriangle t = with_random_depths(source, source.next(static_cast<Shape>(s)));
      for (std::int64_t& z : t.z) z &= ~((std::int64_t{1} << 20) - 1);  // what a float holds exactly
      set_words(t, DepthFormat::float32);
      const TriangleReference reference = reference_of(t.corners);
      if (reference.area == 0) continue;
      stage.set(t);
      const double area = static_cast<double>(reference.area), dz1 = t.depth(1) - t.depth(0),
                   dz2 = t.depth(2) - t.depth(0);
      const auto gradient = [&](Exact e1, Exact e2) {
        return (static_cast<double>(e1) * dz1 + static_cast<double>(e2) * dz2) / area;
      };
      const auto terms = [&](Exact e1, Exact e2) {
        return (std::abs(static_cast<double>(e1) * dz1) + std::abs(static_cast<double>(e2) * dz2)) / area;
      };
      const double gx = gradient(reference.edge[1].dx, reference.edge[2].dx),
                   gy = gradient(reference.edge[1].dy, reference.edge[2].dy);
      const double tx = terms(reference.edge[1].dx, reference.edge[2].dx),
                   ty = terms(reference.edge[1].dy, reference.edge[2].dy);
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
          const double stored = float_of(stage.depth(x, y)),
                       exact = static_cast<double>(exact_depth(reference, t, x, y));
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

TEST(Depth, OfScreenParallelTrianglesIsExact) {
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

// The same triangle again: equal passes on each of its pixels and less on none, although the second is cut
// into other rectangles and so may go by other paths.
TEST(Depth, OfTheSameTriangleIsTheSameByEveryPath) {
  for (const DepthFormat kind : kDepthKinds) {
    RandomTriangles source(16, kTile);
    TileHarness stage(kTile, kTile, kTile, kind);
    for (int i = 0; i < rounds(300); ++i) {
      DepthTriangle t = with_random_depths(source, source.next());
      set_words(t, kind);
      const TriangleReference reference = reference_of(t.corners);
      if (reference.area == 0) continue;
      stage.clear_draws();
      const auto add = [&](PixelRect rect, Compare test, std::uint32_t word) {
        TileDraw& draw = stage.add_draw(t.corners.data());
        draw.rect = rect;
        draw.uses_depth = true;
        draw.depth_test = test;
        draw.packed_color = word;
        stage.push(0, stage.draw_count() - 1, 0);
      };
      add({0, 0, kTile, kTile}, Compare::always, 1);
      // Windows of 1 to 7 pixels: up to 4 the triangle is a small one.
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

TEST(Depth, KeysAreTheSameOnEveryInstructionSet) {
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

// All eight functions, on pixels that are nearer, the same and farther than what is stored.
TEST(Depth, FunctionsPassWhatTheyName) {
  const std::uint32_t stored_words[] = {0, 1, 32768, 65534, 65535};
  for (const DepthFormat kind : kDepthKinds) {
    for (const std::uint32_t stored_16 : stored_words) {
      for (const std::uint32_t incoming_16 : stored_words) {
        const std::int32_t stored = depth_key_from_stored(kind, quantize_depth(kind, stored_16 / 65535.0));
        const double incoming = incoming_16 / 65535.0;
        for (int test = 0; test < 8; ++test) {
          const int order = incoming_16 < stored_16    ? 1
                            : incoming_16 == stored_16 ? 2
                                                       : 4;  // bits of less, equal, greater
          const bool passes = (test & order) != 0;
          // A triangle over half of the tile, and one of 2x2 pixels, which goes by the other path.
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
}  // namespace tessera::test
